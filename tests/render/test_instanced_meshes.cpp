// Meshes of which a scene image has one copy for all their instances.
#include "celltrace/error.hpp"
#include "celltrace/image.hpp"
#include "celltrace/ray_queries.hpp"
#include "celltrace/render.hpp"
#include "celltrace/session.hpp"
#include "kernel/primitives/instances_module.hpp"
#include "render/backends.hpp"
#include "render/image_bytes.hpp"
#include "render/scenes.hpp"
#include "scene_image/mesh_bvh.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <iterator>
#include <random>

#include <glm/geometric.hpp>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

constexpr unsigned kInstances = 1000;
constexpr int kRings = 16; ///< a ball of 1,000 triangles about

/// Balls of one smooth mesh with two materials, of which one is the ball's, side by side.
Scene balls(unsigned count = kInstances) {
  Scene scene;
  for (int i = 0; i < 4; ++i)
    scene.add(matte({0.2 + 0.2 * i, 0.9 - 0.2 * i, 0.5}));
  scene.camera = camera_at({0, 0, -40}, {0, 0, 0});
  Light light;
  light.location = {30, 50, -60};
  scene.lights.push_back(light);
  Mesh ball = ball_mesh(kRings);
  for (std::size_t t = 0; t < ball.triangles.size(); t += 3)
    std::fill_n(ball.triangles[t].material, 3, Index{3});
  const Object object = mesh_object(ball, 0, scene.add(Interior{}));
  for (unsigned i = 0; i < count; ++i) {
    scene.objects.push_back(object);
    scene.objects.back().material = i % 3;
    const double mirrored = i % 2 == 0 ? 1 : -1;
    scene.objects.back().transform =
        Transform::scale({0.5, mirrored * (0.2 + 0.05 * (i % 7)), 0.5})
            .then(Transform::rotate({10.0 * i, 25.0 * i, 0}))
            .then(Transform::translate({(i % 10) - 4.5, i / 10 % 10 - 4.5, i / 100 * 1.0}));
  }
  return scene;
}

std::uint32_t triangles_of(const Scene& scene) {
  const auto& mesh = *std::get<std::shared_ptr<const Mesh>>(scene.objects.front().shape);
  return static_cast<std::uint32_t>(
      std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Mesh::Triangle& triangle) {
        const Vec3 a(mesh.vertices[triangle.vertex[0]]), b(mesh.vertices[triangle.vertex[1]]),
            c(mesh.vertices[triangle.vertex[2]]);
        return glm::length(glm::cross(b - a, c - a)) > 0;
      }));
}

/// The same with a mesh of its own for each object.
Scene without_instances(Scene scene) {
  for (Object& object : scene.objects) {
    auto& mesh = std::get<std::shared_ptr<const Mesh>>(object.shape);
    mesh = std::make_shared<const Mesh>(*mesh);
  }
  return scene;
}

using Preparation = RenderStatistics::Preparation;

Image render_on(const TestBackend& backend, unsigned spes, const Scene& scene) {
  const RenderResult result = render(scene, backend.options(pixels(96), pixels(64), spes));
  REQUIRE(result.complete);
  REQUIRE(result.statistics.diagnostics.empty());
  return result.image;
}

/// Boxes of triangles, all of them in the leaves below a node once.
void check_node(const std::vector<NodeRecord>& nodes, const std::vector<Aabb>& bounds, std::uint32_t number,
                std::uint32_t level, const Aabb& around, std::vector<unsigned>& seen) {
  REQUIRE(level <= kMaxMeshLevels);
  const NodeRecord& node = nodes[number];
  for (std::size_t i = 0; i < std::size(node.child); ++i) {
    if ((node.child[i] | node.leaf[i]) == 0) continue;
    Aabb box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = node.bounds[2 * axis][i];
      box.max[axis] = node.bounds[2 * axis + 1][i];
    }
    const auto is_in = [](const Aabb& inner, const Aabb& outer) {
      const Aabb both = united(inner, outer);
      return std::equal(both.min, both.min + 3, outer.min) && std::equal(both.max, both.max + 3, outer.max);
    };
    REQUIRE(is_in(box, around));
    if (node.leaf[i] == 0) {
      REQUIRE(node.child[i] > number);
      check_node(nodes, bounds, node.child[i], level + 1, box, seen);
      continue;
    }
    REQUIRE(node.leaf[i] == leaf_word::make(leaf_word::count(node.leaf[i]), 1));
    for (std::uint32_t t = 0; t < leaf_word::count(node.leaf[i]); ++t) {
      REQUIRE(is_in(bounds[node.child[i] + t], box));
      ++seen[node.child[i] + t];
    }
  }
}

