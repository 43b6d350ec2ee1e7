// Switches and settings that depend on each other, so that their meaning is known when all are read.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

/// The settings of antialiasing; the defaults are POV-Ray's.
struct SamplingChoice {
  bool is_on = false, jitters = true;
  double threshold = 0.3, jitter = 1;
  std::optional<double> method, depth, gamma;

  /// Returns celltrace's options.
  std::vector<std::string> options() const;
};

/// The settings of the picture's file.
struct FileChoice {
  char type = 0; ///< POV-Ray's letter; 0: none was given
  bool is_grey = false;
  std::optional<double> bits;  ///< per channel
  std::optional<double> gamma; ///< none: sRGB
  double compression = 0;

  /// Returns celltrace's options, without the type.
  std::vector<std::string> options() const;
};

/// Returns celltrace's name of the file type with this POV-Ray letter, in either case; empty if there is
/// none.
std::string_view file_type_name(char letter);

/// The kinds of messages that are not printed, and files that get messages.
struct MessageChoice {
  std::map<std::string, bool, std::less<>> printed;      ///< kinds that were switched on or off
  std::map<std::string, std::string, std::less<>> files; ///< key: kind
  bool appends = false;

  /// Returns celltrace's options.
  std::vector<std::string> options() const;
};

} // namespace celltrace::cli
