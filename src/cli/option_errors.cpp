#include "cli/option_errors.hpp"

#include "cli/described_command.hpp"
#include "pov/nearest_word.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

namespace {

const CLI::App& parsed_command(const CLI::App& app) {
  const auto parsed = app.get_subcommands();
  return parsed.empty() ? app : *parsed.front();
}

/// Returns all names that may stand before the `=` of an argument.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  const std::vector<DescribedCommand> commands = describe(app);
  for (const DescribedGroup& group : commands.front().groups)
    for (const DescribedOption& option : group.options)
      for (const std::string& name : option.names)
        if (name.substr(0, 2) == "--") names.push_back(name);
  return names;
}

std::string unexpected(const CLI::App& app, const std::string& argument) {
  if (argument.size() < 2 || argument[0] != '-') return "'" + argument + "' is one argument too many";
  const std::string name = argument.substr(0, argument.find('='));
  const std::string nearest = pov::nearest_word(name, option_names(app));
  return "there is no option '" + name + "'" + (nearest.empty() ? "" : ": '" + nearest + "' perhaps?");
}

/// Returns CLI11's message about an option without its value as a sentence; any other message stays.
std::string missing_value(const CLI::App& app, const std::string& said) {
  const std::string name = said.substr(0, said.find(": "));
  const std::vector<DescribedCommand> commands = describe(app);
  for (const DescribedGroup& group : commands.front().groups)
    for (const DescribedOption& option : group.options)
      if (std::find(option.names.begin(), option.names.end(), name) != option.names.end() &&
          !option.value.empty())
        return name + " needs a value: " + option.value + (option.limits.empty() ? "" : ", " + option.limits);
  return said;
}

} // namespace

std::string option_error(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = parsed_command(app);
  std::string text = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    text.clear();
    for (const std::string& argument : app.remaining(true))
      text += (text.empty() ? "" : "; ") + unexpected(command, argument);
  } else if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    text = missing_value(command, text);
  } else if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    const bool renders = &command == &app || command.get_name() == "render";
    if (renders || command.get_name() == "view")
      text = std::string("no scene is named") + (renders ? ": celltrace SCENE.pov renders one" : "");
  }
  const std::string name = command.get_name() == app.get_name() ? "" : ' ' + command.get_name();
  return text + " (celltrace" + name + " --help says more)";
}

} // namespace celltrace::cli
