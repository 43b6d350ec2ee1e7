// Answers to ray queries of the application, on the calling thread. Kernel dialect, for direct memory.
#pragma once

#include "celltrace/ray.hpp"
#include "kernel/direct/single_ray.hpp"
#include "kernel/direct/strategy.hpp"
#include "kernel/shading/hit_points.hpp"

#include <stddef.h>

namespace celltrace::kernel {

/// The functions of a build for one CPU by which queries are answered. `state` is memory that open() has been
/// called for; one thread at a time may use it. RayHit::record is an object's offset in the scene image.
struct RayQueryFunctions {
  size_t state_bytes;     ///< size of a state's memory
  size_t state_alignment; ///< alignment of its address
  /// Initialises a state. `frame`, its image and BVH, `bvh` and `owners` must not change while the state is
  /// used. `owners` has a RayHit::object for each record: first for unbounded objects, then for all others.
  void (*open)(void* state, const FrameBlock& frame, const QueryBvh& bvh, const uint32_t* owners);
  void (*closest_hit)(void* state, const Ray& ray, RayHit& hit);
  bool (*occluded)(void* state, const Ray& ray);
  void (*closest_hits)(void* state, const Ray* rays, RayHit* hits, uint32_t count);
  void (*surface)(void* state, const Ray& ray, const RayHit& hit, RaySurface& surface);
};

template <class Spu, class Quad, class Eight> class RayQueryAnswers {
public:
  using S = typename Spu::simd;

  RayQueryAnswers(const FrameBlock& frame, const QueryBvh& bvh, const uint32_t* owners)
      : frame_(frame), owners_(owners),
        first_record_(frame.object_offset -
                      frame.unbounded_count * static_cast<uint32_t>(sizeof(ObjectRecord))),
        scene_(spu_, CacheConfig::off(), frame.image), traversal_(scene_, frame_),
        single_(traversal_.objects(), frame_, bvh) {
    traversal_.objects().set_reflected(kSeesAll);
    for (RayPacket& rays : packets_)
      store_words<S>(rays.start_object, S::I::splat(-1));
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
    constexpr uint32_t kBundleRays = kBundlePackets<Spu> * kSimdLanes;
    for (uint32_t first = 0; first < count; first += kBundleRays) {
      prefetch(rays, first + kBundleRays, first + 2 * kBundleRays);
      uint32_t packets = 0;
      for (; packets < kBundlePackets<Spu> && first + packets * kSimdLanes < count; ++packets) {
        const uint32_t begin = first + packets * kSimdLanes, left = count - begin;
        start(rays + begin, left < kSimdLanes ? left : kSimdLanes, packets);
      }
      const OriginBundle<S> bundle(queries_, packets);
      if (!traversal_.enter(bundle) && bundle.packets == (1u << packets) - 1) {
        set_missed(hits + first, count - first < kBundleRays ? count - first : kBundleRays);
        continue;
      }
      for (uint32_t packet = 0; packet < packets; ++packet) {
        VectorLanes& direction = packets_[packet].direction;
        direction.template store<S>(normalise<S>(direction.template load<S>()));
      }
      traversal_.find_closest_within(queries_, packets, bundle);
      for (uint32_t packet = 0; packet < packets; ++packet) {
        const uint32_t begin = first + packet * kSimdLanes, left = count - begin;
        set(hits + begin, left < kSimdLanes ? left : kSimdLanes, hits_[packet]);
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
    store_words<S>(hits.object, S::I::splat(static_cast<int32_t>(hit.record)));
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

  uint32_t owner_of(uint32_t record) {
    if (is_instanced(record)) return scene_.instance(instance_with(scene_, record))->owner;
    return owners_[(record - first_record_) / sizeof(ObjectRecord)];
  }

  void set(RayHit& hit, uint32_t object, float distance, float u, float v) {
    if (object == kNoOffset)
      hit = RayHit();
    else
      hit = {distance, u, v, owner_of(object), object};
  }

  static void set_missed(RayHit* hits, uint32_t count) {
    static constexpr RayHit kMissed[kSimdLanes]; // copied in whole cache lines
    uint32_t i = 0;
    for (; i + kSimdLanes <= count; i += kSimdLanes)
      __builtin_memcpy(static_cast<void*>(hits + i), kMissed, sizeof kMissed);
    for (; i < count; ++i)
      hits[i] = RayHit();
  }
  void set(RayHit* hits, uint32_t count, const HitPacket& found) {
    using F = typename S::F;
    using I = typename S::I;
    static_assert(offsetof(RayHit, object) == 12 && RayHit::kNone == kNoOffset);
    const I none = I::splat(-1);
    const auto missed = load_words<S>(found.object) == none;
    if (missed.bits() == 0xFFFF) return set_missed(hits, count);
    alignas(64) float owners[kSimdLanes];
    for (uint32_t lane = 0; lane < kSimdLanes; ++lane) {
      const uint32_t record = found.object.lane[lane];
      const uint32_t owner = record != kNoOffset ? owner_of(record) : RayHit::kNone;
      __builtin_memcpy(&owners[lane], &owner, sizeof owner);
    }
    // The rows become four fields for each lane.
    F rows[4] = {S::select(missed, F(kEndless), F::load(found.distance.lane)),
                 S::select(missed, F(0.0f), F::load(found.u.lane)),
                 S::select(missed, F(0.0f), F::load(found.v.lane)), F::load(owners)};
    S::transpose_quads(rows[0], rows[1], rows[2], rows[3]);
    alignas(64) float of_lane[4][kSimdLanes];
    for (uint32_t i = 0; i < 4; ++i)
      rows[i].store(of_lane[i]);
    for (uint32_t i = 0; i < count; ++i) {
      __builtin_memcpy(static_cast<void*>(&hits[i]), &of_lane[i % 4][i - i % 4], offsetof(RayHit, record));
      hits[i].record = found.object.lane[i];
    }
  }

  /// Prefetches rays `begin` to `end`, so that they come from main memory while other rays are traced. The
  /// rays need not exist.
  static void prefetch(const Ray* rays, uint32_t begin, uint32_t end) {
    constexpr uint32_t kRaysALine = 64 / sizeof(Ray);
    const uintptr_t address = reinterpret_cast<uintptr_t>(rays);
    for (uint32_t i = begin; i < end; i += kRaysALine)
      __builtin_prefetch(reinterpret_cast<const void*>(address + i * sizeof(Ray)));
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

  /// Stores rays in a packet. Directions keep their lengths. Lanes beyond the rays get copies of the last
  /// one.
  void start(const Ray* rays, uint32_t count, uint32_t packet) {
    using F = typename S::F;
    static_assert(offsetof(Ray, direction) == 12 && offsetof(Ray, tfar) == 24);
    const auto ray = [&](uint32_t lane) { return &rays[lane < count ? lane : count - 1]; };
    F of_origin[4], of_direction[4]; // x, y, z and the word behind or before
    for (uint32_t i = 0; i < 4; ++i) {
      const Ray *const a = ray(i), *const b = ray(i + 4), *const c = ray(i + 8), *const d = ray(i + 12);
      of_origin[i] = S::join(quad(a, 0), quad(b, 0), quad(c, 0), quad(d, 0));
      of_direction[i] = S::join(quad(a, 12), quad(b, 12), quad(c, 12), quad(d, 12));
    }
    S::transpose_quads(of_origin[0], of_origin[1], of_origin[2], of_origin[3]);
    S::transpose_quads(of_direction[0], of_direction[1], of_direction[2], of_direction[3]);
    RayPacket& to = packets_[packet];
    HitPacket& hits = hits_[packet];
    to.origin.template store<S>({of_origin[0], of_origin[1], of_origin[2]});
    to.direction.template store<S>({of_direction[0], of_direction[1], of_direction[2]});
    const F farthest(kMaxHitDistance), tfar = of_direction[3];
    S::select(tfar < farthest, tfar, farthest).store(hits.distance.lane);
    store_words<S>(hits.object, S::I::splat(-1));
    queries_[packet] = {&to, &hits, nullptr, nullptr, (2u << (count - 1)) - 1};
  }
  /// Loads four numbers at `offset` bytes.
  [[gnu::always_inline]] static typename S::F4 quad(const Ray* ray, uint32_t offset) {
    alignas(16) float numbers[4];
    __builtin_memcpy(numbers, reinterpret_cast<const char*>(ray) + offset, sizeof numbers);
    return S::F4::load(numbers);
  }

  const FrameBlock& frame_;
  const uint32_t* owners_; ///< RayHit::object by record
  uint32_t first_record_;  ///< offset of the first record
  Spu spu_;
  SceneAccess<Spu> scene_;
  Traversal<Spu, kBvhOnly> traversal_;
  SingleRayTraversal<Spu, Quad, Eight> single_;
  RayPacket packets_[kBundlePackets<Spu>];
  HitPacket hits_[kBundlePackets<Spu>];
  RayQuery queries_[kBundlePackets<Spu>];
};

/// Sets the RayQueryFunctions at the address `argument` to those of `Answers`.
template <class Answers> void enter_ray_query_functions(ea_t argument) {
  auto& functions = *reinterpret_cast<RayQueryFunctions*>(static_cast<uintptr_t>(argument));
  functions.state_bytes = sizeof(Answers);
  functions.state_alignment = alignof(Answers);
  functions.open = [](void* state, const FrameBlock& frame, const QueryBvh& bvh, const uint32_t* owners) {
    new (state) Answers(frame, bvh, owners);
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
