// What patterns derive from: how the stages of textures treat them. Kernel dialect.
#pragma once

#include "kernel/records.hpp"

namespace celltrace::kernel {

/// A number at every point, which a map blends by.
struct BlendPattern {
  static constexpr bool kIsList = false;
  static constexpr bool kNeedsNoise = false;
  static constexpr bool kDisturbs = false;
};

/// The number of a map's entry at every point.
struct ListPattern : BlendPattern {
  static constexpr bool kIsList = true;
};

/// Its code is with the noise's, into which it is inlined always.
struct NoisePattern : BlendPattern {
  static constexpr bool kNeedsNoise = true;

  static bool has_first_generator(const PatternRecord& r) {
    return (r.kind_and_flags & pattern_flag::first_generator) != 0;
  }
};

} // namespace celltrace::kernel
