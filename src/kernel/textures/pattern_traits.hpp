// What patterns derive from: how the stages of textures treat them. Kernel dialect.
#pragma once

namespace celltrace::kernel {

/// Where in local store a pattern's code is: always there, for little code that scenes are full of; in the
/// module of patterns; in that of the noise; or in that of rare patterns.
enum class PatternCode : uint32_t { resident, plain, noise, rare };

/// A number at every point, which a map blends by.
struct BlendPattern {
  static constexpr bool kIsList = false;
  static constexpr bool kIsColour = false;
  static constexpr PatternCode kCode = PatternCode::plain;
  static constexpr bool kDisturbs = false;
  static constexpr bool kReadsNoise = false;
  static constexpr bool kIsShifted = false;
  static constexpr bool kReadsSurface = false; ///< its value depends on more than points
};

/// The number of a map's entry at every point.
struct ListPattern : BlendPattern {
  static constexpr bool kIsList = true;
};

/// Its code is with the noise's, into which it is inlined always. Noise of a table reads the scene: it stands
/// in a statement of its own, or compilers' orders of evaluation would show in modelled cycles.
struct NoisePattern : BlendPattern {
  static constexpr PatternCode kCode = PatternCode::noise;
  static constexpr bool kReadsNoise = true; ///< its value depends on the generator
};

/// Has no noise of its own, but turbulent values, times the first number of its turbulence, are added to z,
/// or to x of marble, wherever the pattern is asked.
struct ShiftedPattern : BlendPattern {
  static constexpr bool kReadsNoise = true;
  static constexpr bool kIsShifted = true;
};

/// Few scenes have it; it may read a table of the scene image. Its functions are inlined always.
struct RarePattern : BlendPattern {
  static constexpr PatternCode kCode = PatternCode::rare;
};

/// A colour at every point, with its transparency, in place of a number and a map: colour(scene, points,
/// record). It is a pigment, or an entry of a pigment's map, or the pattern of a pigment_pattern.
struct ColourPattern : RarePattern {
  static constexpr bool kIsColour = true;
};

} // namespace celltrace::kernel
