// What options may have for a value: a word from a list, or a number.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Validator;
} // namespace CLI

namespace celltrace::cli {

struct Choice {
  std::vector<std::string> known;
  std::vector<std::string> not_yet; ///< words that the program is to understand one day, and refuses as such
};

/// Adds an option that puts its word into `target`, which keeps its value where the option is not given.
void add_choice(CLI::App& command, const std::string& name, std::string& target, const Choice& choice,
                const std::string& help);

/// Returns a check that a number is within these limits, which may be infinite, and no NaN.
CLI::Validator number_range(double least, double most);

/// Has the whole numbers among the command's options read as decimal ones, whatever zeros they begin with:
/// CLI11 takes them for octal.
void read_as_decimal(CLI::App& command);

/// Throws InputError for infinity and for what is no number: CLI11 takes both.
void check_number(double value, const char* option);

} // namespace celltrace::cli
