// Kinds of work for which lanes of a bundle's ray trees wait: rays to trace, hits to shade, points to light,
// and rays without a hit. Kernel dialect, for direct memory.
//
// Behind surfaces that mirror or bend rays, most packets of a tree have few rays: some of the rays end, some
// hit nothing, and few hit points that reflect the light of a lamp. Lanes of all trees of a bundle therefore
// wait here until they fill packets. PooledTrees has the bodies.
#pragma once

#include "kernel/accel/frustum.hpp"
#include "kernel/direct/wavefront_queue.hpp"
#include "kernel/shading/ray_stack.hpp"
#include "kernel/tuning.hpp"

namespace celltrace::kernel {

/// Returns true if lanes of a packet should wait for others because they are few.
inline bool had_better_wait(uint32_t lanes) {
  return __builtin_popcount(lanes) < tuning::kLeastRaysByThemselves;
}

/// Rays to trace, by the octants of their directions. The youngest packet comes first, so that few rays wait
/// at any time.
struct PooledRays : WorkKind {
  struct Source {
    const RayNode& node;
    const WordLanes& pixels;
  };
  static constexpr uint32_t kKeys = 8;
  /// Capacity in packets: packets that are being filled, some more for each packet of a bundle, and full
  /// packets that wait on the way down the trees.
  static constexpr uint32_t kPackets = 58;
  static constexpr bool kMixesKeys = true;

  RayNode node;
  WordLanes pixels; ///< by lane, pixel of the bundle that receives the ray's light

  void begin() { node.begin(); }
  void put(const Source& from, uint32_t lanes, uint32_t to) {
    for_each_lane(lanes, [&](uint32_t lane) {
      copy_lane(from.node.rays, lane, node.rays, to);
      copy_lane(from.node.throughput, lane, node.throughput, to);
      copy_lane(from.node.weight, lane, node.weight, to);
      copy_lane(from.node.level, lane, node.level, to);
      copy_lane(from.node.power, lane, node.power, to);
      copy_lane(static_cast<const RayInteriors&>(from.node), lane, static_cast<RayInteriors&>(node), to);
      copy_lane(from.pixels, lane, pixels, to);
      node.lanes |= 1u << to;
      node.reflected |= (from.node.reflected >> lane & 1) << to++;
    });
  }
  Source source() const { return {node, pixels}; }
  template <class Trees, class Stopped>
  bool run(uint32_t, uint32_t lanes, Trees& trees, const Stopped& stopped) const {
    return trees.trace_pooled(*this, lanes, stopped);
  }
};

/// Hits without secondary rays, which are shaded between trees, the oldest first.
struct EndingHits : WorkKind {
  struct Source {
    PooledRays::Source rays;
    const HitPacket& hits;
  };
  static constexpr uint32_t kPackets = 5; ///< most packets that a tree may leave until it is complete
  static constexpr bool kOldestFirst = true;

  PooledRays rays;
  HitPacket hits;

  void begin() { rays.begin(); }
  void put(const Source& from, uint32_t lanes, uint32_t to) {
    rays.put(from.rays, lanes, to);
    for_each_lane(lanes, [&](uint32_t lane) { copy_lane(from.hits, lane, hits, to++); });
  }
  template <class Trees> void run(uint32_t, uint32_t lanes, Trees& trees) const {
    trees.shade_ending(*this, lanes);
  }
};

/// Points that reflect the light of a lamp if nothing occludes it. The key is the light's number.
struct ShadowPoints : WorkKind {
  struct Source {
    const VectorLanes& point;
    const WordLanes& object;
    const VectorLanes& light;
    const WordLanes& pixels;
    const RayInteriors* interiors; ///< null: interiors are not wanted
  };
  static constexpr uint32_t kKeys = 8, kPackets = kKeys; ///< number of a frame's lights that have a queue

  VectorLanes point;
  WordLanes object;       ///< object that each point lies on
  VectorLanes light;      ///< light that the points reflect if they are not occluded
  WordLanes pixels;       ///< by lane, pixel of the bundle
  RayInteriors interiors; ///< interiors of the rays that have hit the points

  void put(const Source& from, uint32_t lanes, uint32_t to) {
    for_each_lane(lanes, [&](uint32_t lane) {
      copy_lane(from.point, lane, point, to);
      copy_lane(from.object, lane, object, to);
      copy_lane(from.light, lane, light, to);
      copy_lane(from.pixels, lane, pixels, to);
      if (from.interiors != nullptr) copy_lane(*from.interiors, lane, interiors, to);
      ++to;
    });
  }
  template <class Trees> void run(uint32_t number, uint32_t lanes, Trees& trees) {
    trees.light_points(number, *this, lanes);
  }
};

/// Rays without a hit, if the sky has patterns: a pattern takes as long for one lane as for all.
struct SkyRays : WorkKind {
  using Source = PooledRays::Source;

  VectorLanes direction;
  VectorLanes throughput; ///< factor of the sky's colour in the pixel
  WordLanes pixels;       ///< by lane, pixel of the bundle

  void put(const Source& from, uint32_t lanes, uint32_t to) {
    for_each_lane(lanes, [&](uint32_t lane) {
      copy_lane(from.node.rays.direction, lane, direction, to);
      copy_lane(from.node.throughput, lane, throughput, to);
      copy_lane(from.pixels, lane, pixels, to++);
    });
  }
  template <class Trees> void run(uint32_t, uint32_t lanes, Trees& trees) const {
    trees.see_sky(*this, lanes);
  }
};

/// The interface by which a tracer puts rays into a queue.
struct RayPooling {
  WavefrontQueue<PooledRays>* queue = nullptr;
  WordLanes pixels; ///< by lane, pixel of the bundle for the rays that are being traced

  /// Puts rays into the queue. Returns false, and leaves the rays, if there is no queue or no room, or if
  /// there are many rays.
  bool takes(const RayNode& node) {
    if (queue == nullptr || !had_better_wait(node.lanes) || !queue->has_room()) return false;
    for_each_lane(node.lanes, [&](uint32_t lane) {
      queue->push(octant_of(node.rays, lane), 1u << lane, {node, pixels});
    });
    return true;
  }
};

} // namespace celltrace::kernel
