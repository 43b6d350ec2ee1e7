// Points and normals where rays hit, against the reference's geometry.
#include "compiled_once.hpp"
#include "kernel/shading/hit_points.hpp"
#include "prepared_scene.hpp"
#include "reference/geometry.hpp"
#include "soups.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

/// As soup(), with smooth triangles.
Scene smooth_soup(unsigned seed) {
  Scene scene = soup(seed, {30, 30, 60}, 5, 2);
  Random random(seed + 1);
  Object& object = scene.objects.back();
  Mesh mesh = *std::get<std::shared_ptr<const Mesh>>(object.shape);
  for (Mesh::Triangle& triangle : mesh.triangles) {
    if (random.below(3) == 0) continue;
    for (Index& normal : triangle.normal) {
      normal = static_cast<Index>(mesh.normals.size());
      mesh.normals.emplace_back(random.direction() * 3.0 +
                                Vec3(0, 5, 0)); // of any length, not all that different
    }
  }
  object.shape = std::make_shared<const Mesh>(mesh);
  object.transform = Transform::scale({1, 0.5, 2}).then(Transform::rotate({10, 20, 30}));
  return scene;
}

} // namespace

TEST_CASE("Points, normals and materials of hits") {
  for (unsigned seed : {70u, 80u, 90u}) {
    const Scene source = smooth_soup(seed);
    const std::vector<reference::Shape> shapes = reference::shapes_of(source);
    PreparedScene scene(source);
    REQUIRE(scene.prepare().built);
    REQUIRE(scene.object_count() == shapes.size());
    DirectSpu spu;
    SceneAccess<DirectSpu> access(spu, CacheConfig(), scene.frame().image);
    Traversal<DirectSpu> traversal(access, scene.frame());
    Random random(seed);
    unsigned compared = 0;
    for (int k = 0; k < 500; ++k) {
      RayPacket rays;
      for (unsigned l = 0; l < kSimdLanes; ++l) {
        set(rays.direction, l, random.direction());
        set(rays.origin, l, random.point(5) - test::at(rays.direction, l) * 10.0);
        rays.start_object.lane[l] = kNoOffset;
      }
      HitPacket hits;
      traversal.find_closest(rays, 0xFFFF, hits);
      std::uint32_t lanes = 0;
      for (unsigned l = 0; l < kSimdLanes; ++l)
        lanes |= hits.object.lane[l] != kNoOffset ? 1u << l : 0;
      if (lanes == 0) continue;
      HitPoints<Simd> found;
      find_hit_points(access, rays, hits, lanes, found);
      const VectorLanes points = lanes_of(found.point);
      const VectorLanes normals = lanes_of(found.normal);
      for_each_lane(lanes, [&](unsigned l) {
        const std::uint32_t index = (hits.object.lane[l] - scene.header().object_offset) / 64;
        const reference::Shape& shape = shapes[index];
        const reference::Ray ray = {test::at(rays.origin, l), test::at(rays.direction, l)};
        const reference::Crossings crossings = cross(shape, ray);
        REQUIRE(found.material.lane[l] == material_word::offset(scene.object(index).material));
        REQUIRE(found.interior.lane[l] == scene.object(index).interior);
        REQUIRE(((found.blended >> l & 1) != 0) == shape.blended);
        if (crossings.count == 0) return; // on an edge
        const reference::Crossing& hit =
            crossings.at[crossings.at[0].distance > 1e-4 ? 0 : crossings.count - 1];
        const Vec3 point = ray.origin + ray.direction * hit.distance;
        Vec3 normal = normal_at(shape, point, hit);
        const double slope = std::abs(glm::dot(normal, ray.direction));
        if (slope < 0.05) return; // grazing: rounding moves the point far along the surface
        if (glm::dot(normal, ray.direction) > 0) normal = -normal;
        REQUIRE(glm::length(test::at(points, l) - point) < 5e-5 / slope);
        REQUIRE(glm::length(test::at(normals, l) - normal) < 1e-4 / slope);
        ++compared;
      });
    }
    CHECK(compared > 2000);
  }
}
