// Patterns in direct memory: results at points are kept for neighbouring points. Kernel dialect.
#pragma once

#include "kernel/direct/feature_neighbours.hpp"
#include "kernel/direct/fractal_squares.hpp"
#include "kernel/direct/inner_cells.hpp"

namespace celltrace::kernel {

struct DirectPatterns {
  template <class Spu> struct PatternCaches {
    using S = typename Spu::rare_simd;
    NeighbourCache<S>* neighbours = nullptr; ///< feature points for points that are close together; or null
    FractalValues<S, kBundlePackets<Spu>>* fractals = nullptr; ///< values for points of a bundle; or null
  };
  /// Values that are kept in a PatternCaches for the lifetime of this object.
  template <class Spu, class Values, Values* PatternCaches<Spu>::*kMember> class ScopedCache {
  public:
    explicit ScopedCache(SceneAccess<Spu>& scene) : scene_(scene) { begin(); }
    ~ScopedCache() { scene_.pattern_caches().*kMember = nullptr; }
    ScopedCache(const ScopedCache&) = delete;
    ScopedCache& operator=(const ScopedCache&) = delete;

  private:
    /// Not inlined: GCC 12 would warn that the pointer outlives the values, in spite of the destructor.
    [[gnu::noinline]] void begin() { scene_.pattern_caches().*kMember = &values_; }

    SceneAccess<Spu>& scene_;
    Values values_;
  };
  template <class Spu>
  using ScopedNeighbours =
      ScopedCache<Spu, NeighbourCache<typename Spu::rare_simd>, &PatternCaches<Spu>::neighbours>;
  template <class Spu>
  using ScopedFractals = ScopedCache<Spu, FractalValues<typename Spu::rare_simd, kBundlePackets<Spu>>,
                                     &PatternCaches<Spu>::fractals>;

  template <class S> using InnerCells = kernel::InnerCells<S>;

  /// Finds the values of a fractal if it iterates squares. Returns false if it does not.
  template <class Spu, class S>
  [[gnu::always_inline]] static bool find_squares(SceneAccess<Spu>& scene, const Complex<S>& at,
                                                  const PatternRecord& r, typename S::F& value) {
    if (!SquareIteration::describes(r)) return false;
    value = FractalSquares::value_of_squares(scene, at, SquareIteration{r});
    return true;
  }
};

} // namespace celltrace::kernel
