// Possible occluders between surfaces and an area light. Kernel dialect.
//
// The points of a packet are in one box, the places of the light in another. A shaft is the space that is
// swept by a box that changes from the first to the second as time t goes from 0 to 1. On each axis, both
// planes of the box move evenly, so that a node is touched while two linear inequalities hold (Haines and
// Wallace, Shaft culling for efficient ray-traced radiosity, 1991).
#pragma once

#include "kernel/accel/frustum.hpp"
#include "kernel/accel/object_tests.hpp"
#include "kernel/direct/mixed_rays.hpp"
#include "kernel/lights/list.hpp"

namespace celltrace::kernel {

/// A shaft from surfaces to a light.
template <class S> class Shaft {
public:
  using F = typename S::F;
  using F4 = typename S::F4;

  Shaft(const RayPacket& rays, uint32_t lanes, const LightRecord& light) {
    const auto active = S::M::from_bits(lanes);
    const auto any = static_cast<uint32_t>(__builtin_ctz(lanes));
    const float half[2] = {half_extent(light.columns, light.inverse_columns),
                           half_extent(light.rows, light.inverse_rows)};
    const bool turns = (light.kind_and_flags & light_flag::orient) != 0;
    FloatLanes length;
    const V3<S> across = splat3<S>(light.across);
    S::sqrt(dot<S>(across, across)).store(length.lane);
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const FloatLanes& origin = rays.origin[axis];
      from_[axis] = interval_of<S>(S::select(active, F::load(origin.lane), F(origin.lane[any])));
      const float reach =
          turns ? length.lane[0] * (half[0] + half[1])
                : half[0] * magnitude(light.across[axis]) + half[1] * magnitude(light.along[axis]);
      to_[axis] = {light.location[axis] - reach, light.location[axis] + reach};
      const float size = larger(larger(magnitude(from_[axis].low), magnitude(from_[axis].high)),
                                larger(magnitude(to_[axis].low), magnitude(to_[axis].high)));
      const float epsilon = kRelativeEpsilon * size + kEpsilon;
      from_[axis] = {from_[axis].low - epsilon, from_[axis].high + epsilon};
      to_[axis] = {to_[axis].low - epsilon, to_[axis].high + epsilon};
      set(2 * axis, from_[axis].low, to_[axis].low, 2 * axis + 1, true);
      set(2 * axis + 1, from_[axis].high, to_[axis].high, 2 * axis, false);
    }
  }

  /// Returns the children of a node that the shaft touches, bit i for child i.
  uint32_t intersect(const float (&bounds)[6][4]) const {
    F4 enter = F4::splat(0.0f), leave = F4::splat(1.0f);
    for (const Side& side : sides_) {
      const F4 t = (F4::load(bounds[side.row]) - F4::splat(side.begin)) * F4::splat(side.inverse);
      if (side.ends)
        leave = S::min(leave, t);
      else
        enter = S::max(enter, t);
    }
    return not_above_bits(enter, leave);
  }

  /// Returns true if the whole shaft is on one side of the plane normal * p + offset = 0, given as four
  /// numbers.
  bool is_beside(const float* plane) const {
    Interval both = {plane[3], plane[3]}, other = both;
    for (uint32_t axis = 0; axis < 3; ++axis) {
      add(both, plane[axis], from_[axis]);
      add(other, plane[axis], to_[axis]);
    }
    return (both.low > 0.0f && other.low > 0.0f) || (both.high < 0.0f && other.high < 0.0f);
  }

  /// Returns true if a sphere contains the whole shaft.
  bool is_in_sphere(const float* centre, float square_of_radius) const {
    const auto square_of_way = [&](const Interval(&box)[3]) {
      float sum = 0.0f;
      for (uint32_t axis = 0; axis < 3; ++axis) {
        const float way =
            larger(magnitude(box[axis].low - centre[axis]), magnitude(box[axis].high - centre[axis]));
        sum += way * way;
      }
      return sum;
    };
    return larger(square_of_way(from_), square_of_way(to_)) < 0.999f * square_of_radius;
  }

private:
  /// Epsilons of the planes, which are much larger than the rounding errors of nodes and rays.
  static constexpr float kRelativeEpsilon = 1e-5f;
  static constexpr float kEpsilon = 1e-6f;
  static constexpr float kTiny = 1e-30f;

