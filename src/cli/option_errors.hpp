// Errors in options, phrased so that they say what to type.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace celltrace::cli {

/// Returns one line about an error that CLI11 has found in the options of `app`.
std::string option_error(const CLI::App& app, const CLI::ParseError& error);

} // namespace celltrace::cli
