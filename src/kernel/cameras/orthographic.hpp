// The orthographic camera: parallel rays from a plane. Kernel dialect.
#pragma once

#include "kernel/cameras/camera_view.hpp"

namespace celltrace::kernel {

struct OrthographicCamera {
  static constexpr const char* kName = "orthographic";
  static constexpr bool kIsFlat = true;
  static constexpr SharedByRays kShared = SharedByRays::direction;
};

} // namespace celltrace::kernel
