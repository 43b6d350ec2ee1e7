#include "cli/choice.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <cmath>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

void add_choice(CLI::App& command, const std::string& name, std::string& target, const Choice& choice,
                const std::string& help) {
  const auto check = [name, choice](const std::string& value) -> std::string {
    const auto has = [&](const std::vector<std::string>& list) {
      return std::find(list.begin(), list.end(), value) != list.end();
    };
    if (has(choice.known)) return "";
    if (has(choice.not_yet)) return "'" + value + "' is not supported yet";
    return "'" + value + "' is none of " + CLI::detail::join(choice.known, ", ");
  };
  command.add_option(name, target, help)->check(CLI::Validator(check, CLI::detail::join(choice.known, "|")));
}

void check_number(double value, const char* option) {
  if (!std::isfinite(value)) throw InputError(std::string(option) + " has to be a number");
}

} // namespace celltrace::cli
