// POV-Ray's progress on stderr: programs that start povray look for its words there.
#pragma once

#include "cli/command_line.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iosfwd>

namespace celltrace::cli {

/// The words of POV-Ray's progress that a program waits for.
struct PovReportParts {
  bool progress = false; ///< "Rendered 1024 of 4096 pixels (25%)"
  bool steps = false;    ///< "==== [Parsing...]", "Rendering frame 1 of 3", "Trace Time:"
};

/// The parts of a request's report. None are for a terminal, or a quiet run. Else a request in place of
/// povray has all of them, but no progress if it is not to be verbose; any other one if it is to be verbose.
PovReportParts report_parts(const RenderRequest& request, bool is_terminal);

/// Writes lines as POV-Ray does: those of progress end with a carriage return only.
class PovReport {
public:
  PovReport(std::ostream& out, PovReportParts parts) : out_(out), parts_(parts) {}
  PovReport(const PovReport&) = delete;
  PovReport& operator=(const PovReport&) = delete;

  /// `index` counts from 0 among the `count` frames of an animation.
  void begin_frame(std::size_t index, std::size_t count);
  void begin_parsing();
  /// The pixels are those of the picture's region.
  void begin_rendering(const RenderOptions& options);
  /// At most ten lines a second, and that of the last pixel. `fraction` of the pixels is 0..1.
  void update(double fraction);
  /// Ends the last line of progress. `seconds` is the time that tracing took.
  void finish(double seconds);

private:
  using Clock = std::chrono::steady_clock;

  std::ostream& out_;
  PovReportParts parts_;
  std::uint64_t pixels_ = 0;
  std::uint64_t written_ = 0; ///< pixels in the last line of progress
  Clock::time_point next_;
};

/// "0 hours  1 minutes  2 seconds (62.345 seconds)", in POV-Ray's columns.
std::string pov_time(double seconds);

} // namespace celltrace::cli
