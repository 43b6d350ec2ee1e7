// A kernel that tests the packets of a bundle against the triangles of a leaf, again and again, by one of the
// tests that there are. For memory that is direct.
#pragma once

#include "kernel/entry/strategies.hpp"

#include <stdint.h>

namespace celltrace::bench {

enum class TriangleTest : uint32_t {
  single,        ///< primitives/triangle.hpp: a packet against one triangle, for the closest hits
  pinhole,       ///< pinhole_triangles.hpp: the same, with what the rays of one origin have in common
  by_ray,        ///< leaf_tests.hpp: one ray of a packet against all triangles
  shadow_single, ///< as `single`, for shadow rays
  shadow_volumes ///< shadow_volumes.hpp: the same by the origins of rays to one light
};

struct alignas(128) TriangleTask {
  kernel::RayPacket packets[kSimdLanes];
  kernel::HitPacket hits[kSimdLanes];    ///< answers
  kernel::FloatLanes light[kSimdLanes];  ///< distances of a light
  kernel::ShadowOrigins origins;         ///< of shadow rays toward it
  kernel::ObjectRecord leaf[kSimdLanes]; ///< triangles
  float eye[3];                          ///< the origin of primary rays
  uint32_t triangle_count, packet_count;
  uint32_t lanes; ///< the rays of each packet
  uint32_t rounds;
  TriangleTest test;
  uint32_t occluded[kSimdLanes]; ///< answers: rays, by packet
};

/// The offset of triangle `i`, as in a scene image.
inline uint32_t triangle_offset(uint32_t i) {
  return i * static_cast<uint32_t>(sizeof(kernel::ObjectRecord));
}

/// The test of a packet against the triangles one by one, as of ObjectTests.
template <class Spu, class Visit> void test_single(const TriangleTask& task, Visit visit) {
  using S = typename Spu::simd;
  for (uint32_t i = 0; i < task.triangle_count; ++i) {
    const auto sides = kernel::TriangleSides<S>::of(task.leaf[i]);
    for (uint32_t packet = 0; packet < task.packet_count; ++packet) {
      const kernel::RayPacket& rays = task.packets[packet];
      const kernel::TriangleTest<S> triangle(rays.origin.template load<S>(), sides);
      visit(i, packet, triangle.crossed(rays, triangle_offset(i)));
    }
  }
}

template <class Spu> void test_triangles(TriangleTask& task) {
  using namespace kernel;
  using S = typename Spu::simd;
  using Tests = ObjectTests<Spu>;
  if (task.test == TriangleTest::single) {
    test_single<Spu>(task, [&](uint32_t i, uint32_t packet, const Crossings<S>& crossings) {
      kernel::keep_closest<S>(crossings, triangle_offset(i), task.hits[packet]);
    });
    return;
  }
  if (task.test == TriangleTest::shadow_single) {
    test_single<Spu>(task, [&](uint32_t, uint32_t packet, const Crossings<S>& crossings) {
      task.occluded[packet] |= Tests::shadow_hits(crossings, task.light[packet]).near;
    });
    return;
  }
  LeafTriangles<S> triangles(task.leaf);
  for (uint32_t i = 0; i < task.triangle_count; ++i)
    triangles.add(triangle_offset(i));
  triangles.fill();
  const TriangleSides<S> sides = triangles.sides();
  if (task.test == TriangleTest::pinhole) {
    const PinholeTriangles<S> seen(sides, task.eye);
    for (uint32_t i = 0; i < task.triangle_count; ++i)
      for (uint32_t packet = 0; packet < task.packet_count; ++packet)
        kernel::keep_closest<S>(seen.crossed(i, task.packets[packet].direction.template load<S>()),
                                triangle_offset(i), task.hits[packet]);
  } else if (task.test == TriangleTest::shadow_volumes) {
    const ShadowVolumes<S> volumes(sides, task.origins);
    for (uint32_t i = 0; i < task.triangle_count; ++i)
      for (uint32_t packet = 0; packet < task.packet_count; ++packet) {
        const auto starts_on = lanes_that_start_on<S>(task.packets[packet], triangle_offset(i));
        task.occluded[packet] |= (volumes.crossed(i, task.origins, packet) & !starts_on).bits();
      }
  } else {
    for (uint32_t packet = 0; packet < task.packet_count; ++packet)
      for_each_lane(task.lanes, [&](uint32_t lane) {
        LeafTests<Spu>::keep_closest(LeafTests<Spu>::crossed(task.packets[packet], lane, sides, triangles),
                                     triangles, lane, task.hits[packet]);
      });
  }
}

template <class Spu> void triangle_loop(Spu&, ea_t argument) {
  TriangleTask& task = *reinterpret_cast<TriangleTask*>(static_cast<uintptr_t>(argument));
  for (uint32_t round = 0; round < task.rounds; ++round) {
    test_triangles<Spu>(task);
    __asm__ volatile("" ::: "memory"); // nothing of a round is computed before it
  }
}

} // namespace celltrace::bench
