// Patterns where memory is direct: what is known of points is kept for those beside them. Kernel dialect.
#pragma once

#include "kernel/direct/feature_neighbours.hpp"
#include "kernel/direct/fractal_squares.hpp"
#include "kernel/direct/inner_cells.hpp"

namespace celltrace::kernel {

struct DirectPatterns {
  template <class Spu> struct KnownPatterns {
    using S = typename Spu::rare_simd;
    NeighbourCache<S>* neighbours = nullptr; ///< random points for points that are close together; or null
    FractalValues<S, kBundlePackets<Spu>>* fractals = nullptr; ///< at points that will be asked for; or null
  };
  /// As long as it lives, random points are kept.
  template <class Spu> class KeptNeighbours {
  public:
    explicit KeptNeighbours(SceneAccess<Spu>& scene) : scene_(scene) { begin(); }
    ~KeptNeighbours() { scene_.known_patterns().neighbours = nullptr; }
    KeptNeighbours(const KeptNeighbours&) = delete;
    KeptNeighbours& operator=(const KeptNeighbours&) = delete;

  private:
    /// Not inlined: GCC 12 would say that the pointer outlives the cache, whatever the destructor does.
    [[gnu::noinline]] void begin() { scene_.known_patterns().neighbours = &cache_; }

    SceneAccess<Spu>& scene_;
    NeighbourCache<typename Spu::rare_simd> cache_;
  };
  /// As long as it lives, values of fractals are.
  template <class Spu> class KeptFractals {
  public:
    explicit KeptFractals(SceneAccess<Spu>& scene) : scene_(scene) { begin(); }
    ~KeptFractals() { scene_.known_patterns().fractals = nullptr; }
    KeptFractals(const KeptFractals&) = delete;
    KeptFractals& operator=(const KeptFractals&) = delete;

  private:
    /// Not inlined, for the same reason.
    [[gnu::noinline]] void begin() { scene_.known_patterns().fractals = &values_; }

    SceneAccess<Spu>& scene_;
    FractalValues<typename Spu::rare_simd, kBundlePackets<Spu>> values_;
  };

  template <class S> using InnerCells = kernel::InnerCells<S>;

  /// Whether a fractal's numbers are squared. Finds its values then.
  template <class Spu, class S>
  [[gnu::always_inline]] static bool find_squares(SceneAccess<Spu>& scene, const Complex<S>& at,
                                                  const PatternRecord& r, typename S::F& value) {
    if (!SquareIteration::describes(r)) return false;
    value = FractalSquares::value_of_squares(scene, at, SquareIteration{r});
    return true;
  }
};

} // namespace celltrace::kernel
