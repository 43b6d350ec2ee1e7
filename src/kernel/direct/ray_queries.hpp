// Answers ray queries of the application, on the thread that asks. Kernel dialect, where memory is direct.
#pragma once

#include "celltrace/ray.hpp"
#include "kernel/accel/traversal.hpp"
#include "kernel/direct/single_ray.hpp"
#include "kernel/shading/hit_points.hpp"

#include <stddef.h>

namespace celltrace::kernel {

/// What a build for one CPU answers queries by. `state`: memory that open() has been called for, by one
/// thread at a time. Objects are told by RayHit::record, their offsets in the scene image.
struct RayQueryFunctions {
  size_t state_bytes;     ///< of memory for a state
  size_t state_alignment; ///< of its address
  /// `frame`, with the image and the BVH that it names, and `bvh` stay as they are as long as the state is
  /// used.
  void (*open)(void* state, const FrameBlock& frame, const QueryBvh& bvh);
  void (*closest_hit)(void* state, const Ray& ray, RayHit& hit);
  bool (*occluded)(void* state, const Ray& ray);
  void (*closest_hits)(void* state, const Ray* rays, RayHit* hits, uint32_t count);
  void (*surface)(void* state, const Ray& ray, const RayHit& hit, RaySurface& surface);
};

template <class Spu, class Quad, class Eight> class RayQueryAnswers {
public:
  using S = typename Spu::simd;

  RayQueryAnswers(const FrameBlock& frame, const QueryBvh& bvh)
      : frame_(frame), scene_(spu_, CacheConfig::off(), frame.image), traversal_(scene_, frame_),
        single_(traversal_.objects(), frame_, bvh) {
    traversal_.objects().set_reflected(kSeesAll);
  }

  void closest_hit(const Ray& ray, RayHit& hit) {
    SingleRay<S> single;
    start(ray, single);
    single_.find_closest(single);
    set(hit, single.object, single.distance, single.u, single.v);
  }

  bool occluded(const Ray& ray) {
    SingleRay<S> single;
    start(ray, single);
    return single_.occluded(single);
  }

  void closest_hits(const Ray* rays, RayHit* hits, uint32_t count) {
    for (uint32_t first = 0; first < count; first += kBundlePackets<Spu> * kSimdLanes) {
      uint32_t packets = 0;
      for (; packets < kBundlePackets<Spu> && first + packets * kSimdLanes < count; ++packets) {
        const uint32_t begin = first + packets * kSimdLanes, left = count - begin;
        start(rays + begin, left < kSimdLanes ? left : kSimdLanes, packets);
      }
      traversal_.find_closest_within(queries_, packets);
      for (uint32_t packet = 0; packet < packets; ++packet) {
        const HitPacket& found = hits_[packet];
        RayHit* const to = hits + first + packet * kSimdLanes;
        const uint32_t left = count - first - packet * kSimdLanes;
        for (uint32_t i = 0; i < kSimdLanes && i < left; ++i)
          set(to[i], found.object.lane[i], found.distance.lane[i], found.u.lane[i], found.v.lane[i]);
      }
    }
  }

  void surface(const Ray& ray, const RayHit& hit, RaySurface& surface) {
    SingleRay<S> single;
    start(ray, single);
    HitPacket& hits = single.hits;
    using F = typename S::F;
    F(hit.distance).store(hits.distance.lane);
    F(hit.u).store(hits.u.lane);
    F(hit.v).store(hits.v.lane);
    S::I::splat(static_cast<int32_t>(hit.record)).store(reinterpret_cast<int32_t*>(hits.object.lane));
    HitPoints<S> points;
    find_hit_points(scene_, single.as_packet(), hits, 1u, points);
    put(points.point, surface.point);
    put(points.normal, surface.normal);
  }

private:
  static void put(const V3<S>& from, float (&to)[3]) {
    VectorLanes lanes;
    lanes.template store<S>(from);
    for (uint32_t axis = 0; axis < 3; ++axis)
      to[axis] = lanes[axis].lane[0];
  }

  static void set(RayHit& hit, uint32_t object, float distance, float u, float v) {
    if (object == kNoOffset)
      hit = RayHit();
    else
      hit = {distance, u, v, RayHit::kNone, object};
  }

  static float end_of(const Ray& ray) { return ray.tfar < kMaxHitDistance ? ray.tfar : kMaxHitDistance; }

  static void start(const Ray& ray, SingleRay<S>& single) {
    const float(&d)[3] = ray.direction;
    const float scale = 1.0f / larger(__builtin_sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), 1e-30f);
    for (uint32_t axis = 0; axis < 3; ++axis) {
      single.origin[axis] = ray.origin[axis];
      single.direction[axis] = d[axis] * scale;
    }
    single.distance = end_of(ray);
    single.u = single.v = 0.0f;
    single.object = kNoOffset;
    single.has_packet = false;
  }

  /// Rays that are fewer than a packet's lanes are followed by copies of the last one.
  void start(const Ray* rays, uint32_t count, uint32_t packet) {
    RayPacket& to = packets_[packet];
    HitPacket& hits = hits_[packet];
    for (uint32_t i = 0; i < kSimdLanes; ++i) {
      const Ray& ray = rays[i < count ? i : count - 1];
      to.origin.x.lane[i] = ray.origin[0];
      to.origin.y.lane[i] = ray.origin[1];
      to.origin.z.lane[i] = ray.origin[2];
      to.direction.x.lane[i] = ray.direction[0];
      to.direction.y.lane[i] = ray.direction[1];
      to.direction.z.lane[i] = ray.direction[2];
      hits.distance.lane[i] = end_of(ray);
    }
    to.direction.template store<S>(normalise<S>(to.direction.template load<S>()));
    S::I::splat(-1).store(reinterpret_cast<int32_t*>(to.start_object.lane));
    S::I::splat(-1).store(reinterpret_cast<int32_t*>(hits.object.lane));
    queries_[packet] = {&to, &hits, nullptr, nullptr, (2u << (count - 1)) - 1};
  }

  const FrameBlock& frame_;
  Spu spu_;
  SceneAccess<Spu> scene_;
  Traversal<Spu, kBvhOnly> traversal_;
  SingleRayTraversal<Spu, Quad, Eight> single_;
  RayPacket packets_[kBundlePackets<Spu>];
  HitPacket hits_[kBundlePackets<Spu>];
  RayQuery queries_[kBundlePackets<Spu>];
};

/// `argument`: the address of a RayQueryFunctions, which becomes that of `Answers`.
template <class Answers> void enter_ray_query_functions(ea_t argument) {
  auto& functions = *reinterpret_cast<RayQueryFunctions*>(static_cast<uintptr_t>(argument));
  functions.state_bytes = sizeof(Answers);
  functions.state_alignment = alignof(Answers);
  functions.open = [](void* state, const FrameBlock& frame, const QueryBvh& bvh) {
    new (state) Answers(frame, bvh);
  };
  functions.closest_hit = [](void* state, const Ray& ray, RayHit& hit) {
    static_cast<Answers*>(state)->closest_hit(ray, hit);
  };
  functions.occluded = [](void* state, const Ray& ray) {
    return static_cast<Answers*>(state)->occluded(ray);
  };
  functions.closest_hits = [](void* state, const Ray* rays, RayHit* hits, uint32_t count) {
    static_cast<Answers*>(state)->closest_hits(rays, hits, count);
  };
  functions.surface = [](void* state, const Ray& ray, const RayHit& hit, RaySurface& surface) {
    static_cast<Answers*>(state)->surface(ray, hit, surface);
  };
}

} // namespace celltrace::kernel
