// Patterns where local store is scarce: nothing is kept from point to point. Kernel dialect.
#pragma once

#include "kernel/scene_access.hpp"

namespace celltrace::kernel {

struct LocalPatterns {
  template <class Spu> struct PatternCaches {};
  template <class Spu> struct ScopedNeighbours {
    explicit ScopedNeighbours(SceneAccess<Spu>&) {}
  };
  template <class Spu> struct ScopedFractals {
    explicit ScopedFractals(SceneAccess<Spu>&) {}
  };

  template <class S> struct InnerCells {
    static constexpr int32_t kTaken = 0;
    template <class... Arguments> static constexpr bool suffice(const Arguments&...) { return false; }
    template <class... Arguments> static constexpr bool suffice_in(const Arguments&...) { return false; }
    /// Returns a bound for the usual metric, and 0, which is no bound, for other metrics.
    [[gnu::always_inline]] static typename S::F least_along(const typename S::F& offset, float metric) {
      return metric == 2.0f ? offset * offset : typename S::F(0.0f);
    }
  };

  template <class Spu, class S>
  static constexpr bool find_squares(SceneAccess<Spu>&, const Complex<S>&, const PatternRecord&,
                                     const typename S::F&) {
    return false;
  }
};

} // namespace celltrace::kernel
