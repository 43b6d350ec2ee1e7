// Errors in options, in words that say what to type.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace celltrace::cli {

/// Returns the one of `words` that `word` is most likely meant to be; "" if none is near.
std::string nearest_word(const std::string& word, const std::vector<std::string>& words);

/// Returns one line about what CLI11 has refused while it read the options of `app`.
std::string option_error(const CLI::App& app, const CLI::ParseError& error);

} // namespace celltrace::cli
