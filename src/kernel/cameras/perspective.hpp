// The perspective camera: rays from a point through a plane. Kernel dialect.
#pragma once

#include "kernel/cameras/camera_view.hpp"

namespace celltrace::kernel {

struct PerspectiveCamera {
  static constexpr const char* kName = "perspective";
  static constexpr bool kIsFlat = true;
  static constexpr SharedByRays kShared = SharedByRays::origin;
};

} // namespace celltrace::kernel
