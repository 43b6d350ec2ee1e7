// Absorption of light inside objects. Kernel dialect.
#pragma once

#include "kernel/modules.hpp"
#include "kernel/packet.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/shading/ray_stack.hpp"

namespace celltrace::kernel {

/// Multiplies light by the share that is left after `distance` inside an interior, in `lanes`. As in POV-Ray
/// a ray fades only if it is inside the interior whose surface it hits, whatever other interiors it is inside
/// of, and a shadow ray only if the power is not 0. The interior's refraction factor counts on both sides of
/// its surface, also if light is totally reflected, but not for shadow rays.
template <class Spu>
[[gnu::noinline]] void fade(SceneAccess<Spu>& scene, const RayNode& ray, const WordLanes& interior,
                            const FloatLanes& distance, uint32_t lanes, VectorLanes& light, bool is_shadow) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  constexpr float kToBinary = 1.44269504f, kExponential = 1000.0f;
  scene.spu().run_in_module(modules::kFading);
  for_each_value<typename Spu::simd>(interior, lanes, [&](uint32_t offset, uint32_t same) {
    Kept<Spu, InteriorRecord> r = *scene.interior(offset);
    uint32_t inside = 0;
    if (r.inverse_fade_distance != 0.0f && !(is_shadow && r.fade_power == 0.0f))
      inside = Strategy<Spu>::template lanes_inside<typename Spu::simd>(ray, same, offset);
    const float passed = is_shadow ? 1.0f : r.refraction();
    if (inside == 0 && passed == 1.0f) return;
    for_each_part<Spu>([&](uint32_t first) {
      const uint32_t some = part_of<Spu>(same, first);
      if (some == 0) return;
      const F depth = F::load(distance.lane + first) * F(r.inverse_fade_distance);
      const F one(1.0f);
      V3<S> left;
      if (r.fade_power >= kExponential) {
        const auto of = [&](float colour) { return exp2<S>(depth * F((colour - 1.0f) * kToBinary)); };
        left = {of(r.fade_colour[0]), of(r.fade_colour[1]), of(r.fade_colour[2])};
      } else {
        const F share = one / (one + Strategy<Spu>::template raised<S>(depth, r.fade_power));
        const V3<S> colour = splat3<S>(r.fade_colour);
        left = colour + (V3<S>{one, one, one} - colour) * share;
      }
      left = select<S>(S::M::from_bits(part_of<Spu>(inside, first)), left, {one, one, one}) * F(passed);
      const V3<S> before = light.template load_from<S>(first);
      light.template store_from<S>(first, select<S>(S::M::from_bits(some), before * left, before));
    });
  });
}

} // namespace celltrace::kernel
