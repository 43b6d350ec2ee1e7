// The features of scenes and frames that light may meet on its way. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// What light may meet on its way that few scenes have.
namespace light_way {
constexpr uint32_t atmosphere = 0x1; ///< fogs or rainbows
constexpr uint32_t fading = 0x2;     ///< interiors that fade, or whose surfaces dim what they transmit
/// Shadow rays go from surface to surface: what these let through depends on more than points of them.
constexpr uint32_t stepwise = 0x4;
constexpr uint32_t by_surface = 0x8;  ///< some objects are object_flag::by_surface
constexpr uint32_t projectors = 0x10; ///< of lights
/// Shadow rays that cross two translucent surfaces within kShadowEpsilon may go on behind the second one: in
/// those, too, that are not `stepwise`.
constexpr uint32_t near_surfaces = 0x200;
/// With `stepwise`: only because interiors fade. What surfaces let through depends on points of them alone.
constexpr uint32_t only_fading = 0x400;
constexpr uint32_t unseen = 0x1000; ///< some objects are object_flag::no_image
/// With `near_surfaces`: which surfaces a shadow ray crosses depends on where it started last.
constexpr uint32_t restarts = 0x2000;
// Of frames alone, not of scene images:
constexpr uint32_t alpha = 0x20; ///< how clear each pixel is is wanted, too
/// With `alpha`: only rays that came by a mirror see sky and background.
constexpr uint32_t no_backdrop = 0x40;
/// With `alpha`: FrameBlock::background is what reflected rays see, others less of it, as it is clear.
constexpr uint32_t mirrored_background = 0x800;
constexpr uint32_t first_hits = 0x80; ///< what each primary ray hits is wanted, too
constexpr uint32_t jitter = 0x100;    ///< places of lights are moved, in each lane otherwise
} // namespace light_way

} // namespace celltrace::kernel
