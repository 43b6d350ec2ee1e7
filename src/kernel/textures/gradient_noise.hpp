// Noise of POV-Ray's generator 3: Perlin's, from gradients at lattice points (Perlin 1985). Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/textures/features.hpp"
#include "kernel/textures/noise.hpp"

namespace celltrace::kernel::noise {

template <class Spu> class GradientNoise {
public:
  using S = typename Spu::rare_simd;
  using F = typename S::F;

  /// Reads the GradientRecords at offset `table`.
  GradientNoise(SceneAccess<Spu>& scene, uint32_t table) : scene_(scene), table_(table) {}

  CELLTRACE_ONE_COPY F value(const V3<S>& p) const {
    constexpr float kShift = 0.023157213f; // fraction of POV-Ray's shift of points by 10,000,000.023
    constexpr uint32_t kCells = 10000000;  // whole part of that shift, added to numbers of cells
    F sum(0.0f);
    const V3<S> shifted = {p.x + F(kShift), p.y + F(kShift), p.z + F(kShift)};
    for_each_cell_of<S>(shifted, [&](uint32_t lanes, const uint32_t(&cell)[3], const V3<S>& from) {
      F one(0.0f);
      for (uint32_t corner = 0; corner < 8; ++corner) {
        const uint32_t step[3] = {corner & 1, corner >> 1 & 1, corner >> 2};
        uint32_t number = at(cell[0] + kCells + step[0]).next;
        number = at(number + cell[1] + kCells + step[1]).next;
        const GradientRecord r = at(number + cell[2] + kCells + step[2]);
        const V3<S> to = {from.x - F(static_cast<float>(step[0])), from.y - F(static_cast<float>(step[1])),
                          from.z - F(static_cast<float>(step[2]))};
        const F weight = share(from.x, step[0]) * share(from.y, step[1]) * share(from.z, step[2]);
        one = one + dot<S>(splat3<S>(r.gradient), to) * weight;
      }
      sum = S::select(S::M::from_bits(lanes), one, sum);
    });
    return S::min(S::max(sum + F(0.4925f), F(0.0f)), F(1.0f));
  }

  CELLTRACE_ONE_COPY F spread_value(const V3<S>& p) const {
    const F noise = value(p);
    return S::min(S::max(spread<S>(noise, false), F(0.0f)), F(1.0f));
  }
  CELLTRACE_ONE_COPY F turbulence_value(const V3<S>& p, const TurbulenceWords& t) const {
    F sum = spread_value(p);
    float scale = t.lambda, strength = t.omega;
    for (uint32_t octave = 1; octave < t.octaves; ++octave) {
      const F noise = value(p * F(scale));
      sum = sum + spread<S>(noise, false) * F(strength);
      scale *= t.lambda;
      strength *= t.omega;
    }
    return sum;
  }

private:
  GradientRecord at(uint32_t number) const {
    return *scene_.template pattern_table<GradientRecord>(
        table_ + (number & (kGradients - 1)) * static_cast<uint32_t>(sizeof(GradientRecord)));
  }
  [[gnu::always_inline]] static F share(const F& from, uint32_t step) {
    const F upper = from * from * (F(3.0f) - from - from);
    return step != 0 ? upper : F(1.0f) - upper;
  }

  SceneAccess<Spu>& scene_;
  uint32_t table_;
};

} // namespace celltrace::kernel::noise
