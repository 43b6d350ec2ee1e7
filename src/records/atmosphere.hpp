// Fogs and rainbows. Kernel dialect.
#pragma once

#include "records/pattern.hpp"

#include <stdint.h>

namespace celltrace::kernel {

namespace fog_flag {
constexpr uint32_t ground = 0x1;          ///< the fog grows thinner with height
constexpr uint32_t turbulent = 0x2;       ///< `turbulence` thins the fog out in places
constexpr uint32_t first_generator = 0x4; ///< noise generator 1, as with pattern_flag::first_generator
} // namespace fog_flag

/// A fog. Heights are measured along `up` in units of the fog's altitude, from 0 where it begins to thin out.
struct alignas(128) FogRecord {
  float colour[3]; ///< colour of the light that the fog adds
  float least;     ///< least share of light that passes at any depth
  float tint[3];   ///< colour factors of the light that passes
  float inverse_distance;
  float up[3]; ///< unit vector divided by the altitude
  float offset;
  uint32_t flags;
  float turbulence_depth;
  TurbulenceWords turbulence;
  float turbulence_offset[3]; ///< added to points after these are multiplied by the turbulence amount
  uint32_t unused[9];
};
static_assert(sizeof(FogRecord) == 128, "one a line");

/// A rainbow around the axis `direction`. `direction`, `up` and `right` are unit vectors at right angles to
/// each other. Angles are in turns.
struct alignas(128) RainbowRecord {
  float direction[3];
  float angle; ///< angle between the axis and the middle of the bow
  float up[3];
  float inverse_width;
  float right[3];
  float inverse_distance;
  float jitter;       ///< amplitude of random moves of the position across the bow that selects a colour
  float falloff, arc; ///< angles along the bow from `up`: where it begins to fade, and where it ends
  float inverse_fade; ///< 1 / (arc - falloff); 0: the ends do not fade
  uint32_t entries;   ///< offset of the first MapEntryRecord of the colour map
  uint32_t entry_count;
  uint32_t unused[14];
};
static_assert(sizeof(RainbowRecord) == 128, "one a line");

} // namespace celltrace::kernel
