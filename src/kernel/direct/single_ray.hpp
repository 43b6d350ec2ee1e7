// Traversal of the BVH with one ray: its node tests take the eight children of a node at once, its leaf tests
// four triangles. Kernel dialect, for direct memory.
//
// The hits are those that packets find, to the last bit: the tests of objects and the comparison of hits are
// the same. Where objects meet, packets may find another hit: their tests of nodes may leave out a box that a
// ray only touches.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/accel/frustum.hpp"
#include "kernel/accel/object_tests.hpp"
#include "kernel/accel/packet_traversal.hpp"
#include "kernel/direct/query_bvh.hpp"

namespace celltrace::kernel {

/// A ray and its closest hit so far. A copy in all lanes of a packet is made on first use.
template <class S> struct SingleRay {
  float origin[3], direction[3]; ///< `direction` is a unit vector
  float distance;                ///< distance of the closest hit, or of the end of the ray
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
    store_words<S>(packet.start_object, S::I::splat(-1));
    return packet;
  }
};

/// Traverses the BVH with single rays. `Quad` and `Eight`: four lanes for triangles and eight for bounds.
template <class Spu, class Quad, class Eight> class SingleRayTraversal {
public:
  using S = typename Spu::simd;
  using Ray = SingleRay<S>;

  SingleRayTraversal(ObjectTests<Spu>& objects, const FrameBlock& frame, const QueryBvh& bvh)
      : objects_(objects), frame_(frame), bvh_(bvh) {}

  /// Finds the closest hit before `ray.distance`.
  void find_closest(Ray& ray) { trace<false>(ray); }
  /// Returns true if there is a hit.
  bool occluded(Ray& ray) { return trace<true>(ray); }

private:
  static constexpr uint32_t kDepth = 64; // depth of the BVH for packets, and of divided leaves
  static constexpr uint32_t kEntries = (QueryNode::kWidth - 1) * kDepth + QueryNode::kWidth;

  /// A child that the ray enters, and the distance.
  struct Entry {
    uint32_t ref;
    float enter;

    friend void sort(Entry& nearer, Entry& farther) {
      const Entry a = nearer, b = farther;
      const bool swapped = b.enter < a.enter;
      nearer = swapped ? b : a;
      farther = swapped ? a : b;
    }
  };

  /// The ray for tests of nodes: it crosses a plane at x at the distance x * inverse - origin * inverse,
  /// which is one instruction if multiplication and subtraction are fused.
  struct Slabs {
    explicit Slabs(const Ray& ray) {
      const SlabOrder order((ray.direction[0] < 0.0f ? 1u : 0u) | (ray.direction[1] < 0.0f ? 2u : 0u) |
                            (ray.direction[2] < 0.0f ? 4u : 0u));
      for (uint32_t axis = 0; axis < 3; ++axis) {
        const float along = ray.direction[axis];
        const float inverted = 1.0f / (along < 0.0f ? smaller(along, -detail::kTinyDirection)
                                                    : larger(along, detail::kTinyDirection));
        // magnitude() would be a branch here, which takes 3 % of a ray's time.
        const float product = ray.origin[axis] * inverted, rounding = kRounding * __builtin_fabsf(product);
        inverse[axis] = Eight::splat(inverted);
        near_origin[axis] = Eight::splat(product + rounding);
        far_origin[axis] = Eight::splat(product - rounding);
        near_row[axis] = order.near[axis] * sizeof(QueryNode::bounds[0]);
        far_row[axis] = order.far[axis] * sizeof(QueryNode::bounds[0]);
      }
    }
    /// Returns the children that the ray hits; see Frustum::intersect().
    [[gnu::always_inline]] uint32_t intersect(const QueryNode& node, float tfar, float* enter) const {
      const auto at = [&](size_t row, uint32_t axis, const Eight(&origins)[3])
          __attribute__((always_inline)) {
        const char* const plane = reinterpret_cast<const char*>(node.bounds) + row;
        return multiply_subtract(Eight::load(reinterpret_cast<const float*>(plane)), inverse[axis],
                                 origins[axis]);
      };
      const auto near_at = [&](uint32_t axis) __attribute__((always_inline)) {
        return at(near_row[axis], axis, near_origin);
      };
      const auto far_at = [&](uint32_t axis) __attribute__((always_inline)) {
        return at(far_row[axis], axis, far_origin);
      };
      const Eight near =
          Eight::max(Eight::max(near_at(0), near_at(1)), Eight::max(near_at(2), Eight::splat(0.0f)));
      const Eight far =
          Eight::min(Eight::min(far_at(0), far_at(1)), Eight::min(far_at(2), Eight::splat(tfar)));
      near.store(enter);
      return not_above_bits(near, far * Eight::splat(detail::kRoundedUp));
    }

    /// Bound of the rounding of both products, relative to origin * inverse. Near planes are moved nearer and
    /// far planes farther by this bound, as the difference may be much smaller than the products.
    static constexpr float kRounding = 5e-7f;

    Eight inverse[3], near_origin[3], far_origin[3];
    size_t near_row[3], far_row[3]; ///< offsets in QueryNode::bounds
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
    const V3<Quad> origin = splat3<Quad>(ray.origin), direction = splat3<Quad>(ray.direction);
    float tfar = tfar_of(ray);
    Entry stack[kEntries];
    Entry* top = stack;
    for (uint32_t ref = query_ref::make(query_ref::node, 0);;) {
      const uint32_t index = query_ref::index(ref);
      if (query_ref::kind(ref) == query_ref::node) {
        if (expand(slabs, bvh_.nodes[index], tfar, top, ref)) continue;
      } else {
        if (query_ref::kind(ref) == query_ref::triangles)
          test_triangles(bvh_.blocks[index], origin, direction, ray);
        else
          for (const uint32_t* self = bvh_.others + index; *self != kNoOffset; ++self)
            test_other(*self, ray);
        if (kAny && ray.object != kNoOffset) return true;
        tfar = tfar_of(ray);
      }
      do {
        if (top == stack) return false;
        --top;
      } while (top->enter > tfar);
      ref = top->ref;
    }
  }

  /// Pushes the children that are hit, the nearest last, except for the nearest of all, which becomes `ref`.
  /// Returns false if none is hit.
  [[gnu::always_inline]] static bool expand(const Slabs& slabs, const QueryNode& node, float tfar,
                                            Entry*& top, uint32_t& ref) {
    alignas(32) float enter[QueryNode::kWidth];
    uint32_t hit = slabs.intersect(node, tfar, enter);
    if (hit == 0) return false;
    const auto next = [&]() __attribute__((always_inline)) {
      const auto i = static_cast<uint32_t>(__builtin_ctz(hit));
      hit &= hit - 1;
      return Entry{node.child[i], enter[i]};
    };
    // Mostly one or two children are hit, whose order no branch predictor knows.
    Entry a = next();
    if (hit != 0) {
      Entry b = next();
      sort(a, b);
      if (hit == 0) {
        *top++ = b;
      } else {
        Entry c = next();
        sort(b, c);
        sort(a, b);
        top[0] = c;
        top[1] = b;
        Entry* const first = top;
        top += 2;
        while (hit != 0) {
          Entry other = next();
          sort(a, other);
          Entry* place = top++;
          for (; place != first && place[-1].enter < other.enter; --place)
            *place = place[-1];
          *place = other;
        }
      }
    }
    ref = a.ref;
    return true;
  }

  /// Tests the triangles of a block, in lanes, and keeps the closest hit; see keep_closest() in
  /// crossings.hpp.
  [[gnu::always_inline]] static void test_triangles(const TriangleBlock& block, const V3<Quad>& origin,
                                                    const V3<Quad>& direction, Ray& ray) {
    using F = typename Quad::F;
    const auto vectors = [](const float(&rows)[3][4]) __attribute__((always_inline)) {
      return V3<Quad>{F::load(rows[0]), F::load(rows[1]), F::load(rows[2])};
    };
    const TriangleSides<Quad> sides = {vectors(block.v0), vectors(block.edge1), vectors(block.edge2)};
    const Crossings<Quad> c = TriangleTest<Quad>(origin, sides).crossed(direction, Quad::M::none());
    const uint32_t hit = (c.near_hit & (c.near > F(kMinHitDistance)) & (c.near <= F(ray.distance))).bits();
    if (hit != 0) keep_closest(block, c, hit, ray);
  }
  static void keep_closest(const TriangleBlock& block, const Crossings<Quad>& c, uint32_t hit, Ray& ray) {
    alignas(16) float near[4], u[4], v[4];
    c.near.store(near);
    c.u.store(u);
    c.v.store(v);
    for (; hit != 0; hit &= hit - 1) {
      const auto i = static_cast<uint32_t>(__builtin_ctz(hit));
      const bool precedes = static_cast<int32_t>(block.offset[i]) < static_cast<int32_t>(ray.object);
      if (!(near[i] < ray.distance || (near[i] == ray.distance && precedes))) continue;
      ray.distance = near[i];
      ray.u = u[i];
      ray.v = v[i];
      ray.object = block.offset[i];
    }
  }

  /// Tests any other object, by the test for packets.
  CELLTRACE_ONE_COPY void test_other(uint32_t self, Ray& ray) {
    using F = typename S::F;
    const RayPacket& packet = ray.as_packet();
    HitPacket& hits = ray.hits;
    F(ray.distance).store(hits.distance.lane);
    F(ray.u).store(hits.u.lane);
    F(ray.v).store(hits.v.lane);
    store_words<S>(hits.object, S::I::splat(static_cast<int32_t>(ray.object)));
    objects_.test_closest(packet, self, hits);
    ray.distance = hits.distance.lane[0];
    ray.u = hits.u.lane[0];
    ray.v = hits.v.lane[0];
    ray.object = hits.object.lane[0];
  }

  static constexpr auto kObjectBytes = static_cast<uint32_t>(sizeof(ObjectRecord));

  ObjectTests<Spu>& objects_;
  const FrameBlock& frame_;
  const QueryBvh& bvh_;
};

} // namespace celltrace::kernel
