// Rare features of finishes: crand and irid. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/lights/incident_light.hpp"
#include "kernel/math.hpp"
#include "kernel/modules.hpp"
#include "kernel/shading/material_lanes.hpp"
#include "kernel/shading/secondary_rays.hpp"
#include "kernel/textures/noise.hpp"

#include <string.h>

namespace celltrace::kernel {

namespace detail {

/// Returns pseudo-random numbers in [0, 1) that depend on a point and on `salt` alone, so that they are the
/// same however work is shared. The last bits of points are ignored, as backends may differ in them.
template <class S> CELLTRACE_ONE_COPY typename S::F random_at(const V3<S>& point, uint32_t salt) {
  constexpr uint32_t kCertain = ~0x1Fu;
  alignas(64) float lane[3][S::kLanes];
  point.x.store(lane[0]);
  point.y.store(lane[1]);
  point.z.store(lane[2]);
  for (uint32_t i = 0; i < S::kLanes; ++i) {
    uint32_t hash = salt;
    for (const auto& coordinate : lane) {
      uint32_t bits;
      memcpy(&bits, &coordinate[i], sizeof bits);
      hash = (hash ^ (bits & kCertain)) * 0x9E3779B1u;
      hash ^= hash >> 15;
    }
    hash = (hash ^ hash >> 13) * 0x85EBCA6Bu;
    lane[0][i] = static_cast<float>(static_cast<int32_t>(hash >> 8)) * (1.0f / 16777216.0f);
  }
  return S::F::load(lane[0]);
}

/// Returns the cosine of an angle in turns.
template <class S> typename S::F cosine_of_turns(const typename S::F& turns) {
  const typename S::F shifted = turns + typename S::F(0.25f);
  return sine_of_turns<S>(shifted - S::floor(shifted));
}

/// Returns the factors of light on a thin film, as for POV-Ray's irid: they depend on the difference between
/// the path through the film and a whole number of each wavelength. `cosines`: the cosine of the light's
/// angle plus that of the ray's angle.
template <class Spu>
V3<typename Spu::rare_simd> film_factors(Spu& spu, const FinishRecord& f,
                                         const V3<typename Spu::rare_simd>& point,
                                         const typename Spu::rare_simd::F& cosines) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  F path = cosines * F(f.irid_thickness);
  if (f.irid_turbulence != 0.0f) {
    constexpr TurbulenceWords kFilm = {{1.0f, 1.0f, 1.0f}, 2.0f, 0.5f, 5};
    spu.enter_module(modules::kNoise);
    const F noise = noise::turbulence_value<S>(point, kFilm, f.first_generator != 0);
    path = path * (F(1.0f) + F(f.irid_turbulence) * (noise + noise - F(1.0f)));
  }
  const auto factor = [&](float inverse_wavelength) {
    return F(1.0f) + F(f.irid) * cosine_of_turns<S>(path * F(inverse_wavelength));
  };
  return {factor(f.inverse_wavelength[0]), factor(f.inverse_wavelength[1]), factor(f.inverse_wavelength[2])};
}

} // namespace detail

/// Changes the light that surfaces send on of the light `number`, in the lanes of `m.special`.
template <class Spu>
CELLTRACE_ONE_COPY void change_special_light(SceneAccess<Spu>& scene, const Surfaces<typename Spu::simd>& s,
                                             const MaterialLanes<typename Spu::simd>& m,
                                             const IncidentLight<typename Spu::simd>& light, uint32_t number,
                                             V3<typename Spu::simd>& sent) {
  using S = typename Spu::simd;
  using R = typename Spu::rare_simd;
  using F = typename R::F;
  scene.spu().run_in_module(modules::kFinishes);
  for_each_value<S>(*m.offsets, m.special & light.facing, [&](uint32_t offset, uint32_t same) {
    Kept<Spu, FinishRecord> f = *scene.finish(scene.material(offset)->finish);
    for_each_part<Spu>([&](uint32_t first) {
      const uint32_t some = part_of<Spu>(same, first);
      if (some == 0) return;
      const V3<R> point = part_of<Spu>(s.point, first);
      const V3<R> before = part_of<Spu>(sent, first);
      V3<R> after = before;
      if (f.crand != 0.0f) {
        const F less = detail::random_at<R>(point, number + 1) * F(f.crand);
        after = after - part_of<Spu>(m.pigment, first) * part_of<Spu>(light.colour, first) * less;
      }
      if (f.irid != 0.0f) {
        const F cosines = part_of<Spu>(light.cosine, first) +
                          R::abs(dot<R>(part_of<Spu>(s.direction, first), part_of<Spu>(s.normal, first)));
        after = after * detail::film_factors(scene.spu(), f, point, cosines);
      }
      set_part<Spu>(sent, first, select<R>(R::M::from_bits(some), after, before));
    });
  });
}

/// Changes the factors of mirrored and of totally reflected light in the lanes of `m.special`, because films
/// (irid) change this light like that of a light source in the same direction. `smooth` has the surfaces'
/// normals before they were disturbed.
template <class Spu>
CELLTRACE_ONE_COPY void change_special_mirror(SceneAccess<Spu>& scene, const Surfaces<typename Spu::simd>& s,
                                              const V3<typename Spu::simd>& smooth,
                                              const MaterialLanes<typename Spu::simd>& m,
                                              SecondaryRays<typename Spu::simd>& onward) {
  using S = typename Spu::simd;
  using R = typename Spu::rare_simd;
  using F = typename R::F;
  scene.spu().run_in_module(modules::kFinishes);
  for_each_value<S>(
      *m.offsets, m.special & (onward.mirrors | onward.transmits), [&](uint32_t offset, uint32_t same) {
        Kept<Spu, FinishRecord> f = *scene.finish(scene.material(offset)->finish);
        if (f.irid == 0.0f) return;
        for_each_part<Spu>([&](uint32_t first) {
          const uint32_t some = part_of<Spu>(same, first);
          if (some == 0) return;
          const V3<R> direction = part_of<Spu>(s.direction, first), normal = part_of<Spu>(s.normal, first);
          const V3<R> mirrored = mirror_inline<R>(direction, normal, part_of<Spu>(smooth, first));
          const F cosines = R::abs(dot<R>(mirrored, normal)) + R::abs(dot<R>(direction, normal));
          const V3<R> factors = detail::film_factors(scene.spu(), f, part_of<Spu>(s.point, first), cosines);
          const auto pass = [&](V3<typename Spu::simd>& light, const V3<R>& shares) {
            const V3<R> before = part_of<Spu>(light, first);
            set_part<Spu>(light, first, select<R>(R::M::from_bits(some), before * shares, before));
          };
          pass(onward.reflected_inside, factors);
          if (!onward.has_reflection_exponent) return pass(onward.mirror, factors);
          // Mirrored light is raised to a power when it arrives, and so is the film's factor.
          const F power = part_of<Spu>(onward.reflection_power, first);
          const auto raised = [&](const F& factor) { return pow<R>(R::max(factor, F(0.0f)), power); };
          pass(onward.mirror, {raised(factors.x), raised(factors.y), raised(factors.z)});
        });
      });
}

} // namespace celltrace::kernel
