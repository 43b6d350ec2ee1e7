// Puts POV-Ray's switches and settings, one after the other, into celltrace's options.
#pragma once

#include "cli/pov_choices.hpp"
#include "cli/pov_entries.hpp"

#include <cstddef>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

struct Translation {
  /// Command first ("render" where none was given), in the terms of command_line.hpp.
  std::vector<std::string> arguments;
  /// One line for each switch that has no effect here and does no harm, or counts as something else.
  std::vector<std::string> notes;
};

class PovTranslation {
public:
  /// Takes over an argument as it is.
  void pass(const std::string& argument);

  /// Translates an entry; of what is said more than once the last counts. It is none that names a scene, a
  /// header, a folder or an INI file. Throws InputError for an entry that is unknown, lacks its value, or
  /// changes the picture in a way that is not supported.
  void apply(const PovEntry& entry);

  /// Puts an option's value in place of the one that this function gave it before.
  void option(std::string_view name, const std::string& value);
  /// Adds an option that may be repeated.
  void add_option(std::string_view name, const std::string& value);
  void note(const std::string& text) { notes_.push_back(text); }

  /// Adds an argument that is to be filled in, and returns its place.
  std::size_t reserve();
  void fill(std::size_t place, const std::string& argument) { arguments_[place] = argument; }

  bool has_any_option(std::initializer_list<std::string_view> names) const;
  /// Ends the translation.
  Translation take();

private:
  bool apply_sampling(const PovEntry& entry);
  bool apply_file(const PovEntry& entry);
  bool apply_messages(const PovEntry& entry);
  bool apply_ignored(const PovEntry& entry);
  void declare(const PovEntry& entry);
  void file_switch(const PovEntry& entry);
  void file_type(const PovEntry& entry, char letter);
  void text_file(const PovEntry& entry, std::string_view kind);

  double number(const PovEntry& entry, std::string_view text, bool is_whole);
  double number(const PovEntry& entry);
  bool on(const PovEntry& entry);

  std::vector<std::string> arguments_, notes_;
  std::map<std::string, std::size_t, std::less<>> values_; ///< where those of options are in the arguments
  std::set<std::string, std::less<>> declared_;
  SamplingChoice sampling_;
  FileChoice file_;
  MessageChoice messages_;
  bool resumes_ = false;
  std::size_t sampling_at_ = 0, file_at_ = 0; ///< in the arguments: the last entry of these choices
};

} // namespace celltrace::cli
