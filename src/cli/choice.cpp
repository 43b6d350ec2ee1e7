#include "cli/choice.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

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

void read_as_decimal(CLI::App& command) {
  const auto strip_zeros = [](std::string& number) -> std::string {
    const std::size_t sign = !number.empty() && (number[0] == '-' || number[0] == '+') ? 1 : 0;
    std::size_t end = sign;
    while (end + 1 < number.size() && number[end] == '0' && number[end + 1] >= '0' && number[end + 1] <= '9')
      ++end;
    number.erase(sign, end - sign);
    return {};
  };
  for (CLI::Option* option : command.get_options())
    if (const std::string type = option->get_type_name();
        type.compare(0, 3, "INT") == 0 || type.compare(0, 4, "UINT") == 0)
      option->transform(CLI::Validator(strip_zeros, ""));
  for (CLI::App* group : command.get_subcommands([](const CLI::App*) { return true; }))
    read_as_decimal(*group);
}

CLI::Validator number_range(double least, double most) {
  const auto text = [](double number) {
    std::ostringstream out;
    out << number;
    return out.str();
  };
  const std::string range = text(least) + (std::isfinite(most) ? " to " + text(most) : " on");
  const auto check = [=](const std::string& value) -> std::string {
    double number = 0;
    if (CLI::detail::lexical_cast(value, number) && number >= least && number <= most) return {};
    constexpr std::size_t kMostShown = 40;
    return "'" + value.substr(0, kMostShown) + (value.size() > kMostShown ? "..." : "") +
           "' is not a number from " + range;
  };
  return CLI::Validator(check,
                        std::isfinite(most) ? "FLOAT in [" + text(least) + " - " + text(most) + ']' : "");
}

void check_number(double value, const char* option) {
  if (!std::isfinite(value)) throw InputError(std::string(option) + " has to be a number");
}

} // namespace celltrace::cli
