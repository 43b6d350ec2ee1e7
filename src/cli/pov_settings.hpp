// POV-Ray's switches and INI settings as a table (its manual, section "Command-line and INI-file options").
#pragma once

#include <initializer_list>
#include <limits>
#include <string_view>

namespace celltrace::cli {

/// The ways in which switches and settings become celltrace's options.
enum class Action {
  scene,  ///< the scene's file
  output, ///< the picture's file
  header, ///< a file included before the scene begins
  folder, ///< a further folder with include files
  include_ini,
  declare, ///< NAME=VALUE

  whole,  ///< an integer as the value of an option
  real,   ///< a number as the value of an option
  on_off, ///< on or off as the value of an option
  resume,

  // Actions kept until everything is read, as they depend on each other.
  antialias, ///< on or off, with an optional threshold
  threshold, ///< threshold of antialiasing
  jitter,    ///< on or off, with an optional amount
  jitter_amount,
  sampling,       ///< the method of antialiasing
  sampling_depth, ///< depth of antialiasing
  sampling_gamma, ///< gamma of antialiasing
  to_file,        ///< on or off: whether the picture is written
  file_switch,    ///< to_file, with an optional file_type and bits per channel
  file_type,      ///< a letter
  bits,           ///< per channel
  grey,           ///< on or off
  file_gamma,     ///< a number, or sRGB
  compression,

  stream,         ///< a kind of messages: whether it is printed, with an optional text_file
  console,        ///< on or off: whether a kind of messages is printed
  text_file,      ///< a file that gets a kind of messages
  append,         ///< on or off: whether these files are appended to
  never_run,      ///< a shell command
  without_effect, ///< on or off; has no effect in POV-Ray 3.7 either

  // Actions without effect on the picture here.
  ignored,         ///< takes no value
  ignored_number,  ///< a number
  ignored_perhaps, ///< an optional number
  ignored_word,    ///< any optional value
  refused_if_on    ///< changes the picture if it is on
};

/// The treatment of a number out of range.
enum class OutOfRange {
  refused,
  nearest ///< becomes the nearest number of the range
};

struct PovSetting {
  std::string_view letters; ///< letters of the switch, upper case; empty: there is no switch
  std::string_view name;    ///< name of the INI setting, lower case; empty: there is no setting
  Action action;
  std::string_view option = {}; ///< celltrace's option, a kind of messages, or the name of a rejected feature
  double least = std::numeric_limits<double>::lowest();
  double most = std::numeric_limits<double>::max();
  OutOfRange out_of_range = OutOfRange::refused;
};

/// Returns the setting whose switch begins the text, without its sign and in either case; the longest switch
/// wins: WT4 is no width. Returns null if there is none.
const PovSetting* find_switch(std::string_view text);

/// Returns the setting of an INI file with this name, in either case; null if there is none.
const PovSetting* find_setting(std::string_view name);

/// Returns whether the value is a file, a folder or a command, so that it includes blanks.
bool takes_blanks(Action action);

/// Returns whether POV-Ray takes a setting's value for "on".
bool is_on(std::string_view value);

bool is_off_word(std::string_view value);

/// Return whether the text is, begins with or ends with a word, ignoring case.
bool same_word(std::string_view text, std::string_view word);
bool begins_with(std::string_view text, std::string_view word);
bool is_one_of(std::string_view text, std::initializer_list<std::string_view> words);
bool ends_with(std::string_view text, std::string_view word);

} // namespace celltrace::cli
