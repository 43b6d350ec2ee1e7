// Values of options: a word from a list, or a number.
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
  std::vector<std::string> not_yet; ///< words of planned features, which are rejected as such
};

/// Adds an option that stores its word in `target`, which keeps its value if the option is not given.
void add_choice(CLI::App& command, const std::string& name, std::string& target, const Choice& choice,
                const std::string& help);

/// Returns a check that a number is within these limits, which may be infinite, and no NaN.
CLI::Validator number_range(double least, double most);

/// Makes the command's integer options decimal, even with leading zeros, which CLI11 takes for octal numbers.
void read_as_decimal(CLI::App& command);

/// Throws InputError for infinity and NaN, which CLI11 accepts.
void check_number(double value, const char* option);

} // namespace celltrace::cli
