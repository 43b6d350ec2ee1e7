#include "cli/invocation.hpp"

#include "celltrace/error.hpp"
#include "cli/environment_options.hpp"
#include "cli/pov_switches.hpp"
#include "cli/povray_client.hpp"

#include <optional>
#include <utility>

namespace celltrace::cli {

namespace {

void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
}

/// Translates and parses the arguments of `render`, as POV-Ray would if there are defaults.
Invocation read_render(const std::vector<std::string>& defaults, const std::vector<std::string>& environment,
                       const std::vector<std::string>& own) {
  std::vector<std::string> all = {"render"};
  append(all, defaults);
  // A user's INI file applies to every run and is full of settings without effect, whose notes are left out.
  const std::size_t usual_notes = translate_pov_switches(all).notes.size();
  append(all, environment);
  append(all, own);
  Translation translation = translate_pov_switches(all);
  std::vector<std::string>& notes = translation.notes;
  notes.erase(notes.begin(), notes.begin() + static_cast<std::ptrdiff_t>(usual_notes));
  return {parse_command_line(std::move(translation.arguments)), std::move(notes)};
}

} // namespace

Invocation read_invocation(std::string_view program, const std::vector<std::string>& arguments) {
  if (!stands_in_for_povray(program, {}) && !is_for_render(arguments))
    return {parse_command_line(arguments), {}};
  const std::vector<std::string> environment = environment_options();
  std::vector<std::string> all = environment, notes, defaults, own = arguments;
  append(all, arguments);
  if (!own.empty() && own.front() == "render") own.erase(own.begin());
  if (stands_in_for_povray(program, all)) {
    if (std::optional<std::string> text = povray_information(arguments))
      return {InformationRequest{std::move(*text), true}, {}};
    defaults = povray_defaults(povray_places(), notes);
  }
  const auto read = [&](const std::vector<std::string>& words) {
    Invocation invocation = read_render(defaults, words, own);
    invocation.notes.insert(invocation.notes.begin(), notes.begin(), notes.end());
    return invocation;
  };
  try {
    return read(environment);
  } catch (const InputError& error) {
    if (environment.empty()) throw;
    const std::string what = error.what();
    read({}); // throws if the arguments are wrong without the variable
    throw InputError(std::string(kOptionsVariable) + ": " + what);
  }
}

} // namespace celltrace::cli
