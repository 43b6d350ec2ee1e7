// Traverses the BVH with one ray: its node tests take the four children of a node at once, its leaf tests
// four triangles. Kernel dialect, where memory is direct.
//
// Finds the hits that packets find, to the last bit: tests of objects and of what is nearer are theirs, and
// tests of nodes leave out less than theirs do not.
#pragma once

#include "kernel/accel/frustum.hpp"
#include "kernel/accel/object_tests.hpp"
#include "kernel/accel/packet_traversal.hpp"

namespace celltrace::kernel {

/// A ray and what it has hit so far. A copy of it in all lanes of a packet is made when it is first asked
/// for.
template <class S> struct SingleRay {
  float origin[3], direction[3]; ///< of length 1
  float distance;                ///< of the closest hit, or where the ray ends
  float u, v;
  uint32_t object; ///< offset, or kNoOffset
  bool has_packet;
  RayPacket packet;
  HitPacket hits;

  const RayPacket& as_packet() {
    if (has_packet) return packet;
    has_packet = true;
    packet.origin.template store<S>(splat3<S>(origin));
    packet.direction.template store<S>(splat3<S>(direction));
    S::I::splat(-1).store(reinterpret_cast<int32_t*>(packet.start_object.lane));
    return packet;
  }
};

/// `Quad`: the facade of four lanes.
template <class Spu, class Quad> class SingleRayTraversal {
public:
  using S = typename Spu::simd;
  using F4 = typename S::F4;
  using Ray = SingleRay<S>;

  SingleRayTraversal(ObjectTests<Spu>& objects, const FrameBlock& frame)
      : objects_(objects), frame_(frame), root_{frame.bvh.node_offset, 0} {}

  /// Finds the closest hit before `ray.distance`.
  void find_closest(Ray& ray) { trace<false>(ray); }
  /// Whether there is any.
  bool occluded(Ray& ray) { return trace<true>(ray); }

private:
  static constexpr uint32_t kDepth = 48; // the builder keeps a BVH within it
  static constexpr uint32_t kEntries = 3 * kDepth + 4;

  struct Entry {
    NodeRef ref;
    float enter;
  };

  /// The ray for tests of nodes.
  struct Slabs {
    explicit Slabs(const Ray& ray)
        : order((ray.direction[0] < 0.0f ? 1u : 0u) | (ray.direction[1] < 0.0f ? 2u : 0u) |
                (ray.direction[2] < 0.0f ? 4u : 0u)) {
      for (uint32_t axis = 0; axis < 3; ++axis) {
        const float along = ray.direction[axis];
        origin[axis] = F4::splat(ray.origin[axis]);
        inverse[axis] = F4::splat(1.0f / (along < 0.0f ? smaller(along, -detail::kTinyDirection)
                                                       : larger(along, detail::kTinyDirection)));
      }
    }
    /// As Frustum::intersect().
    [[gnu::always_inline]] uint32_t intersect(const float (&bounds)[6][4], float tfar,
                                              float (&enter)[4]) const {
      const auto at = [&](uint32_t row, uint32_t axis) __attribute__((always_inline)) {
        return (F4::load(bounds[row]) - origin[axis]) * inverse[axis];
      };
      const F4 near = S::max(S::max(at(order.near[0], 0), at(order.near[1], 1)),
                             S::max(at(order.near[2], 2), F4::splat(0.0f)));
      const F4 far = S::min(S::min(at(order.far[0], 0), at(order.far[1], 1)),
                            S::min(at(order.far[2], 2), F4::splat(tfar)));
      near.store(enter);
      return not_above_bits(near, far * F4::splat(detail::kRoundedUp));
    }

    F4 origin[3], inverse[3];
    SlabOrder order;
  };

  static float tfar_of(const Ray& ray) { return PacketTraversal<Spu>::kTfarSlack * ray.distance; }

  template <bool kAny> bool trace(Ray& ray) {
    const uint32_t count = frame_.unbounded_count;
    for (uint32_t self = frame_.object_offset - count * kObjectBytes; self != frame_.object_offset;
         self += kObjectBytes) {
      test_other(self, ray);
      if (kAny && ray.object != kNoOffset) return true;
    }
    const Slabs slabs(ray);
    float tfar = tfar_of(ray);
    Entry stack[kEntries];
    uint32_t size = 0;
    for (NodeRef ref = root_;;) {
      if (ref.is_leaf()) {
        test_leaf(ref, ray);
        if (kAny && ray.object != kNoOffset) return true;
        tfar = tfar_of(ray);
      } else if (expand(slabs, tfar, stack, size, ref)) {
        continue;
      }
      do {
        if (size == 0) return false;
        --size;
      } while (stack[size].enter > tfar);
      ref = stack[size].ref;
    }
  }

  /// Pushes the children that are hit, the nearest last, but for the nearest, which `ref` becomes. False:
  /// none is hit.
  [[gnu::always_inline]] bool expand(const Slabs& slabs, float tfar, Entry* stack, uint32_t& size,
                                     NodeRef& ref) {
    ++objects_.counters().visits;
    const NodeRecord& node = *objects_.scene().node(ref.child);
    alignas(16) float enter[4];
    uint32_t hit = slabs.intersect(node.bounds, tfar, enter);
    if (hit == 0) return false;
    const uint32_t first = size;
    auto i = static_cast<uint32_t>(__builtin_ctz(hit));
    Entry nearest = {{node.child[i], node.leaf[i]}, enter[i]};
    while ((hit &= hit - 1) != 0) {
      i = static_cast<uint32_t>(__builtin_ctz(hit));
      Entry other = {{node.child[i], node.leaf[i]}, enter[i]};
      objects_.scene().hint(other.ref);
      if (other.enter < nearest.enter) {
        const Entry nearer = other;
        other = nearest;
        nearest = nearer;
      }
      uint32_t place = size++;
      for (; place > first && stack[place - 1].enter < other.enter; --place)
        stack[place] = stack[place - 1];
      stack[place] = other;
    }
    ref = nearest.ref;
    return true;
  }

  /// Up to four triangles of a leaf.
  struct Triangles {
    const float* geometry[4];
    uint32_t offset[4];
    uint32_t count = 0;

    /// The geometry of the first one in lanes that are not in use.
    const float* at(uint32_t i) const { return geometry[i < count ? i : 0]; }
  };

  void test_leaf(const NodeRef& leaf, Ray& ray) {
    Triangles triangles;
    objects_.scene().for_each_object(
        leaf, [&](uint32_t self) __attribute__((always_inline)) {
          const ObjectRecord& object = *objects_.scene().object(self);
          if (!ObjectTests<Spu>::is_plain_triangle(object.kind_and_flags)) {
            test_other(self, ray);
            return false;
          }
          triangles.geometry[triangles.count] = object.geometry;
          triangles.offset[triangles.count] = self;
          if (++triangles.count == 4) {
            test(triangles, ray);
            triangles.count = 0;
          }
          return false;
        });
    if (triangles.count != 0) test(triangles, ray);
  }

  [[gnu::always_inline]] void test(const Triangles& triangles, Ray& ray) {
    using F = typename Quad::F;
    F w[12];
    for (uint32_t first = 0; first < 12; first += 4) {
      for (uint32_t i = 0; i < 4; ++i)
        w[first + i] = F::load(triangles.at(i) + first);
      Quad::transpose(w[first], w[first + 1], w[first + 2], w[first + 3]);
    }
    const V3<Quad> v0 = {w[0], w[1], w[2]};
    const TriangleSides<Quad> sides = {v0, V3<Quad>{w[3], w[4], w[5]} - v0, V3<Quad>{w[6], w[7], w[8]} - v0};
    const Crossings<Quad> c = SeenTriangle<Quad>(splat3<Quad>(ray.origin), sides)
                                  .crossed(splat3<Quad>(ray.direction), Quad::M::none());
    const uint32_t all = (1u << triangles.count) - 1;
    uint32_t hit = (c.near_hit & (c.near > F(kMinHitDistance)) & (c.near <= F(ray.distance))).bits() & all;
    if (hit == 0) return;
    alignas(16) float near[4], u[4], v[4];
    c.near.store(near);
    c.u.store(u);
    c.v.store(v);
    for (; hit != 0; hit &= hit - 1) {
      const auto i = static_cast<uint32_t>(__builtin_ctz(hit));
      // As ObjectTests::keep_closest().
      if (!(near[i] < ray.distance || (near[i] == ray.distance && static_cast<int32_t>(triangles.offset[i]) <
                                                                      static_cast<int32_t>(ray.object))))
        continue;
      ray.distance = near[i];
      ray.u = u[i];
      ray.v = v[i];
      ray.object = triangles.offset[i];
    }
  }

  /// Any other object, by the test that packets have.
  [[gnu::noinline]] void test_other(uint32_t self, Ray& ray) {
    using F = typename S::F;
    const RayPacket& packet = ray.as_packet();
    HitPacket& hits = ray.hits;
    F(ray.distance).store(hits.distance.lane);
    F(ray.u).store(hits.u.lane);
    F(ray.v).store(hits.v.lane);
    S::I::splat(static_cast<int32_t>(ray.object)).store(reinterpret_cast<int32_t*>(hits.object.lane));
    objects_.test_closest(packet, self, hits);
    ray.distance = hits.distance.lane[0];
    ray.u = hits.u.lane[0];
    ray.v = hits.v.lane[0];
    ray.object = hits.object.lane[0];
  }

  static constexpr auto kObjectBytes = static_cast<uint32_t>(sizeof(ObjectRecord));

  ObjectTests<Spu>& objects_;
  const FrameBlock& frame_;
  const NodeRef root_;
};

} // namespace celltrace::kernel
