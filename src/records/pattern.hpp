// Patterns: their spaces, and the maps of their values. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

// The entries of a map say what the values of a pattern stand for. An entry may be a map again.

namespace pattern_flag {
constexpr uint32_t kind_mask = 0xFF; ///< index of the pattern's type in textures/list.hpp
constexpr uint32_t wave_shift = 8;   ///< shift of a PatternWave
constexpr uint32_t wave_mask = 0x7;
constexpr uint32_t turbulent = 0x800;        ///< `turbulence` displaces points
constexpr uint32_t average = 0x1000;         ///< all entries count, weighted by their positions
constexpr uint32_t first_generator = 0x2000; ///< noise is scaled as by POV-Ray's generator 1
constexpr uint32_t nested = 0x4000;          ///< pigments: an entry or the pattern itself is a map
constexpr uint32_t gradient_noise = 0x8000;  ///< noise is POV-Ray's generator 3
constexpr uint32_t at_features = 0x10000;    ///< noise is evaluated at the nearest feature point
constexpr uint32_t shifted = 0x20000;        ///< a ShiftedPattern that has turbulence
constexpr uint32_t uv_mapping = 0x40000;     ///< `to_space` is from surface coordinates (u, v, 0)
constexpr uint32_t never_repeats = 0x80000;  ///< values above 1 are not wrapped
/// For a map that is in no other map: its contents are evaluated at points of this pattern's own space, not
/// of the world. Maps that differ only by their spaces can thus share their contents.
constexpr uint32_t relative = 0x100000;
} // namespace pattern_flag
/// Wave form of POV-Ray that a pattern's values go through. `none` leaves values as they are; frequency and
/// phase are then unused.
enum class PatternWave : uint32_t {
  ramp = 0,
  triangle = 1,
  sine = 2,
  scallop = 3,
  cubic = 4,
  poly = 5,
  none = 6
};

/// Parameters of displacement by noise.
struct TurbulenceWords {
  float amount[3];
  float lambda, omega;
  uint32_t octaves;
};

/// A pattern. Points go through `to_space`, then the steps, then the turbulence if there is any.
struct alignas(128) PatternRecord {
  uint32_t kind_and_flags;
  uint32_t entries; ///< offset of the first MapEntryRecord
  uint32_t entry_count;
  uint32_t steps; ///< offset of the first SpaceStepRecord
  uint32_t step_count;
  float to_space[12]; ///< three rows of four (xyz | offset)
  float frequency, phase, wave_exponent;
  TurbulenceWords turbulence;
  float parameter[5]; ///< meaning depends on the kind
  /// Offset of the table that the kind reads: FeatureRecords, WaveRecords, a SlopeRecord, the PatternRecord
  /// of a pigment that is the pattern, or a CsgRecord that decides what is inside an object. With
  /// `gradient_noise`: GradientRecords, preceded by FeatureRecords if the kind reads both. Fractals: a
  /// fractal_word.
  uint32_t table;
};
static_assert(sizeof(PatternRecord) == 128, "one a line");

/// Kind of displacement of points between the world and a pattern's space.
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
constexpr uint32_t axis_shift = 8; ///< axis of a repeat: 0 to 2
constexpr uint32_t inverse = 0x400;
} // namespace warp_flag

/// PatternRecord::table of a fractal.
namespace fractal_word {
constexpr uint32_t exponent_mask = 0xFF;
constexpr uint32_t exterior_shift = 8; ///< POV-Ray's number of the exterior's colouring, 0 to 8
constexpr uint32_t interior_shift = 12;
constexpr uint32_t type_mask = 0xF;
constexpr uint32_t magnet_shift = 16; ///< type of magnet, 0 to 2
constexpr uint32_t magnet_mask = 0x3;
constexpr uint32_t julia = 0x40000;
} // namespace fractal_word

/// A warp followed by an affine map. `value` of a repeat: its width, 1 or -1 (flipped) for each axis, and the
/// offset; of a black hole: its centre, radius, strength, falloff, and the distance of its copies for each
/// axis, 0 if it is not repeated (`turbulence` then is that of the copies); of other warps: the orientation
/// (a unit vector), the distance's exponent, and the major radius.
struct alignas(128) SpaceStepRecord {
  TurbulenceWords turbulence;
  float to_space[12];
  uint32_t kind_and_flags; ///< WarpKind and warp_flag
  uint32_t table;          ///< for a black hole: offset of the FeatureRecords
  float value[12];
};
static_assert(sizeof(SpaceStepRecord) == 128, "one a line");

/// Parameters of a slope pattern, whose value is factor * (1 - a) + altitude . point + offset, where a is the
/// angle between the surface's normal and the direction, in half turns.
struct alignas(32) SlopeRecord {
  float direction[3]; ///< of unit length
  float factor;
  float altitude[3];
  float offset;
};
static_assert(sizeof(SlopeRecord) == 32, "four a line");

/// An entry of a map: what a value of a pattern stands for.
struct alignas(32) MapEntryRecord {
  float position; ///< value of the pattern, or weight in an average
  /// 1 / width of the interval from the previous entry; 0 if there is no previous entry, or if both entries
  /// are equal, so that the previous one alone counts.
  float inverse_width;
  float rgb[3]; ///< colour of a pigment without a map
  float filter, transmit;
  /// Pigments: offset of a PatternRecord with the map of this entry, or kNoOffset. Normals: offset of a
  /// NormalRecord. Textures: offset of a MaterialRecord. Slope maps: unused; rgb[0] is the height, rgb[1] the
  /// slope.
  uint32_t child;
};
static_assert(sizeof(MapEntryRecord) == 32, "four a line");

} // namespace celltrace::kernel
