// Errors in options, in words that say what to type.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace celltrace::cli {

/// Returns one line about what CLI11 has refused while it read the options of `app`.
std::string option_error(const CLI::App& app, const CLI::ParseError& error);

} // namespace celltrace::cli
