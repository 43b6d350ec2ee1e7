// Reduces the quality of pictures to render them faster.
#pragma once

#include "celltrace/scene.hpp"

namespace celltrace {

/// The lowest of POV-Ray's quality levels that leaves nothing out; RenderOptions::quality describes the other
/// levels.
inline constexpr int kFullQuality = 9;

/// Returns the scene at this quality. Does not turn off secondary rays: the caller does, below kRaysGoOn.
Scene at_quality(const Scene& scene, int quality);
inline constexpr int kRaysGoOn = 6;

} // namespace celltrace
