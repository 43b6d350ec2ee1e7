// POV-Ray, run as a program on scene files.
#pragma once

#include "stopwatch.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace celltrace::compare {

/// A picture of a scene file by one program or the other.
struct PictureRequest {
  std::filesystem::path scene;
  std::filesystem::path picture; ///< PNG to write
  int width = 0, height = 0;
  unsigned threads = 1;
};

struct PictureTimes {
  Seconds process; ///< all of it: start, reading the scene, tracing, writing the picture
  Seconds trace;   ///< what POV-Ray calls trace time
};

/// "POV-Ray 3.7.0.10"; none if there is no povray on PATH.
std::optional<std::string> povray_version();

/// Without anti-aliasing and display. Throws Error if POV-Ray fails.
PictureTimes render_with_povray(const PictureRequest& request);

} // namespace celltrace::compare
