#include "cli/option_errors.hpp"

#include "cli/described_command.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

namespace {

/// Returns how many letters have to be changed, added, left out or swapped with the next one.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({changed, last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

const CLI::App& parsed_command(const CLI::App& app) {
  const auto parsed = app.get_subcommands();
  return parsed.empty() ? app : *parsed.front();
}

/// Returns what the names before the `=` of an argument may be.
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
  const std::string nearest = nearest_word(name, option_names(app));
  return "there is no option '" + name + "'" + (nearest.empty() ? "" : ": '" + nearest + "' perhaps?");
}

/// Returns what CLI11 says of an option without its value, in a sentence; else what it says.
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

std::string nearest_word(const std::string& word, const std::vector<std::string>& words) {
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  std::string nearest;
  for (const std::string& each : words)
    if (const std::size_t distance = edit_distance(word, each); distance < least) {
      least = distance;
      nearest = each;
    }
  return nearest;
}

std::string option_error(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = parsed_command(app);
  std::string text = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    text.clear();
    for (const std::string& argument : app.remaining(true))
      text += (text.empty() ? "" : "; ") + unexpected(command, argument);
  } else if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    text = missing_value(command, text);
  } else if (&command == &app && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    text = "no scene is named: celltrace SCENE.pov renders one";
  }
  const std::string name = command.get_name() == app.get_name() ? "" : ' ' + command.get_name();
  return text + " (celltrace" + name + " --help says more)";
}

} // namespace celltrace::cli
