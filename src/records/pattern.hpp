// Patterns: the space that they are in, and the maps of their values. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

// Textures. What a pattern's values stand for is said by entries of a map, and an entry may be a map again.

namespace pattern_flag {
constexpr uint32_t kind_mask = 0xFF; ///< the place of its kind in the list of textures/list.hpp
constexpr uint32_t wave_shift = 8;   ///< a PatternWave
constexpr uint32_t wave_mask = 0x7;
constexpr uint32_t turbulent = 0x800;        ///< `turbulence` displaces points
constexpr uint32_t average = 0x1000;         ///< all entries, by weights that are their positions
constexpr uint32_t first_generator = 0x2000; ///< of noise: scaled as POV-Ray's generator 1 does
constexpr uint32_t nested = 0x4000;          ///< of a pigment: an entry or the pattern is a map
constexpr uint32_t gradient_noise = 0x8000;  ///< of noise: POV-Ray's generator 3
constexpr uint32_t at_features = 0x10000;    ///< of noise: at the nearest of the random points
constexpr uint32_t shifted = 0x20000;        ///< a ShiftedPattern that has turbulence
constexpr uint32_t uv_mapping = 0x40000;     ///< `to_space` is from surface coordinates (u, v, 0)
constexpr uint32_t never_repeats = 0x80000;  ///< values above 1 stay what they are
/// Of a map that is in no other one: everything in it is at points of this pattern's own space, not of the
/// world, so that maps which differ by their space alone share what is in them.
constexpr uint32_t relative = 0x100000;
} // namespace pattern_flag
/// What becomes of a pattern's values: POV-Ray's wave forms. `none`: they stay, frequency and phase mean
/// nothing.
enum class PatternWave : uint32_t {
  ramp = 0,
  triangle = 1,
  sine = 2,
  scallop = 3,
  cubic = 4,
  poly = 5,
  none = 6
};

/// Displacement by noise.
struct TurbulenceWords {
  float amount[3];
  float lambda, omega;
  uint32_t octaves;
};

/// Points go through `to_space`, then the steps, then the turbulence if there is any.
struct alignas(128) PatternRecord {
  uint32_t kind_and_flags;
  uint32_t entries; ///< offset of the first MapEntryRecord
  uint32_t entry_count;
  uint32_t steps; ///< offset of the first SpaceStepRecord
  uint32_t step_count;
  float to_space[12]; ///< three rows of four (xyz | offset)
  float frequency, phase, wave_exponent;
  TurbulenceWords turbulence;
  float parameter[5]; ///< by kind
  /// Offset of the table that its kind reads: FeatureRecords, WaveRecords, a SlopeRecord, the PatternRecord
  /// of a pigment that is the pattern, a CsgRecord that says what is in an object, or with `gradient_noise`
  /// GradientRecords, before which there are the FeatureRecords if it reads both. Of fractals: fractal_word.
  uint32_t table;
};
static_assert(sizeof(PatternRecord) == 128, "one a line");

/// What points go through between the world and a pattern's space.
enum class WarpKind : uint32_t {
  turbulence = 0,
  repeat = 1,
  black_hole = 2,
  planar = 3,
  cylindrical = 4,
  spherical = 5,
  toroidal = 6
};
constexpr uint32_t kWarpKinds = 7;
namespace warp_flag {
constexpr uint32_t kind_mask = 0xFF;
constexpr uint32_t axis_shift = 8; ///< of a repeat: 0 to 2
constexpr uint32_t inverse = 0x400;
} // namespace warp_flag

/// PatternRecord::table of a fractal.
namespace fractal_word {
constexpr uint32_t exponent_mask = 0xFF;
constexpr uint32_t exterior_shift = 8; ///< POV-Ray's number of what is counted, 0 to 8
constexpr uint32_t interior_shift = 12;
constexpr uint32_t type_mask = 0xF;
constexpr uint32_t magnet_shift = 16; ///< 0 to 2
constexpr uint32_t magnet_mask = 0x3;
constexpr uint32_t julia = 0x40000;
} // namespace fractal_word

/// A warp, then a map. `value`: of a repeat, its width, 1 or -1 by axis as it flips, and the offset; of a
/// black hole, its centre, radius, strength and falloff, and the distances at which it repeats, by axis, 0
/// where it does not, while `turbulence` is that of the copies; of the others, their orientation, a unit
/// vector, the distance's exponent, and the major radius.
struct alignas(128) SpaceStepRecord {
  TurbulenceWords turbulence;
  float to_space[12];
  uint32_t kind_and_flags; ///< WarpKind and warp_flag
  uint32_t table;          ///< of a black hole: offset of the FeatureRecords
  float value[12];
};
static_assert(sizeof(SpaceStepRecord) == 128, "one a line");

/// Of a slope: its value is factor * (1 - a) + altitude . point + offset, where a is the angle of the
/// surface's normal to the direction, in half turns.
struct alignas(32) SlopeRecord {
  float direction[3]; ///< of unit length
  float factor;
  float altitude[3];
  float offset;
};
static_assert(sizeof(SlopeRecord) == 32, "four a line");

/// What stands for a value of a pattern.
struct alignas(32) MapEntryRecord {
  float position; ///< the pattern's value, or an average's weight
  /// Of the interval from the entry before. 0 where there is none, or where that one counts alone: it is the
  /// same.
  float inverse_width;
  float rgb[3]; ///< of a pigment without a map
  float filter, transmit;
  /// Pigments: offset of a PatternRecord, whose map it is, or kNoOffset. Normals: of a NormalRecord.
  /// Textures: of a MaterialRecord. Slope maps: means nothing; rgb[0] is the height there, rgb[1] the slope.
  uint32_t child;
};
static_assert(sizeof(MapEntryRecord) == 32, "four a line");

} // namespace celltrace::kernel
