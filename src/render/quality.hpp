// Reduces the quality of pictures to render them faster.
#pragma once

#include "celltrace/scene.hpp"

namespace celltrace {

/// The lowest of POV-Ray's quality levels that leaves nothing out; RenderOptions::quality describes the
/// others.
inline constexpr int kFullQuality = 9;

/// Returns the scene at this quality, except for secondary rays: below kRaysGoOn there are none.
Scene at_quality(const Scene& scene, int quality);
inline constexpr int kRaysGoOn = 6;

} // namespace celltrace
