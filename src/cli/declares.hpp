// Names that a command line declares before a scene begins.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace celltrace::cli {

/// Splits NAME=VALUE. Throws InputError if the text has another form, and for numbers that are too large.
std::pair<std::string, std::string> parse_declare(const std::string& text);

/// Returns the number in a text, or else the string, without its quotes.
std::variant<double, std::string> declared_value(const std::string& text);

} // namespace celltrace::cli
