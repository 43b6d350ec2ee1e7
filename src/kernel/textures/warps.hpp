// Warps, which bend space before a pattern is evaluated, without turbulence. Kernel dialect.
#pragma once

#include "kernel/angles.hpp"
#include "kernel/textures/features.hpp"

namespace celltrace::kernel::warps {

/// Returns an angle in turns, in [0, 1).
template <class S>
[[gnu::always_inline]] inline typename S::F turns_from_0(const typename S::F& y, const typename S::F& x) {
  const typename S::F turns = turns_inline<S>(y, x);
  return turns - S::floor(turns);
}

template <class S> [[gnu::always_inline]] inline V3<S> repeated(const SpaceStepRecord& step, const V3<S>& p) {
  using F = typename S::F;
  const uint32_t axis = step.kind_and_flags >> warp_flag::axis_shift & 3;
  F coordinate[3] = {p.x, p.y, p.z};
  const float width = step.value[0];
  const F slice = S::floor(coordinate[axis] * F(1.0f / width));
  const auto is_odd = slice - S::floor(slice * F(0.5f)) * F(2.0f) > F(0.5f);
  coordinate[axis] = coordinate[axis] - slice * F(width);
  for (uint32_t i = 0; i < 3; ++i) {
    if (step.value[1 + i] < 0.0f) {
      const F mirrored = i == axis ? F(width) - coordinate[i] : -coordinate[i];
      coordinate[i] = S::select(is_odd, mirrored, coordinate[i]);
    }
    coordinate[i] = coordinate[i] + slice * F(step.value[4 + i]);
  }
  return {coordinate[0], coordinate[1], coordinate[2]};
}

/// Returns the centres of the copies of a black hole that points are near. Each copy has a cell, in which
/// turbulence moves it.
template <class Spu>
[[gnu::always_inline]] inline V3<typename Spu::rare_simd>
centres_of(SceneAccess<Spu>& scene, const SpaceStepRecord& step, const V3<typename Spu::rare_simd>& p) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  const F coordinate[3] = {p.x, p.y, p.z};
  F cell[3], centre[3];
  for (uint32_t i = 0; i < 3; ++i) {
    const float distance = step.value[6 + i], own = step.value[i], radius = step.value[3];
    cell[i] = F(0.0f);
    centre[i] = F(own);
    if (distance != 0.0f) {
      cell[i] = S::floor(coordinate[i] * F(1.0f / distance));
      centre[i] = cell[i] * F(distance) + F(own > radius ? own : radius);
    }
  }
  const float(&amount)[3] = step.turbulence.amount;
  V3<S> moved = {centre[0], centre[1], centre[2]};
  if (amount[0] != 0.0f || amount[1] != 0.0f || amount[2] != 0.0f) {
    Features<Spu> features(scene, step.table);
    for_each_cell_of<S>(
        {cell[0], cell[1], cell[2]}, [&](uint32_t lanes, const uint32_t(&at)[3], const V3<S>&) {
          const FeatureRecord feature = features.at(features.number_of(at));
          const V3<S> aside = {F(feature.place[0] * amount[0]), F(feature.place[1] * amount[1]),
                               F(feature.place[2] * amount[2])};
          moved = select<S>(S::M::from_bits(lanes), moved + aside, moved);
        });
  }
  return moved;
}

template <class Spu>
[[gnu::always_inline]] inline V3<typename Spu::rare_simd>
attracted(SceneAccess<Spu>& scene, const SpaceStepRecord& step, const V3<typename Spu::rare_simd>& p) {
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  const V3<S> centre = centres_of(scene, step, p), from = p - centre;
  const F distance = S::sqrt(dot<S>(from, from)), radius(step.value[3]);
  const F depth = S::max(radius - distance, F(0.0f)) * F(1.0f / step.value[3]);
  const F share = S::min(pow<S>(depth, F(step.value[5])) * F(step.value[4]), F(1.0f));
  const bool is_inverse = (step.kind_and_flags & warp_flag::inverse) != 0;
  return select<S>(distance < radius, centre + from * (F(1.0f) + (is_inverse ? -share : share)), p);
}

/// Maps points to the unit square that is wrapped around a shape, and to their distance from the shape.
template <class S>
[[gnu::always_inline]] inline V3<S> unwrapped(WarpKind kind, const SpaceStepRecord& step, const V3<S>& p) {
  using F = typename S::F;
  const F rho = S::sqrt(p.x * p.x + p.z * p.z);
  V3<S> at = {p.x, p.y, F(step.value[3])};
  auto is_off = S::M::all();
  if (kind != WarpKind::planar) {
    is_off = rho > F(0.0f);
    at.x = turns_from_0<S>(p.z, p.x);
    at.z = rho;
    if (kind == WarpKind::spherical) {
      at.y = F(0.5f) + F(2.0f) * turns_inline<S>(p.y, rho);
      at.z = S::sqrt(dot<S>(p, p));
    } else if (kind == WarpKind::toroidal) {
      const F inward = F(step.value[4]) - rho;
      at.y = turns_from_0<S>(-p.y, inward);
      at.z = S::sqrt(inward * inward + p.y * p.y);
    }
    if (step.value[3] != 0.0f) {
      const F size = pow<S>(at.z, F(step.value[3]));
      at.x = at.x * size;
      if (kind != WarpKind::cylindrical) at.y = at.y * size;
    }
  }
  const F x(step.value[0]), y(step.value[1]), z(step.value[2]);
  const V3<S> turned = {x * at.z + (y + z) * at.x, (x + z) * at.y - y * at.z, z * at.z - x * at.x + y * at.y};
  return select<S>(is_off, turned, p);
}

} // namespace celltrace::kernel::warps