void check_bvh(const std::vector<Aabb>& bounds) {
  const std::vector<NodeRecord> nodes = build_mesh_bvh(bounds);
  std::vector<unsigned> seen(bounds.size());
  constexpr float kFar = 1e30f;
  check_node(nodes, bounds, 0, 1, {{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}}, seen);
  CHECK(std::count(seen.begin(), seen.end(), 1u) == static_cast<std::ptrdiff_t>(bounds.size()));
}

} // namespace

TEST_CASE("The BVH of a mesh has each triangle once, in few levels") {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  for (const std::size_t count : {1u, 2u, 4u, 5u, 16u, 17u, 1000u, 40000u}) {
    std::vector<Aabb> scattered(count), alike(count, Aabb{{0, 0, 0}, {1, 1, 0}}), nested(count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        scattered[i].min[axis] = 10 * unit(random);
        scattered[i].max[axis] = scattered[i].min[axis] + unit(random);
        // Each far larger than all before it together: the SAH would split them off one by one.
        nested[i].max[axis] = std::pow(1.7f, static_cast<float>(i % 100));
        nested[i].min[axis] = 0;
      }
    }
    INFO(count);
    check_bvh(scattered);
    check_bvh(alike);
    check_bvh(nested);
  }
}

TEST_CASE("A thousand instances of a mesh take a thousand records") {
  const Scene scene = balls();
  const SceneImage image(scene);
  const ImageHeader& h = image.header();
  CHECK(h.object_count == kInstances);
  CHECK(h.instance_count == kInstances);
  CHECK(h.mesh_object_count == triangles_of(scene));
  CHECK(h.prototype_count == 0);
  CHECK(h.bytes < 600'000);
  const Bytes bytes = bytes_of(image);
  CHECK((bytes_of(SceneImage::from_bytes(bytes)) == bytes));
  AlignedBlock work;
  SceneImage again(balls(10));
  for (unsigned threads : {1u, 2u, 5u}) {
    again.assign(scene, work, threads, 100);
    CHECK((bytes_of(again) == bytes));
  }
}

TEST_CASE("Few instances are copies, and so are those that rays do not see as others") {
  CHECK(SceneImage(balls(100)).header().instance_count == 0);
  Scene scene = balls();
  scene.materials[2].pigment.transmit = 0.5;
  scene.objects[0].no_shadow = true;
  scene.objects[3].no_image = true;
  scene.objects[6].no_reflection = true;
  scene.objects[9].is_lit_through = true;
  scene.objects[12].transform = Transform();
  scene.objects[12].transform.rows[0] = Vec3(1e-9, 0, 0); // no triangle keeps its area for certain
  scene.objects[15].transform =
      Transform::scale({1e6, 1e6, 1e6}); // single precision has no room for its space
  const ImageHeader h = SceneImage(scene).header();
  CHECK(h.instance_count == kInstances - (kInstances / 3 + 6));
  CHECK(h.object_count > h.instance_count + 300 * triangles_of(scene));
  // Where a material of the mesh's own lets light through, all are.
  scene = balls();
  scene.materials[3].pigment.filter = 0.5;
  CHECK(SceneImage(scene).header().instance_count == 0);
}

TEST_CASE("A sealed scene image with a fault in its instances is refused") {
  const Bytes good = bytes_of(SceneImage(balls()));
  using Change = std::function<void(ImageHeader&, InstanceRecord*, ObjectRecord*, NodeRecord*)>;
  const auto refused = [&](const Change& change) {
    Bytes bytes = good;
    ImageHeader& header = header_of(bytes);
    change(header, table<InstanceRecord>(bytes, header.instance_offset),
           table<ObjectRecord>(bytes, header.mesh_object_offset),
           table<NodeRecord>(bytes, header.mesh_node_offset));
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  using H = ImageHeader;
  using I = InstanceRecord;
  using O = ObjectRecord;
  using N = NodeRecord;
  refused([](H& h, I*, O*, N*) { --h.instance_count; });
  refused([](H& h, I*, O*, N*) { h.instance_offset = 0xFFFFFF80; });
  refused([](H& h, I*, O*, N*) { --h.mesh_object_count; });
  refused([](H& h, I*, O*, N*) { --h.mesh_node_count; });
  refused([](H&, I* instances, O*, N*) { instances[0].first_number = 0; });
  refused([](H&, I* instances, O*, N*) { --instances[7].first_number; });
  refused([](H& h, I* instances, O*, N*) { instances[h.instance_count - 1].first_number = 0x7FFFFFF0; });
  refused([](H&, I* instances, O*, N*) { --instances[5].triangle_count; });
  refused([](H&, I* instances, O*, N*) { instances[5].first_triangle += sizeof(O); });
  refused([](H&, I* instances, O*, N*) { instances[5].root += 4; });
  refused([](H&, I* instances, O*, N*) { instances[5].material = kNoOffset; });
  refused([](H&, I* instances, O*, N*) { instances[5].interior = 1; });
  refused([](H&, I* instances, O*, N*) { instances[5].kind_and_flags |= object_flag::smooth; });
  refused([](H&, I*, O* triangles, N*) { triangles[3].kind_and_flags = 0; });
  refused([](H&, I*, O* triangles, N*) { triangles[3].kind_and_flags |= object_flag::blended; });
  refused([](H&, I*, O* triangles, N*) { triangles[3].material = 32; });
  refused([](H&, I*, O* triangles, N*) { triangles[3].extra = kNoOffset; });
  refused([](H&, I* instances, O*, N* nodes) { nodes[0].child[0] = instances[0].root; });
  refused([](H& h, I*, O*, N* nodes) {
    nodes[0].leaf[0] = leaf_word::make(4, 1);
    nodes[0].child[0] = h.mesh_object_offset + (h.mesh_object_count - 1) * std::uint32_t{sizeof(O)};
  });
  refused([](H& h, I*, O*, N* nodes) {
    nodes[0].leaf[0] = leaf_word::make(17, 1);
    nodes[0].child[0] = h.mesh_object_offset;
  });
  refused([](H& h, I*, O*, N* nodes) {
    nodes[0].leaf[0] = leaf_word::make(2, 2);
    nodes[0].child[0] = h.mesh_object_offset;
  });
  // An object that is none of them.
  Bytes bytes = good;
  auto* const object = table<ObjectRecord>(bytes, header_of(bytes).object_offset);
  const std::uint32_t nowhere = 64;
  std::memcpy(table<ExtraRecord>(bytes, object->extra)->value, &nowhere, sizeof nowhere);
  seal(bytes);
  CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
}

TEST_CASE("Instances look as meshes of their own do") {
  const Scene scene = balls();
  const Image expected = render_on(backends().front(), 1, without_instances(scene));
  const Image first = render_on(backends().front(), 1, scene);
  CHECK(compare_images(expected, first).psnr > 50);
  for (const TestBackend& backend : backends())
    for (unsigned spes : {1u, 3u}) {
      INFO(backend.spu() << " with " << spes);
      CHECK(render_on(backend, spes, scene) == first);
    }
}

TEST_CASE("Instances move and hide as other objects do") {
  for (const TestBackend& backend : {backends().front(), backends().back()}) {
    INFO(backend.spu());
    Session session(balls(), backend.options(48, 32, 2));
    session.render();
    const auto picture = [&](const Scene& scene) { return render(scene, session.options()).image; };
    Scene scene = balls();
    const Transform nearer = Transform::scale({3, 3, 3}).then(Transform::translate({0, 0, -8}));
    scene.objects[555].transform = nearer;
    session.set_transform(555, nearer);
    RenderResult next = session.render();
    CHECK(next.statistics.preparation == Preparation::refitted);
    CHECK(next.image == picture(scene));
    scene.objects[555].is_hidden = true;
    session.show(555, false);
    next = session.render();
    CHECK(next.statistics.preparation == Preparation::refitted);
    CHECK(next.image == picture(scene));
  }
}

TEST_CASE("Rays of applications tell instances apart") {
  const Scene scene = balls();
  RenderOptions options;
  options.width = options.height = 8;
  options.ray_queries = true;
  Renderer renderer(options);
  renderer.render(scene);
  RayQueries queries = renderer.ray_queries();
  for (std::uint32_t i = 0; i < 100; ++i) {
    const Ray ray = {{static_cast<float>(i % 10) - 4.5f, static_cast<float>(i / 10) - 4.5f, -20}, {0, 0, 1}};
    const RayHit hit = queries.closest_hit(ray);
    REQUIRE(hit);
    CHECK(hit.object == i);
    RayHit of_many;
    queries.closest_hits({&ray, 1}, {&of_many, 1});
    CHECK(of_many.object == i);
    CHECK(of_many.distance == Approx(hit.distance));
    CHECK(queries.occluded(ray));
    const RaySurface surface = queries.surface(ray, hit);
    CHECK(surface.point[2] == Approx(-20 + hit.distance).margin(1e-4));
    CHECK(surface.normal[2] < 0);
    const Ray on = {{surface.point[0], surface.point[1], surface.point[2] - 0.01f}, {0, 0, -1}};
    CHECK_FALSE(queries.closest_hit(on));
  }
}
