// POV-Ray's switches and INI settings as a table (its manual, section "Command-line and INI-file options").
#pragma once

#include <initializer_list>
#include <limits>
#include <string_view>

namespace celltrace::cli {

/// How a switch or a setting becomes celltrace's options.
enum class Action {
  scene,  ///< the scene's file
  output, ///< the picture's file
  header, ///< a file that is included before the scene begins
  folder, ///< one more folder with files to include
  include_ini,
  declare, ///< NAME=VALUE

  whole,  ///< a whole number, the value of an option
  real,   ///< a number, the value of an option
  on_off, ///< on or off, the value of an option
  resume,

  // Kept until all is read, as they depend on each other.
  antialias, ///< on or off, and perhaps a threshold
  threshold, ///< of antialiasing
  jitter,    ///< on or off, and perhaps an amount
  jitter_amount,
  sampling,       ///< the method of antialiasing
  sampling_depth, ///< of antialiasing
  sampling_gamma, ///< of antialiasing
  to_file,        ///< on or off: whether the picture is written
  file_switch,    ///< to_file, and perhaps a file_type and bits a channel
  file_type,      ///< a letter
  bits,           ///< a channel
  grey,           ///< on or off
  file_gamma,     ///< a number, or sRGB
  compression,

  stream,         ///< a kind of messages: whether it is printed, and perhaps a text_file
  console,        ///< on or off: whether a kind of messages is printed
  text_file,      ///< a file that gets a kind of messages
  append,         ///< on or off: whether these files are kept
  never_run,      ///< a command of the shell
  without_effect, ///< on or off; has no effect in POV-Ray 3.7 either

  // Without effect on the picture here.
  ignored,         ///< no value
  ignored_number,  ///< a number
  ignored_perhaps, ///< a number, perhaps
  ignored_word,    ///< anything, perhaps
  refused_if_on    ///< changes the picture if it is on
};

/// A number that is out of its range.
enum class Beyond {
  refused,
  nearest ///< counts as the nearest number of the range
};

struct PovSetting {
  std::string_view letters; ///< of the switch, upper case; empty: there is none
  std::string_view name;    ///< of the INI setting, lower case; empty: there is none
  Action action;
  std::string_view option = {}; ///< celltrace's option, a kind of messages, or the name of what is refused
  double least = std::numeric_limits<double>::lowest();
  double most = std::numeric_limits<double>::max();
  Beyond beyond = Beyond::refused;
};

/// Returns the setting whose switch the text, without its sign and in either case, begins with; the longest
/// switch wins: WT4 is no width. Null: there is none.
const PovSetting* find_switch(std::string_view text);

/// Returns the setting of an INI file with this name, in either case. Null: there is none.
const PovSetting* find_setting(std::string_view name);

/// Whether the value names a file or a folder, or is a command, so that blanks are part of it.
bool takes_blanks(Action action);

/// Whether POV-Ray takes a setting's value for "on".
bool is_on(std::string_view value);

/// Whether a value says "off".
bool is_off_word(std::string_view value);

/// Whether the text is, begins with or ends with a word; the case of letters does not count.
bool same_word(std::string_view text, std::string_view word);
bool begins_with(std::string_view text, std::string_view word);
bool is_one_of(std::string_view text, std::initializer_list<std::string_view> words);
bool ends_with(std::string_view text, std::string_view word);

} // namespace celltrace::cli
