// Base classes of patterns, which determine how the stages of textures treat them. Kernel dialect.
#pragma once

namespace celltrace::kernel {

/// Location of a pattern's code in local store: `resident` for short code of frequent patterns, `plain` in
/// the module of patterns, `noise` in that of noise, `rare` in that of rare patterns, or `function` in that of
/// functions.
enum class PatternCode : uint32_t { resident, plain, noise, rare, function };

/// A pattern with a number at every point, by which a map blends.
struct BlendPattern {
  static constexpr bool kIsList = false;
  static constexpr bool kIsColour = false;
  static constexpr PatternCode kCode = PatternCode::plain;
  static constexpr bool kDisturbs = false;
  static constexpr bool kReadsNoise = false;
  static constexpr bool kIsShifted = false;
  static constexpr bool kReadsSurface = false; ///< its value depends on more than points
};

/// A pattern with the index of a map's entry at every point.
struct ListPattern : BlendPattern {
  static constexpr bool kIsList = true;
};

/// A pattern of noise, whose code is always inlined into that of noise. Noise of a table reads the scene, and
/// is evaluated in a statement of its own, as otherwise compilers' orders of evaluation would change modelled
/// cycles.
struct NoisePattern : BlendPattern {
  static constexpr PatternCode kCode = PatternCode::noise;
  static constexpr bool kReadsNoise = true; ///< its value depends on the generator
};

/// A pattern without noise of its own. A turbulent value, times the first number of its turbulence, is added
/// to z, or to x of marble, wherever the pattern is evaluated.
struct ShiftedPattern : BlendPattern {
  static constexpr bool kReadsNoise = true;
  static constexpr bool kIsShifted = true;
};

/// A rare pattern, which may read a table of the scene image. Its functions are always inlined.
struct RarePattern : BlendPattern {
  static constexpr PatternCode kCode = PatternCode::rare;
};

/// A pattern with a colour and its transparency at every point instead of a number: colour(scene, points,
/// record). The pattern is a pigment, an entry of a pigment's map, or that of a pigment_pattern.
struct ColourPattern : RarePattern {
  static constexpr bool kIsColour = true;
};

} // namespace celltrace::kernel
