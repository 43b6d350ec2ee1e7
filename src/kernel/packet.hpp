// Ray packets: 4x4 rays as a structure of arrays, one ray in each SIMD lane. Lane l is ray (l % 4, l / 4).
// Kernel dialect.
#pragma once

#include "celltrace/spe/simd.hpp"
#include "kernel/math.hpp"
#include "kernel/parts.hpp"
#include "kernel/scalar.hpp"
#include "kernel/strategy.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// One value in each lane, in local store.
struct alignas(64) FloatLanes {
  float lane[kSimdLanes];
};
struct alignas(64) WordLanes {
  uint32_t lane[kSimdLanes];
};

struct VectorLanes {
  FloatLanes x, y, z;

  const FloatLanes& operator[](uint32_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  template <class S> V3<S> load() const {
    using F = typename S::F;
    return {F::load(x.lane), F::load(y.lane), F::load(z.lane)};
  }
  /// Loads as many lanes as S has, beginning at lane `first`.
  template <class S> V3<S> load_from(uint32_t first) const {
    using F = typename S::F;
    return {F::load(x.lane + first), F::load(y.lane + first), F::load(z.lane + first)};
  }
  template <class S> void store_from(uint32_t first, const V3<S>& v) {
    v.x.store(x.lane + first);
    v.y.store(y.lane + first);
    v.z.store(z.lane + first);
  }
  /// Returns the vector of lane `i` in all lanes.
  template <class S> V3<S> of(uint32_t i) const {
    using F = typename S::F;
    return {F(x.lane[i]), F(y.lane[i]), F(z.lane[i])};
  }
  template <class S> void store(const V3<S>& v) {
    v.x.store(x.lane);
    v.y.store(y.lane);
    v.z.store(z.lane);
  }
};

template <class Lanes>
[[gnu::always_inline]] inline void copy_lane(const Lanes& from, uint32_t lane, Lanes& to, uint32_t to_lane) {
  to.lane[to_lane] = from.lane[lane];
}
[[gnu::always_inline]] inline void copy_lane(const VectorLanes& from, uint32_t lane, VectorLanes& to,
                                             uint32_t to_lane) {
  copy_lane(from.x, lane, to.x, to_lane);
  copy_lane(from.y, lane, to.y, to_lane);
  copy_lane(from.z, lane, to.z, to_lane);
}

/// Sets the lanes `lanes` of a vector to the same three values. If `all` is true, no other lane matters, and
/// `into` need not be initialised.
template <class Spu>
[[gnu::always_inline]] inline void put_in_lanes(bool all, const typename Spu::simd::M& lanes,
                                                const float* values, V3<typename Spu::simd>& into) {
  Strategy<Spu>::template put_in_lanes<typename Spu::simd>(all, lanes, values, into);
}

/// Rays with directions of unit length. `start_object` is the offset of the object on which a secondary ray
/// starts, or kNoOffset. A ray does not hit a triangle that it starts on, and hits a sphere that it starts on
/// only at the other end of the chord.
struct RayPacket {
  VectorLanes origin;
  VectorLanes direction;
  WordLanes start_object;
};
[[gnu::always_inline]] inline void copy_lane(const RayPacket& from, uint32_t lane, RayPacket& to,
                                             uint32_t to_lane) {
  copy_lane(from.origin, lane, to.origin, to_lane);
  copy_lane(from.direction, lane, to.direction, to_lane);
  copy_lane(from.start_object, lane, to.start_object, to_lane);
}

/// The closest hit of each ray: its distance, the object's offset (kNoOffset: no hit), and its barycentric
/// coordinates in a triangle.
struct HitPacket {
  WordLanes object;
  FloatLanes distance;
  FloatLanes u, v;
};
[[gnu::always_inline]] inline void copy_lane(const HitPacket& from, uint32_t lane, HitPacket& to,
                                             uint32_t to_lane) {
  copy_lane(from.object, lane, to.object, to_lane);
  copy_lane(from.distance, lane, to.distance, to_lane);
  copy_lane(from.u, lane, to.u, to_lane);
  copy_lane(from.v, lane, to.v, to_lane);
}

template <class Spu, class Packet>
[[gnu::always_inline]] inline void copy_packet(const Packet& from, Packet& to) {
  Strategy<Spu>::copy_packet(from, to);
}

/// A ray query of one packet. If `hits` is not null, the query finds the closest hits. Otherwise the rays are
/// shadow rays, and the query multiplies `light` by the transmittance up to `distance`.
struct RayQuery {
  const RayPacket* rays;
  HitPacket* hits;
  const FloatLanes* distance;
  VectorLanes* light;
  uint32_t lanes; ///< active rays; occluded shadow rays are removed
};

/// A closed interval.
struct Interval {
  float low, high;
};
/// Returns the smallest interval that contains both intervals.
inline Interval united(const Interval& a, const Interval& b) {
  return {smaller(a.low, b.low), larger(a.high, b.high)};
}

/// Returns the smallest interval that contains the values of all lanes.
template <class S> Interval interval_of(const typename S::F& values) {
  Interval all;
  S::extremes(values, all.low, all.high);
  return all;
}

template <class S> [[gnu::always_inline]] inline typename S::I load_words(const WordLanes& words) {
  return S::I::load(reinterpret_cast<const int32_t*>(words.lane));
}
template <class S>
[[gnu::always_inline]] inline void store_words(WordLanes& words, const typename S::I& values) {
  values.store(reinterpret_cast<int32_t*>(words.lane));
}

/// Calls `visit(lane)` for each bit that is set, the lowest first.
template <class Visit> [[gnu::always_inline]] inline void for_each_lane(uint32_t lanes, const Visit& visit) {
  while (lanes != 0) {
    const uint32_t lane = static_cast<uint32_t>(__builtin_ctz(lanes));
    lanes &= lanes - 1;
    visit(lane);
  }
}

/// Groups `lanes` by their values in `words`: calls `visit(value, lanes with it)` once for each value.
template <class S, class Visit>
[[gnu::always_inline]] inline void for_each_value(const WordLanes& words, uint32_t lanes,
                                                  const Visit& visit) {
  using I = typename S::I;
  const I all = load_words<S>(words);
  while (lanes != 0) {
    const uint32_t value = words.lane[__builtin_ctz(lanes)];
    const uint32_t same = (all == I::splat(static_cast<int32_t>(value))).bits() & lanes;
    lanes &= ~same;
    visit(value, same);
  }
}

} // namespace celltrace::kernel
