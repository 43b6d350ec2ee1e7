// Crossings of shadow rays with translucent surfaces, for cases where order matters: near crossings may not
// all count, interiors may fade, and transmittance may depend on where a ray comes from. Kernel dialect.
#pragma once

#include "kernel/math.hpp"
#include "kernel/packet.hpp"
#include "kernel/primitives/crossings.hpp"

namespace celltrace::kernel {

/// Memory for the crossings of a bundle's packets.
struct CrossingPool {
  static constexpr uint32_t kMost = 384;
  static constexpr float kNowhere = -1.0f;

  uint32_t count = 0;
  FloatLanes distance[kMost]; ///< kNowhere in lanes without a crossing
  VectorLanes transmittance[kMost];
  FloatLanes u[kMost], v[kMost]; ///< as in Crossings
  uint32_t object[kMost];        ///< offsets
};

/// The light of a packet's shadow rays. The transmittance of crossed surfaces is kept apart until finish().
template <class S> struct CrossingList : VectorLanes {
  using F = typename S::F;
  using M = typename S::M;

  uint32_t overflowed = 0; ///< lanes with more crossings than there is room for

  void begin(const VectorLanes& light, CrossingPool& pool) {
    static_cast<VectorLanes&>(*this) = light;
    pool_ = &pool;
    overflowed = count_ = 0;
  }
  /// Adds a crossing of `lanes` with object `self` at `distance`. Returns the place for the surface's
  /// transmittance; null if there is no room.
  VectorLanes* add(const F& distance, const Crossings<S>& c, uint32_t lanes, uint32_t self) {
    if (count_ == kMost || pool_->count == CrossingPool::kMost) {
      overflowed |= lanes;
      return nullptr;
    }
    const uint32_t place = pool_->count++;
    place_[count_++] = static_cast<uint16_t>(place);
    S::select(M::from_bits(lanes), distance, F(CrossingPool::kNowhere)).store(pool_->distance[place].lane);
    c.u.store(pool_->u[place].lane);
    c.v.store(pool_->v[place].lane);
    pool_->object[place] = self;
    const F one(1.0f);
    pool_->transmittance[place].template store<S>({one, one, one});
    return &pool_->transmittance[place];
  }
  bool empty() const { return count_ == 0; }
  /// Multiplies the light by the transmittance of the surfaces that count. As in POV-Ray, a ray starts again
  /// at each surface and does not see the next one within kShadowEpsilon. If two surfaces are at one
  /// distance, the one found first counts.
  void finish() {
    V3<S> light = this->template load<S>();
    for (uint32_t i = 0; i < count_; ++i) {
      const F distance = distance_of(i), nearest = distance - F(kShadowEpsilon);
      M hidden = M::none();
      for (uint32_t k = 0; k < i; ++k)
        hidden = hidden | ((distance_of(k) <= distance) & (distance_of(k) >= nearest));
      for (uint32_t k = i + 1; k < count_; ++k)
        hidden = hidden | ((distance_of(k) < distance) & (distance_of(k) >= nearest));
      light = select<S>(hidden, light, light * pool_->transmittance[place_[i]].template load<S>());
    }
    this->template store<S>(light);
  }

  /// Removes the nearest surface of each of `lanes`, the one found first if two are at one distance. Stores
  /// the hits and the surfaces' transmittance, and returns the lanes that had a surface.
  uint32_t take(uint32_t lanes, HitPacket& hits, VectorLanes& transmittance) {
    using I = typename S::I;
    const F one(1.0f), nowhere(kMaxHitDistance);
    F nearest = nowhere, u(0.0f), v(0.0f);
    V3<S> passes = {one, one, one};
    I place = I::splat(-1), object = I::splat(-1);
    for (uint32_t i = 0; i < count_; ++i) {
      const F distance = distance_of(i);
      const M closer = M::from_bits(lanes) & (distance >= F(0.0f)) & (distance < nearest);
      if (closer.bits() == 0) continue;
      const uint32_t at = place_[i];
      nearest = S::select(closer, distance, nearest);
      u = S::select(closer, F::load(pool_->u[at].lane), u);
      v = S::select(closer, F::load(pool_->v[at].lane), v);
      passes = select<S>(closer, pool_->transmittance[at].template load<S>(), passes);
      object = S::select(closer, I::splat(static_cast<int32_t>(pool_->object[at])), object);
      place = S::select(closer, I::splat(static_cast<int32_t>(i)), place);
    }
    for (uint32_t i = 0; i < count_; ++i) {
      const M taken = place == I::splat(static_cast<int32_t>(i));
      S::select(taken, F(CrossingPool::kNowhere), distance_of(i)).store(pool_->distance[place_[i]].lane);
    }
    store_words<S>(hits.object, object);
    nearest.store(hits.distance.lane);
    u.store(hits.u.lane);
    v.store(hits.v.lane);
    transmittance.template store<S>(passes);
    return (nearest < nowhere).bits();
  }

private:
  static constexpr uint32_t kMost = 64;

  F distance_of(uint32_t i) const { return F::load(pool_->distance[place_[i]].lane); }

  CrossingPool* pool_ = nullptr;
  uint32_t count_ = 0;
  uint16_t place_[kMost]; ///< index in the pool
};

} // namespace celltrace::kernel