  /// A plane of the moving box, and the plane of a node that it passes at the beginning or end of the
  /// contact.
  struct Side {
    float begin, inverse;
    uint32_t row; ///< row of NodeRecord::bounds
    bool ends;
  };

  void set(uint32_t number, float begin, float end, uint32_t row, bool is_low) {
    const float way = end - begin;
    const bool backward = way < 0.0f;
    const float moved = backward ? smaller(way, -kTiny) : larger(way, kTiny);
    sides_[number] = {begin, 1.0f / moved, row, is_low != backward};
  }
  /// Returns half the extent of a light in units of its axis: jitter moves places by half the distance
  /// between them, and circles are slightly off the middle.
  static float half_extent(uint32_t places, float inverse) {
    return places > 1 ? 0.502f + 0.5f * inverse : 0.002f;
  }
  static void add(Interval& sum, float factor, const Interval& values) {
    const float low = factor * values.low, high = factor * values.high;
    sum = {sum.low + smaller(low, high), sum.high + larger(low, high)};
  }

  Interval from_[3], to_[3];
  Side sides_[6];
};

/// The possible occluders between a packet's surfaces and a light.
template <class Spu> class AreaOccluders {
public:
  using S = typename Spu::simd;

  /// Result of gather(): `objects`, all of them opaque; or only the touched `nodes` of the BVH that have
  /// leaves; or `nothing`, if there are too many nodes or the light is parallel.
  enum class Gathered { objects, nodes, nothing };

  Gathered gather(ObjectTests<Spu>& tests, const FrameBlock& frame, const RayPacket& rays, uint32_t lanes,
                  const LightRecord& light) {
    cheap_count_ = node_count_ = 0;
    first_heavy_ = kMost;
    if (is_parallel(light)) return Gathered::nothing;
    const Shaft<S> shaft(rays, lanes, light);
    bool are_known = true; // true while all objects are known
    const auto add_object = [&](const Occluder& object) {
      are_known = are_known && add(tests, rays, lanes, shaft, object);
      return !are_known;
    };
    constexpr auto kBytes = static_cast<uint32_t>(sizeof(ObjectRecord));
    uint32_t self = frame.object_offset - frame.unbounded_count * kBytes;
    for (; self != frame.object_offset; self += kBytes)
      add_object({self, kNoOffset, 0});
    if (!gather_bounded(tests, frame, shaft, add_object)) return Gathered::nothing;
    return are_known ? Gathered::objects : Gathered::nodes;
  }
  bool are_none() const { return cheap_count_ == 0 && first_heavy_ == kMost; }

  const NodeLeaves* nodes() const { return nodes_; }
  uint32_t node_count() const { return node_count_; }

  static constexpr uint32_t kMostPackets = tuning::kMostAreaPackets;

  /// Removes occluded lanes from the queries, at most kMostPackets, toward places of the light.
  void test(ObjectTests<Spu>& tests, RayQuery* queries, uint32_t count) const {
    uint32_t packets = 0;
    for (uint32_t i = 0; i < count; ++i)
      packets |= (queries[i].lanes != 0 ? 1u : 0u) << i;
    for (uint32_t i = 0; i < cheap_count_ && packets != 0; ++i) {
      tests.test_occlusion_of_all(queries, packets, objects_[i].self);
      packets = nonempty_of(queries, packets);
    }
    if (first_heavy_ != kMost && packets != 0) test_heavy(tests, queries, packets);
  }

private:
  /// An object of a leaf, which is child `child` of `node`.
  struct Occluder {
    uint32_t self, node, child;
  };

  /// Adds an object unless all rays of `lanes` to the light certainly miss it. Returns false if the object
  /// cannot be added.
  bool add(ObjectTests<Spu>& tests, const RayPacket& rays, uint32_t lanes, const Shaft<S>& shaft,
           const Occluder& occluder) {
    const uint32_t self = occluder.self;
    const ObjectRecord& object = *tests.scene().object(self);
    const uint32_t flags = object.kind_and_flags;
    if ((flags & object_flag::no_shadow) != 0) return true;
    switch (static_cast<ObjectKind>(flags & object_flag::kind_mask)) {
    case ObjectKind::plane:
      // A ray that starts on a plane does not cross it again.
      if ((lanes & ~lanes_that_start_on<S>(rays, self).bits()) == 0 || shaft.is_beside(object.geometry + 8))
        return true;
      break;
    case ObjectKind::sphere:
      // Skies are often spheres around the whole scene.
      if (shaft.is_in_sphere(object.geometry, object.geometry[3] * object.geometry[3])) return true;
      break;
    default:
      break;
    }
    if ((flags & object_flag::opaque) == 0 || cheap_count_ == first_heavy_) return false;
    const bool takes_long =
        (flags & object_flag::csg) != 0 || Primitives::is_heavy(flags & object_flag::kind_mask);
    objects_[takes_long ? --first_heavy_ : cheap_count_++] = occluder;
    return true;
  }

  static uint32_t nonempty_of(const RayQuery* queries, uint32_t packets) {
    uint32_t nonempty = 0;
    for_each_lane(packets, [&](uint32_t i) { nonempty |= (queries[i].lanes != 0 ? 1u : 0u) << i; });
    return nonempty;
  }
  /// Tests objects whose tests take long. Rays that are occluded already, or miss the leaf, are left out.
  void test_heavy(ObjectTests<Spu>& tests, RayQuery* queries, uint32_t packets) const {
    uint32_t lanes[kMost][kMostPackets]; // by object and packet, rays that hit the leaf
    uint32_t hitting[kMost] = {};        // by object, packets with such rays
    for_each_lane(packets, [&](uint32_t i) {
      const RayQuery& query = queries[i];
      const MixedRays<S> rays(*query.rays);
      const auto farthest = S::F::load(query.distance->lane);
      for (uint32_t k = first_heavy_; k < kMost; ++k) {
        const Occluder& object = objects_[k];
        lanes[k][i] = query.lanes;
        if (object.node != kNoOffset)
          lanes[k][i] &=
              rays.hit_child(tests.scene().node(object.node)->bounds, object.child, 0.0f, farthest);
        hitting[k] |= (lanes[k][i] != 0 ? 1u : 0u) << i;
      }
    });
    for (uint32_t k = first_heavy_; k < kMost; ++k) {
      uint32_t nonempty = 0;
      for_each_lane(hitting[k], [&](uint32_t i) {
        lanes[k][i] &= queries[i].lanes;
        nonempty |= (lanes[k][i] != 0 ? 1u : 0u) << i;
      });
      if (nonempty != 0) tests.test_occlusion_of_some(queries, nonempty, lanes[k], objects_[k].self);
    }
  }

  /// Gathers bounded objects and nodes. Returns false if there are too many nodes.
  template <class Add>
  bool gather_bounded(ObjectTests<Spu>& tests, const FrameBlock& frame, const Shaft<S>& shaft,
                      const Add& add_object) {
    SceneAccess<Spu>& scene = tests.scene();
    uint32_t nodes[kMostNodes], size = 0;
    nodes[size++] = frame.bvh.node_offset;
    while (size != 0) {
      const uint32_t offset = nodes[--size];
      const NodeRecord& node = *scene.node(offset);
      ++tests.counters().visits;
      uint32_t leaves = 0;
      for_each_lane(shaft.intersect(node.bounds), [&](uint32_t i) {
        const NodeRef child = {node.child[i], node.leaf[i]};
        if (!child.is_leaf()) {
          nodes[size++] = child.child;
          return;
        }
        leaves |= 1u << i;
        scene.for_each_object(child, [&](uint32_t self) { return add_object({self, offset, i}); });
      });
      if (leaves == 0) continue;
      if (node_count_ == tuning::kMostAreaNodes) return false;
      nodes_[node_count_++] = {offset, leaves};
    }
    return true;
  }

  /// Capacity for a BVH of at most 48 levels, as the builder makes, with four children per node.
  static constexpr uint32_t kMostNodes = 3 * 48 + 4;

  static constexpr uint32_t kMost = tuning::kMostAreaOccluders;
  Occluder objects_[kMost]; ///< objects whose tests take long are at the end
  uint32_t cheap_count_ = 0, first_heavy_ = kMost;
  NodeLeaves nodes_[tuning::kMostAreaNodes];
  uint32_t node_count_ = 0;
};

} // namespace celltrace::kernel
