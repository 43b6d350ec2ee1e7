// POV-Ray's progress messages on stderr, which programs that start povray look for.
#pragma once

#include "cli/command_line.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iosfwd>

namespace celltrace::cli {

/// The progress messages that a program waits for.
struct PovReportParts {
  bool progress = false; ///< "Rendered 1024 of 4096 pixels (25%)"
  bool steps = false;    ///< "==== [Parsing...]", "Rendering frame 1 of 3", "Trace Time:"
};

/// Returns the messages for a request: none for a terminal, or a quiet run. A request in place of povray gets
/// all of them, but no progress if verbose is off; any other request gets all of them if verbose is on.
PovReportParts report_parts(const RenderRequest& request, bool is_terminal);

/// Writes lines as POV-Ray does: progress lines end with a carriage return only.
class PovReport {
public:
  PovReport(std::ostream& out, PovReportParts parts) : out_(out), parts_(parts) {}
  PovReport(const PovReport&) = delete;
  PovReport& operator=(const PovReport&) = delete;

  /// Begins a frame; `index` counts from 0 among the `count` frames of an animation.
  void begin_frame(std::size_t index, std::size_t count);
  void begin_parsing();
  /// Begins the rendering of the pixels in the picture's region.
  void begin_rendering(const RenderOptions& options);
  /// Reports progress, at most ten times a second, and at the last pixel. `fraction` of the pixels is 0..1.
  void update(double fraction);
  /// Ends the last progress line. `seconds` is the time of tracing.
  void finish(double seconds);

private:
  using Clock = std::chrono::steady_clock;

  std::ostream& out_;
  PovReportParts parts_;
  std::uint64_t pixels_ = 0;
  std::uint64_t written_ = 0; ///< pixels in the last line of progress
  Clock::time_point next_;
};

/// Returns a time as "0 hours  1 minutes  2 seconds (62.345 seconds)", in POV-Ray's columns.
std::string pov_time(double seconds);

} // namespace celltrace::cli
