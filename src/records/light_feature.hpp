// Features of scenes and frames that change how light is followed. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// Bits for rare features of a scene or frame; code for a feature runs only if its bit is set.
namespace light_feature {
constexpr uint32_t atmosphere = 0x1; ///< fogs or rainbows
constexpr uint32_t fading = 0x2;     ///< interiors that fade, or whose surfaces dim what they transmit
/// Shadow rays go from surface to surface, as the light that a surface lets through depends on more than the
/// point.
constexpr uint32_t stepwise = 0x4;
constexpr uint32_t by_surface = 0x8;  ///< some objects have object_flag::by_surface
constexpr uint32_t projectors = 0x10; ///< some lights have projectors
/// A shadow ray that crosses two translucent surfaces within kShadowEpsilon may continue behind the second
/// one, also without `stepwise`.
constexpr uint32_t near_surfaces = 0x200;
/// With `stepwise`: fading interiors are the only reason for `stepwise`; the light that surfaces let through
/// depends on points alone.
constexpr uint32_t only_fading = 0x400;
constexpr uint32_t unseen = 0x1000; ///< some objects have object_flag::no_image
/// With `near_surfaces`: the surfaces that a shadow ray crosses depend on where the ray restarted last.
constexpr uint32_t restarts = 0x2000;
// Bits of frames, not of scene images:
constexpr uint32_t alpha = 0x20; ///< the transparency of each pixel is also computed
/// With `alpha`: only rays that came by a mirror see the sky and the background.
constexpr uint32_t no_backdrop = 0x40;
/// With `alpha`: reflected rays see FrameBlock::background; other rays see a part of it, as the background is
/// transparent.
constexpr uint32_t mirrored_background = 0x800;
constexpr uint32_t first_hits = 0x80; ///< the first hit of each primary ray is also written
constexpr uint32_t jitter = 0x100;    ///< places on lights are moved, differently in each lane
} // namespace light_feature

} // namespace celltrace::kernel
