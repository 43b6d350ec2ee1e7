// Shading in local store: short code, lane by lane. Kernel dialect.
#pragma once

#include "kernel/local/spilling_stack.hpp"
#include "kernel/shading/lighting.hpp"
#include "kernel/shading/secondary_rays.hpp"

namespace celltrace::kernel {

struct LocalShading {
  // --- the tree ---

  template <class Spu, uint32_t kResident> using RayStack = SpillingStack<Spu, kResident>;
  /// All rays stay in the packets of their own trees.
  template <class Spu> struct RayPooling {
    static constexpr bool takes(const RayNode&) { return false; }
  };

  // --- surfaces ---

  static constexpr bool kShadesEndsApart = false;
  template <class Spu>
  [[gnu::always_inline]] static void gather_material(const MaterialRecord& r, bool first, uint32_t lanes,
                                                     uint32_t wanted, MaterialLanes<typename Spu::simd>& m) {
    detail::gather_material<Spu>(r, first ? 0xFFFF : lanes, lanes, wanted, m);
  }

  // --- light ---

  /// Clears the light at the beginning of a round.
  template <class S, class LitPoints> static void begin_round(const LightRound& round, const LitPoints&) {
    round.template clear<S>();
  }
  static constexpr bool is_fresh(const LightRound&) { return false; }
  static constexpr bool wants_rays(const LightRound&, uint32_t) { return false; }
  static void end_fresh(const LightRound&) {}
  static constexpr bool is_aimed(uint32_t, uint32_t) { return false; }

  /// Returns false without a test: dark surfaces send on no light anyway.
  template <class Spu>
  static constexpr bool are_dark(const Surfaces<typename Spu::simd>&,
                                 const MaterialLanes<typename Spu::simd>&, uint32_t) {
    return false;
  }
  template <class S>
  static constexpr bool raise_to_whole_power(const typename S::F&, uint32_t, const typename S::F&) {
    return false;
  }

  // --- secondary rays ---

  template <class Spu, class S = typename Spu::simd, class F = typename S::F>
  [[gnu::always_inline]] static void
  find_secondary_rays(const MaterialLanes<S>& m, const F& cosine, const F& fresnel_ratio, float adc_bailout,
                      uint32_t lanes, const F& share, SecondaryRays<S>& all) {
    using R = typename Spu::rare_simd;
    for_each_part<Spu>([&](uint32_t first) {
      const auto part = [first](const auto& values) { return part_of<Spu>(values, first); };
      auto some = SecondaryRays<R>::nothing();
      detail::secondary_rays_of<R>(part(m), part(cosine), part(fresnel_ratio), adc_bailout, part(lanes),
                                   part(share), some);
      all.template set_part<Spu>(first, some);
    });
  }

  template <class S> static uint32_t lanes_inside(const RayNode& ray, uint32_t lanes, uint32_t interior) {
    uint32_t inside = 0;
    for_each_lane(lanes, [&](uint32_t lane) {
      for (uint32_t d = 0; d < ray.interior_depth.lane[lane]; ++d)
        if (ray.interiors[d].lane[lane] == interior) inside |= 1u << lane;
    });
    return inside;
  }
  /// Leaves all interiors to be crossed one by one.
  template <class Spu>
  static uint32_t cross_single_interiors(const SceneAccess<Spu>&, const WordLanes&, uint32_t lanes,
                                         const RayNode&, Refraction& result) {
    typename Spu::simd::F(1.0f).store(result.ratio.lane);
    return lanes;
  }
};

} // namespace celltrace::kernel
