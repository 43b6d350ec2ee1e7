// Writes a camera in POV-Ray's language.
#pragma once

#include "celltrace/scene.hpp"

#include <string>

namespace celltrace::viewer {

/// Returns a `camera` block. A scene with it in place of its own camera has this camera to the last bit.
/// `width` and `height` of the picture are for a remark.
std::string camera_text(const Camera& camera, int width, int height);

} // namespace celltrace::viewer
