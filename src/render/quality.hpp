// Pictures that leave something out to be done sooner.
#pragma once

#include "celltrace/scene.hpp"

namespace celltrace {

/// POV-Ray's levels of quality: RenderOptions::quality says what each leaves out. From here on, all is there.
inline constexpr int kFullQuality = 9;

/// The scene as it is at this quality, but for rays that go on from surfaces: below kRaysGoOn none does.
Scene at_quality(const Scene& scene, int quality);
inline constexpr int kRaysGoOn = 6;

} // namespace celltrace
