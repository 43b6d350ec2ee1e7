// Shading in direct memory, where code takes no local store: records are read in place, and there are
// shortcuts for frequent cases. Kernel dialect.
#pragma once

#include "kernel/direct/bundle_queues.hpp"
#include "kernel/direct/node_stack.hpp"
#include "kernel/shading/lighting.hpp"
#include "kernel/shading/secondary_rays.hpp"

namespace celltrace::kernel {

struct DirectShading {
  // --- the tree ---

  template <class Spu, uint32_t kResident> using RayStack = NodeStack;
  template <class Spu> using RayPooling = kernel::RayPooling;

  // --- surfaces ---

  /// True: ends of trees are shaded without the code for secondary rays.
  static constexpr bool kShadesEndsApart = true;
  /// Gives lanes a material; the first material fills all lanes.
  template <class Spu>
  [[gnu::always_inline]] static void gather_material(const MaterialRecord& r, bool first, uint32_t lanes,
                                                     uint32_t wanted, MaterialLanes<typename Spu::simd>& m) {
    if (first)
      detail::gather_material<Spu, true>(r, 0xFFFF, lanes, wanted, m);
    else
      detail::gather_material<Spu>(r, lanes, lanes, wanted, m);
  }

  // --- light ---

  /// Begins a fresh round, in which shading stores the rays toward the first light.
  template <class S, class LitPoints> static void begin_round(LightRound& round, LitPoints& lit) {
    round.is_fresh = true;
    round.to_first = &lit.to_light;
  }
  static bool is_fresh(const LightRound& round) { return round.is_fresh; }
  static bool wants_rays(const LightRound& round, uint32_t light) {
    return round.to_first != nullptr && light == round.first;
  }
  static void end_fresh(LightRound& round) { round.is_fresh = false; }
  /// Returns true if shading has stored the rays toward a light, in a round that begins with light `first`.
  static bool is_aimed(uint32_t light, uint32_t first) { return light == first; }

  /// Removes surfaces that send on no light from `lanes`: they are black or diffuse nothing, and have no
  /// highlights. Returns true if no lane is left.
  template <class Spu>
  static bool are_dark(const Surfaces<typename Spu::simd>& s, const MaterialLanes<typename Spu::simd>& m,
                       uint32_t& lanes) {
    using S = typename Spu::simd;
    using F = typename S::F;
    const F zero(0.0f);
    auto lit = !(((m.pigment.x == zero) & (m.pigment.y == zero) & (m.pigment.z == zero)) |
                 (m.diffuse * m.opacity == zero));
    if (m.has(material_flag::highlights)) lit = lit | !((m.phong == zero) & (m.specular == zero));
    lanes &= lit.bits() | s.any_side | m.special;
    return lanes == 0;
  }

  /// Raises cosines to whole powers. Returns false if not all powers are whole.
  template <class S>
  [[gnu::always_inline]] static bool raise_to_whole_power(const typename S::F& power, uint32_t lanes,
                                                          typename S::F& cosine) {
    const typename S::I whole = whole_power<S>(power);
    if ((lanes & ~(S::to_float(whole) == power).bits()) != 0) return false;
    cosine = whole_pow<S>(cosine, whole);
    return true;
  }

  // --- secondary rays ---

  template <class Spu, class S = typename Spu::simd, class F = typename S::F>
  [[gnu::always_inline]] static void
  find_secondary_rays(const MaterialLanes<S>& m, const F& cosine, const F& fresnel_ratio, float adc_bailout,
                      uint32_t lanes, const F& share, SecondaryRays<S>& all) {
    detail::secondary_rays_of<S>(m, cosine, fresnel_ratio, adc_bailout, lanes, share, all);
  }

  /// Returns the `lanes` in which a ray is inside an interior.
  template <class S> static uint32_t lanes_inside(const RayNode& ray, uint32_t lanes, uint32_t interior) {
    using I = typename S::I;
    const I depth = load_words<S>(ray.interior_depth), wanted = I::splat(static_cast<int32_t>(interior));
    auto inside = S::M::none();
    for (int32_t d = 0; d < static_cast<int32_t>(kMaxInteriorDepth); ++d)
      inside = inside | ((load_words<S>(ray.interiors[d]) == wanted) & (I::splat(d) < depth));
    return inside.bits() & lanes;
  }
  /// Crosses surfaces at once for those `lanes` that no other interior concerns; see cross_surfaces().
  /// Returns the other lanes.
  template <class Spu>
  static uint32_t cross_single_interiors(SceneAccess<Spu>& scene, const WordLanes& interior, uint32_t lanes,
                                         RayNode& ray, Refraction& result) {
    using S = typename Spu::simd;
    using F = typename S::F;
    using I = typename S::I;
    using M = typename S::M;
    const I depth = load_words<S>(ray.interior_depth), own = load_words<S>(interior);
    const I outermost = load_words<S>(ray.interiors[0]);
    const M outside = (depth == I::splat(0)) & M::from_bits(lanes);
    const M inside = (depth == I::splat(1)) & (outermost == own) & M::from_bits(lanes);
    const uint32_t crossing = (outside | inside).bits();
    F ratio(1.0f);
    for_each_value<S>(interior, crossing, [&](uint32_t offset, uint32_t same) {
      const float ior = scene.interior(offset)->ior;
      ratio = S::select(M::from_bits(same), S::select(inside, F(ior), F(1.0f / ior)), ratio);
    });
    ratio.store(result.ratio.lane);
    result.straight = ((ratio > F(1.0f - kLeastBend)) & (ratio < F(1.0f + kLeastBend))).bits() & crossing;
    store_words<S>(ray.interiors[0], S::select(outside, own, outermost));
    store_words<S>(ray.interior_depth,
                   S::select(outside, I::splat(1), S::select(inside, I::splat(0), depth)));
    return lanes & ~crossing;
  }
};

} // namespace celltrace::kernel
