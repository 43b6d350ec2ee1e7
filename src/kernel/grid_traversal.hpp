// Packets through the uniform grid. Kernel dialect.
//
// The rays of a packet walk the grid one by one, as voxels differ from ray to ray; an object met by one of
// them is tested against the whole packet, and a mailbox per packet (Amanatides and Woo) keeps the next ray
// from testing it again. Each lane keeps the nearest of all tested hits and stops once that lies in the voxel
// it is in.
#pragma once

#include "kernel/object_tests.hpp"
#include "kernel/voxel_walk.hpp"

namespace celltrace::kernel {

template <class Spu> class GridTraversal {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;

  GridTraversal(ObjectTests<Spu>& objects, const GridRecord& grid)
      : objects_(objects), scene_(objects.scene()), grid_(grid) {}

  /// As Traversal's, into hits that hold none yet.
  void find_closest(const RayPacket& rays, uint32_t lanes, HitPacket& hits) {
    objects_.mailbox().begin_packet();
    for_each_lane(lanes, [&](uint32_t lane) {
      walk(rays, lane, [&](uint32_t cell, float, float leave) {
        find_closest_in(cell, rays, hits);
        return hits.distance.lane[lane] <= leave;
      });
    });
  }

  /// As Traversal's; returns the lanes to which some light comes.
  uint32_t attenuate(const RayPacket& rays, uint32_t lanes, const FloatLanes& distance, VectorLanes& light) {
    objects_.mailbox().begin_packet();
    uint32_t lit = lanes;
    for_each_lane(lanes, [&](uint32_t lane) {
      if (((lit >> lane) & 1) == 0) return;
      walk(rays, lane, [&](uint32_t cell, float enter, float leave) {
        attenuate_in(cell, lane, enter, leave, rays, distance, light, lit);
        return ((lit >> lane) & 1) == 0 || distance.lane[lane] <= leave;
      });
    });
    return lit;
  }

  // --- one voxel, for whoever does not walk; objects_.mailbox() says what it has seen of the packet ---

  void find_closest_in(uint32_t cell, const RayPacket& rays, HitPacket& hits) {
    for_each_object(cell, [&](uint32_t self) {
      if (objects_.mailbox().first_visit(self)) objects_.test_closest(rays, self, hits);
      return false;
    });
  }
  /// For the ray of `lane`, which is in the voxel from `enter` to `leave`. Takes the lanes that are shut off
  /// from the light out of `lit`.
  void attenuate_in(uint32_t cell, uint32_t lane, float enter, float leave, const RayPacket& rays,
                    const FloatLanes& distance, VectorLanes& light, uint32_t& lit) {
    for_each_object(cell, [&](uint32_t self) {
      lit &= ~shadowed(rays, self, lane, enter, leave, distance, light);
      return ((lit >> lane) & 1) == 0;
    });
  }

private:
  template <class Visit> void walk(const RayPacket& rays, uint32_t lane, Visit visit) {
    const float origin[3] = {rays.origin.x.lane[lane], rays.origin.y.lane[lane], rays.origin.z.lane[lane]};
    const float direction[3] = {rays.direction.x.lane[lane], rays.direction.y.lane[lane],
                                rays.direction.z.lane[lane]};
    uint64_t voxels = 0;
    scene_.spu().compute(scalar_work::kWalk);
    walk_voxels(grid_, origin, direction, [&](uint32_t cell, float enter, float leave) {
      ++voxels;
      scene_.spu().compute(scalar_work::kVoxel);
      return visit(cell, enter, leave);
    });
    objects_.counters().voxels += voxels;
  }

  /// Calls `visit(object offset)` for the objects of a voxel until it returns true.
  template <class Visit> void for_each_object(uint32_t cell, Visit visit) {
    const CellRecord list = scene_.cell(grid_, cell);
    for (uint32_t i = 0; i < list.count; ++i) {
      scene_.spu().compute(scalar_work::kListedObject);
      if (visit(scene_.list_word(list.list + i * 4))) return;
    }
  }

  /// Lanes that the object shuts off from the light. An opaque object shuts off whatever lanes it covers; a
  /// translucent one dims the ray that is walking, at those crossings that lie in the voxel it is in, so that
  /// each crossing counts once although the object is in the lists of several voxels.
  uint32_t shadowed(const RayPacket& rays, uint32_t self, uint32_t lane, float enter, float leave,
                    const FloatLanes& distance, VectorLanes& light) {
    scene_.spu().compute(scalar_work::kShadow);
    const ObjectRecord& object = *scene_.object(self);
    const uint32_t flags = object.kind_and_flags;
    const uint32_t material = object.material;
    if ((flags & object_flag::no_shadow) != 0) return 0;
    const bool opaque = (flags & object_flag::opaque) != 0;
    if (opaque && !objects_.mailbox().first_visit(self)) return 0;
    ShadowCrossings c;
    objects_.test_shadow(rays, object, self, distance, c);
    if (opaque) return c.near_hit | c.far_hit;
    const uint32_t bit = 1u << lane;
    const auto counts = [&](uint32_t hit, float t) { return (hit & bit) != 0 && t > enter && t <= leave; };
    const uint32_t crossings = static_cast<uint32_t>(counts(c.near_hit, c.near.lane[lane])) +
                               static_cast<uint32_t>(counts(c.far_hit, c.far.lane[lane]));
    if (crossings == 0) return 0;
    return objects_.dim(flags, material, c.u.lane[lane], c.v.lane[lane], crossings, lane, light) ? bit : 0;
  }

  ObjectTests<Spu>& objects_;
  SceneAccess<Spu>& scene_;
  const GridRecord& grid_;
};

} // namespace celltrace::kernel
