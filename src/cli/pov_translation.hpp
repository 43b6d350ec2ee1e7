// Translates POV-Ray's switches and settings one by one into celltrace's options.
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
  /// The arguments in the terms of command_line.hpp, the command first ("render" by default).
  std::vector<std::string> arguments;
  /// Notes, one line for each switch that is ignored without harm, or replaced by something else.
  std::vector<std::string> notes;
};

class PovTranslation {
public:
  /// Appends an argument unchanged.
  void pass(const std::string& argument);

  /// Translates an entry; the last of repeated ones counts. It may not name a scene, a header, a folder or an
  /// INI file. Throws InputError for an entry that is unknown, lacks its value, or changes the picture in a
  /// way that is not supported.
  void apply(const PovEntry& entry);

  /// Sets an option; replaces the value that an earlier call gave it.
  void option(std::string_view name, const std::string& value);
  /// Adds an option that may be repeated.
  void add_option(std::string_view name, const std::string& value);
  void note(const std::string& text) { notes_.push_back(text); }

  /// Appends an argument to be filled in later, and returns its index.
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
  std::map<std::string, std::size_t, std::less<>> values_; ///< index of each option among the arguments
  std::set<std::string, std::less<>> declared_;
  SamplingChoice sampling_;
  FileChoice file_;
  MessageChoice messages_;
  bool resumes_ = false;
  std::size_t sampling_at_ = 0,
              file_at_ = 0; ///< indices of the last entry of each choice among the arguments
};

} // namespace celltrace::cli
