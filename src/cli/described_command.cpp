#include "cli/described_command.hpp"

#include <CLI/CLI.hpp>

namespace celltrace::cli {

namespace {

/// Returns the words of "TEXT:a|b" (choice.hpp) and "TEXT:{a,b}" (CLI::IsMember); none for any other type.
std::vector<std::string> choices_of(const std::string& type) {
  const std::size_t colon = type.find(':');
  if (colon == type.npos) return {};
  std::string words = type.substr(colon + 1);
  if (words.size() > 2 && words.front() == '{' && words.back() == '}')
    return CLI::detail::split(words.substr(1, words.size() - 2), ',');
  return words.find('|') == words.npos ? std::vector<std::string>() : CLI::detail::split(words, '|');
}

/// Returns the name of a value that has one of CLI11's types.
std::string value_of(const std::string& type) {
  constexpr std::pair<const char*, const char*> kNames[] = {
      {"INT", "N"}, {"UINT", "N"}, {"FLOAT", "NUMBER"}, {"TEXT", "WORD"}};
  for (const auto& [known, name] : kNames)
    if (type == known) return name;
  return type;
}

/// Returns the limits of "INT:INT in [1 - 9]" (CLI::Range) and "FLOAT:1 to 9" (choice.hpp).
std::string limits_of(const std::string& type) {
  const std::size_t colon = type.find(':');
  std::string limits = colon == type.npos ? "" : type.substr(colon + 1);
  if (const std::size_t open = limits.find('['); open != limits.npos && limits.back() == ']') {
    limits = limits.substr(open + 1, limits.size() - open - 2);
    if (const std::size_t dash = limits.find(" - "); dash != limits.npos) limits.replace(dash, 3, " to ");
  }
  return limits == "NONNEGATIVE" ? "" : limits == "POSITIVE" ? "above 0" : limits;
}

DescribedOption describe_option(const CLI::Option& option) {
  DescribedOption described;
  const bool is_flag = option.get_expected_max() == 0 || option.get_type_size_max() == 0;
  if (!is_flag) {
    const std::string type = option.get_type_name();
    described.choices = choices_of(type);
    described.value = described.choices.empty() ? value_of(type.substr(0, type.find(':')))
                                                : CLI::detail::join(described.choices, "|");
    if (described.choices.empty()) described.limits = limits_of(type);
    described.default_value = option.get_default_str();
  }
  for (const std::string& name : option.get_snames())
    described.names.push_back('-' + name);
  for (const std::string& name : option.get_lnames())
    described.names.push_back("--" + name);
  if (described.positional() && !option.get_single_name().empty() && described.value.empty())
    described.value = option.get_single_name();
  described.description = option.get_description();
  described.required = option.get_required();
  return described;
}

DescribedGroup describe_group(const CLI::App& app, const std::string& title) {
  DescribedGroup group{title, {}};
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) group.options.push_back(describe_option(*option));
  return group;
}

DescribedCommand describe_command(const CLI::App& app, const std::string& name) {
  DescribedCommand command{name, app.get_description(), app.get_footer(), {describe_group(app, "")}};
  // Groups of options are subcommands without a name.
  for (const CLI::App* part : app.get_subcommands([](const CLI::App*) { return true; }))
    if (part->get_name().empty()) command.groups.push_back(describe_group(*part, part->get_group()));
  return command;
}

} // namespace

bool DescribedOption::takes_file() const {
  return choices.empty() && (value.find("FILE") != value.npos || value.find('.') != value.npos);
}

std::vector<DescribedCommand> describe(const CLI::App& app) {
  std::vector<DescribedCommand> commands = {describe_command(app, "")};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!command->get_name().empty()) commands.push_back(describe_command(*command, command->get_name()));
  return commands;
}

} // namespace celltrace::cli
