// Switches and settings that depend on each other: what they mean is known when all are read.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cli {

/// Antialiasing; the defaults are POV-Ray's.
struct SamplingChoice {
  bool is_on = false, jitters = true;
  double threshold = 0.3, jitter = 1;
  std::optional<double> method, depth, gamma;

  /// Returns celltrace's options.
  std::vector<std::string> options() const;
};

/// The file of the picture.
struct FileChoice {
  char type = 0; ///< a letter of POV-Ray's; 0: none was named
  bool is_grey = false;
  std::optional<double> bits;  ///< a channel
  std::optional<double> gamma; ///< none: sRGB
  double compression = 0;

  /// Returns celltrace's options, but for the type.
  std::vector<std::string> options() const;
};

/// Returns celltrace's name of a file type that POV-Ray has a letter for, in either case. Empty: it has none.
std::string_view file_type_name(char letter);

/// Kinds of messages that are not printed, and files that get some.
struct MessageChoice {
  std::map<std::string, bool, std::less<>> printed;      ///< kinds that something was said of
  std::map<std::string, std::string, std::less<>> files; ///< by kind
  bool appends = false;

  /// Returns celltrace's options.
  std::vector<std::string> options() const;
};

} // namespace celltrace::cli
