// What patterns derive from: how the stages of textures treat them. Kernel dialect.
#pragma once

#include "kernel/records.hpp"

namespace celltrace::kernel {

/// Where in local store a pattern's code is: always there, for little code that scenes are full of; in the
/// module of patterns; or in that of the noise.
enum class PatternCode : uint32_t { resident, plain, noise };

/// A number at every point, which a map blends by.
struct BlendPattern {
  static constexpr bool kIsList = false;
  static constexpr PatternCode kCode = PatternCode::plain;
  static constexpr bool kDisturbs = false;
};

/// The number of a map's entry at every point.
struct ListPattern : BlendPattern {
  static constexpr bool kIsList = true;
};

/// Its code is with the noise's, into which it is inlined always.
struct NoisePattern : BlendPattern {
  static constexpr PatternCode kCode = PatternCode::noise;

  static bool has_first_generator(const PatternRecord& r) {
    return (r.kind_and_flags & pattern_flag::first_generator) != 0;
  }
};

} // namespace celltrace::kernel
