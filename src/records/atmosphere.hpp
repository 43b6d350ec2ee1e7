// Fogs and rainbows. Kernel dialect.
#pragma once

#include "records/pattern.hpp"

#include <stdint.h>

namespace celltrace::kernel {

namespace fog_flag {
constexpr uint32_t ground = 0x1;          ///< thins out with the height
constexpr uint32_t turbulent = 0x2;       ///< `turbulence` clears it
constexpr uint32_t first_generator = 0x4; ///< of noise, as pattern_flag's
} // namespace fog_flag

/// Heights are along `up`, in units of the altitude, and 0 where the fog begins to thin out.
struct alignas(128) FogRecord {
  float colour[3]; ///< of what it adds
  float least;     ///< share of light that passes in any case
  float tint[3];   ///< of what passes
  float inverse_distance;
  float up[3]; ///< over the altitude
  float offset;
  uint32_t flags;
  float turbulence_depth;
  TurbulenceWords turbulence;
  float turbulence_offset[3]; ///< added to points that are multiplied by its amount
  uint32_t unused[9];
};
static_assert(sizeof(FogRecord) == 128, "one a line");

/// A bow around the axis `direction`, in the plane of `up` and `right`; all three of unit length and at right
/// angles. Angles are in turns.
struct alignas(128) RainbowRecord {
  float direction[3];
  float angle; ///< from the axis to the middle of the bow
  float up[3];
  float inverse_width;
  float right[3];
  float inverse_distance;
  float jitter;       ///< of the place across the bow, by which the colours are chosen
  float falloff, arc; ///< along the bow from `up`: where it begins to fade and where it ends
  float inverse_fade; ///< of the way in between; 0: it does not fade
  uint32_t entries;   ///< offset of the first MapEntryRecord, of colours
  uint32_t entry_count;
  uint32_t unused[14];
};
static_assert(sizeof(RainbowRecord) == 128, "one a line");

} // namespace celltrace::kernel
