// What a bundle of packets sees: what its primary rays hit and what light comes there is searched for
// together; from there on each packet's tree of rays is worked off by itself. Kernel dialect.
#pragma once

#include "kernel/cameras/primary_rays.hpp"
#include "kernel/shading/ray_tracer.hpp"

namespace celltrace::kernel {

template <class Spu, uint32_t kAccelerators = kAnyAccelerator> class BundleTracer {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using Rays = RayTracer<Spu, Intersector<Spu, kAccelerators>>;

  BundleTracer(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene, Rays& tracer)
      : frame_(frame), scene_(scene), tracer_(tracer), members_(spu.template allocate<Member>(kPackets)) {}

  /// Calls `put(column, row, colours)` for each packet in the picture of the bundle at (column, row); that
  /// counts bundles, `put` packets. Or `fill(column, row, colour)` where all of the bundle has one colour and
  /// is in the picture.
  template <class Put, class Fill>
  void trace(uint32_t column, uint32_t row, Put put, [[maybe_unused]] Fill fill) {
    if constexpr (Spu::direct_memory) {
      const PinholeBundle<S> bundle(frame_, column, row);
      const bool missed = !tracer_.intersector().traversal().enter(bundle);
      if (missed && is_whole(column, row))
        return fill(column * kEdge, row * kEdge, tracer_.background(kPackets * kSimdLanes));
      place(column, row);
      if (missed)
        return for_each_member([&](const Member& member) {
          const auto rays = static_cast<uint32_t>(__builtin_popcount(member.lanes));
          put(member.column, member.row, tracer_.background(rays));
        });
      find_hits([&](RayQuery* queries) { tracer_.intersector().traversal().intersect(queries, bundle); });
    } else {
      place(column, row);
      find_hits([&](RayQuery* queries) { tracer_.intersector().traversal().intersect(queries, kPackets); });
    }
    uint32_t lights = 0;
    for_each_light(scene_, frame_, kKnownLights, [&](uint32_t number, const LightRecord& light) {
      // One with an area each packet asks by itself, too.
      if (is_shadowless(light) || has_area(light)) return;
      find_light(number, light);
      lights |= 1u << number;
    });
    for_each_member([&](Member& member) {
      tracer_.intersector().know_light(member.light, lights);
      V3<S> seen = tracer_.trace(member.rays, member.lanes, member.hits, member.points);
      if (member.lanes != member.pixels) {
        const V3<S> black = {F(0.0f), F(0.0f), F(0.0f)};
        seen = select<S>(S::M::from_bits(member.lanes), seen, black);
      }
      put(member.column, member.row, seen);
    });
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
    uint32_t pixels;     ///< lanes in the picture
    uint32_t lanes, hit; ///< of them, those that have a ray; of these, those that hit something
  };

  /// Calls `visit` with each packet in the picture.
  template <class Visit> void for_each_member(Visit visit) {
    for (uint32_t i = 0; i < kPackets; ++i)
      if (members_[i].pixels != 0) visit(members_[i]);
  }

  bool is_whole(uint32_t column, uint32_t row) const {
    constexpr uint32_t kPixels = kEdge * kPacketEdge;
    return (column + 1) * kPixels <= frame_.width && (row + 1) * kPixels <= frame_.height;
  }
  void place(uint32_t column, uint32_t row) {
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = members_[i];
      member.column = column * kEdge + i % kEdge;
      member.row = row * kEdge + i / kEdge;
      const bool inside = member.column < frame_.packet_columns && member.row < frame_.packet_rows;
      member.pixels = inside ? lanes_in_picture(frame_, member.column, member.row) : 0;
      member.lanes = member.pixels;
    }
  }

  /// `run` answers the queries of all packets; those of packets outside are for nothing.
  template <class Run> void find_hits(Run run) {
    RayQuery queries[kPackets];
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = members_[i];
      if (member.pixels != 0)
        member.lanes &= make_primary_rays(scene_.spu(), frame_, member.column, member.row, member.rays);
      queries[i] = {&member.rays, &member.hits, nullptr, nullptr, member.lanes};
    }
    run(queries);
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = members_[i];
      member.hit = hit_lanes<S>(member.hits, member.lanes);
      if (member.hit != 0) find_hit_points(scene_, member.rays, member.hits, member.hit, member.points);
    }
  }

  void find_light(uint32_t number, const LightRecord& light) {
    RayQuery queries[kPackets];
    uint32_t asked = 0;
    for (uint32_t i = 0; i < kPackets; ++i) {
      Member& member = members_[i];
      if (member.hit == 0) continue;
      scene_.spu().compute(scalar_work::kBundleLight);
      const Surfaces<S> surfaces = {member.points.point, member.points.normal,
                                    member.rays.direction.template load<S>(), &member.hits.object};
      IncidentLight<S> incident(light.colour);
      illuminate(scene_.spu(), light, surfaces, member.hit, incident);
      if (incident.facing == 0) continue;
      make_shadow_rays(surfaces, incident, member.shadow_rays, member.distance);
      member.light[number].template store<S>(incident.colour);
      queries[asked++] = {&member.shadow_rays, nullptr, &member.distance, &member.light[number],
                          incident.facing};
    }
    if (asked == 0) return;
    if (is_parallel(light))
      tracer_.intersector().traversal().intersect(queries, asked);
    else
      tracer_.intersector().traversal().intersect(queries, asked, light.location);
  }

  const FrameBlock& frame_;
  SceneAccess<Spu>& scene_;
  Rays& tracer_;
  Member* members_;
};

} // namespace celltrace::kernel
