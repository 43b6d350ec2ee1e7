// What a bundle of packets sees: what its primary rays hit and what light comes there is searched for
// together; from there on each packet's tree of rays is worked off by itself. Kernel dialect.
#pragma once

#include "kernel/primary_rays.hpp"
#include "kernel/ray_tracer.hpp"

namespace celltrace::kernel {

template <class Spu> class BundleTracer {
public:
  using S = typename Spu::simd;

  BundleTracer(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene, RayTracer<Spu>& tracer)
      : frame_(frame), scene_(scene), tracer_(tracer), members_(spu.template allocate<Member>(kPackets)) {}

  /// Calls `put(column, row, colours)` for each packet in the picture of the bundle at (column, row); that
  /// counts bundles, `put` packets.
  template <class Put> void trace(uint32_t column, uint32_t row, Put put) {
    const uint32_t count = make_rays(column, row);
    find_hits(count);
    const uint32_t lights = frame_.light_count < kKnownLights ? frame_.light_count : kKnownLights;
    for (uint32_t light = 0; light < lights; ++light)
      find_light(light, count);
    for (uint32_t i = 0; i < count; ++i) {
      Member& member = members_[i];
      tracer_.finder().know_light(member.light, lights);
      put(member.column, member.row, tracer_.trace(member.rays, member.lanes, member.hits, member.points));
    }
  }

private:
  static constexpr uint32_t kEdge = kBundleEdge<Spu>;
  static constexpr uint32_t kPackets = kBundlePackets<Spu>;
  /// Of further lights each packet asks by itself.
  static constexpr uint32_t kKnownLights = 4;

  struct Member {
    RayPacket rays;
    HitPacket hits;
    HitPoints<S> points;
    RayPacket shadow_rays; ///< toward the light that is asked of
    FloatLanes distance;
    VectorLanes light[kKnownLights]; ///< that comes to the points
    uint32_t column, row;
    uint32_t lanes, hit; ///< in the picture; of them, those that hit something
  };

  /// Returns the number of packets.
  uint32_t make_rays(uint32_t column, uint32_t row) {
    uint32_t count = 0;
    for (uint32_t y = row * kEdge; y < (row + 1) * kEdge && y < frame_.packet_rows; ++y)
      for (uint32_t x = column * kEdge; x < (column + 1) * kEdge && x < frame_.packet_columns; ++x) {
        Member& member = members_[count++];
        member.column = x;
        member.row = y;
        member.lanes = lanes_in_picture(frame_, x, y);
        make_primary_rays<S>(frame_, x, y, member.rays);
      }
    return count;
  }

  void find_hits(uint32_t count) {
    Search searches[kPackets];
    for (uint32_t i = 0; i < count; ++i)
      searches[i] = {&members_[i].rays, &members_[i].hits, nullptr, nullptr, members_[i].lanes};
    tracer_.finder().traversal().run(searches, count);
    for (uint32_t i = 0; i < count; ++i) {
      Member& member = members_[i];
      member.hit = hit_lanes(member.hits, member.lanes);
      if (member.hit != 0) find_hit_points(scene_, member.rays, member.hits, member.hit, member.points);
    }
  }

  void find_light(uint32_t number, uint32_t count) {
    const LightRecord light = light_at(scene_, frame_, number);
    if ((light.flags & light_flag::shadowless) != 0) return;
    Search searches[kPackets];
    uint32_t asked = 0;
    for (uint32_t i = 0; i < count; ++i) {
      Member& member = members_[i];
      if (member.hit == 0) continue;
      const Surfaces<S> surfaces = {member.points.point, member.points.normal,
                                    member.rays.direction.template load<S>(), &member.hits.object};
      const Bearing<S> bearing(light, surfaces, member.hit);
      if (bearing.facing == 0) continue;
      make_shadow_rays(surfaces, bearing, member.shadow_rays, member.distance);
      member.light[number].template store<S>(splat3<S>(light.colour));
      searches[asked++] = {&member.shadow_rays, nullptr, &member.distance, &member.light[number],
                           bearing.facing};
    }
    if (asked != 0) tracer_.finder().traversal().run(searches, asked);
  }

  const FrameBlock& frame_;
  SceneAccess<Spu>& scene_;
  RayTracer<Spu>& tracer_;
  Member* members_;
};

} // namespace celltrace::kernel
