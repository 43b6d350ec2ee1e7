// Names that a command line declares before a scene begins.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace celltrace::cli {

/// Splits NAME=VALUE. Throws InputError if it is none, and for numbers that are too large.
std::pair<std::string, std::string> parse_declare(const std::string& text);

/// Returns the number that a text is, or else the string: what is in quotes is a string.
std::variant<double, std::string> declared_value(const std::string& text);

} // namespace celltrace::cli
