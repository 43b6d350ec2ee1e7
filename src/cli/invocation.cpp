#include "cli/invocation.hpp"

#include "celltrace/error.hpp"
#include "cli/environment_options.hpp"
#include "cli/pov_switches.hpp"
#include "cli/povray_client.hpp"

#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

namespace celltrace::cli {

namespace {

void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
}

using Folders = std::vector<std::filesystem::path>;

/// The file itself if it is there, or else that of the first folder that has it.
std::filesystem::path find_in(const Folders& folders, const std::filesystem::path& file) {
  std::error_code ignored;
  if (file.is_absolute() || std::filesystem::exists(file, ignored)) return file;
  for (const std::filesystem::path& folder : folders)
    if (std::filesystem::is_regular_file(folder / file, ignored)) return folder / file;
  return file;
}

/// Folders that translated arguments name by -L.
Folders library_paths_of(const std::vector<std::string>& arguments) {
  Folders folders;
  for (std::size_t i = 0; i + 1 < arguments.size(); ++i)
    if (arguments[i] == "-L") folders.emplace_back(arguments[i + 1]);
  return folders;
}

/// Translates and parses the arguments of `render`, as POV-Ray would if there are defaults.
Invocation read_render(const std::vector<std::string>& defaults, const std::vector<std::string>& environment,
                       const std::vector<std::string>& own) {
  std::vector<std::string> all = {"render"};
  append(all, defaults);
  // A user's INI file that stands for every run is full of settings without effect.
  const Translation usual = translate_pov_switches(all);
  append(all, environment);
  append(all, own);
  const Folders folders = library_paths_of(usual.arguments);
  Translation translation = translate_pov_switches(
      all, [&](const std::string& file) { return read_ini_text(find_in(folders, file).string()); });
  std::vector<std::string>& notes = translation.notes;
  notes.erase(notes.begin(), notes.begin() + static_cast<std::ptrdiff_t>(usual.notes.size()));
  Invocation invocation = {parse_command_line(std::move(translation.arguments)), std::move(notes)};
  if (auto* const render = std::get_if<RenderRequest>(&invocation.request);
      render != nullptr && render->stands_in_for_povray)
    render->scene = find_in(render->library_paths, render->scene);
  return invocation;
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
    read({}); // throws if the arguments are wrong without it
    throw InputError(std::string(kOptionsVariable) + ": " + what);
  }
}

} // namespace celltrace::cli
