// SceneImage: groups of objects, and copies of them where a mesh is placed more than once.
#include "celltrace/error.hpp"
#include "kernel/accel/object_bounds.hpp"
#include "render/image_bytes.hpp"
#include "render/scenes.hpp"
#include "scene_image/mesh_prototype.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

/// Spheres and two meshes, one of them smooth and in several materials, in no order.
Scene crowd(int triangles, double reach) {
  Scene scene;
  for (int i = 0; i < 3; ++i)
    scene.add(matte({0.2 * i, 1, 1}));
  scene.add(Interior{});
  unsigned state = 1;
  const auto random = [&] { return (state = state * 1664525 + 1013904223) / 4294967296.0; };
  Mesh flat, smooth;
  for (Mesh* mesh : {&flat, &smooth})
    for (int i = 0; i < triangles; ++i) {
      const Vec3 at = reach * Vec3(random(), random(), random());
      const auto first = static_cast<Index>(mesh->vertices.size());
      for (int corner = 0; corner < 3; ++corner)
        mesh->vertices.push_back(Vec3f(at + Vec3(random(), random(), random())));
      mesh->triangles.push_back({{first, first + 1, first + 2}});
      if (mesh == &flat || i % 3 == 0) continue;
      mesh->normals.insert(mesh->normals.end(),
                           {{0, 1, 0.1f * static_cast<float>(i % 5)}, {0, 1, 0}, {1, 0, 0}});
      const auto normal = static_cast<Index>(mesh->normals.size()) - 3;
      Mesh::Triangle& last = mesh->triangles.back();
      for (Index corner = 0; corner < 3; ++corner) {
        last.normal[corner] = normal + corner;
        last.material[corner] = i % 2 == 0 ? corner : 2;
      }
    }
  scene.objects = {mesh_object(flat, 0, 0)};
  for (int i = 0; i < triangles; ++i)
    scene.objects.push_back(sphere_at(reach * Vec3(random(), random(), random()), 0.5 * random(), 1, 0));
  scene.objects.push_back(mesh_object(smooth, 1, 0));
  scene.objects.back().transform = Transform::rotate({10, 20, 30});
  return scene;
}

} // namespace

TEST_CASE("An image of many objects has them by group, the same whoever makes it") {
  for (const double reach : {0.0, 30.0, 1000.0}) {
    INFO(reach);
    Scene scene = crowd(9000, reach);
    const SceneImage image(scene);
    const ImageHeader& h = image.header();
    REQUIRE(h.object_count == 27000);
    REQUIRE(h.group_count > 1);
    // Spheres around one point cannot be told apart.
    CHECK((h.longest_group <= 256) == (reach > 0));
    const auto* objects = table<ObjectRecord>(image, h.object_offset);
    const auto* groups = table<GroupRecord>(image, h.group_offset);
    std::uint32_t next = 0;
    for (std::uint32_t group = 0; group < h.group_count; ++group) {
      REQUIRE(groups[group].first == next);
      for (; next < groups[group].first + groups[group].count; ++next) {
        const Aabb box = bounding_box(objects[next]);
        for (int axis = 0; axis < 3; ++axis) {
          REQUIRE(box.min[axis] >= groups[group].min[axis]);
          REQUIRE(box.max[axis] <= groups[group].max[axis]);
        }
      }
    }
    REQUIRE(next == h.object_count);
    CHECK(h.extra_count == 6000);
    CHECK(h.blend_count == 3000);
    const Bytes bytes = bytes_of(image);
    CHECK(bytes_of(SceneImage::from_bytes(bytes)) == bytes);
    // In memory that held something else.
    SceneImage again(crowd(100, 1));
    AlignedBlock work;
    for (unsigned threads : {1u, 2u, 3u, 7u}) {
      again.assign(scene, work, threads, 1000);
      CHECK(bytes_of(again) == bytes);
    }
    // A scene that is refused changes nothing.
    scene.objects.push_back(sphere_at({1e30, 0, 0}, 1, 0, 0));
    CHECK_THROWS_AS(again.assign(scene, work, 2, 1000), InputError);
    CHECK(bytes_of(again) == bytes);
  }
}

TEST_CASE("A sealed scene image with a fault in its groups is refused") {
  const Bytes good = bytes_of(SceneImage(crowd(3000, 10)));
  const auto refused = [&](const std::function<void(ImageHeader&, GroupRecord*)>& change) {
    Bytes bytes = good;
    change(header_of(bytes), table<GroupRecord>(bytes, header_of(bytes).group_offset));
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  refused([](ImageHeader&, GroupRecord* groups) { ++groups[1].first; });
  refused([](ImageHeader&, GroupRecord* groups) { groups[0].count = 0; });
  refused([](ImageHeader& h, GroupRecord* groups) { groups[h.group_count - 1].count = 0xFFFFFFFF; });
  refused([](ImageHeader& h, GroupRecord*) { --h.group_count; });
  refused([](ImageHeader& h, GroupRecord*) { --h.longest_group; });
  refused([](ImageHeader& h, GroupRecord*) { h.group_offset = 0xFFFFFF80; });
}

namespace {

/// The triangles of a mesh without shared vertices.
Mesh taken_apart(const Mesh& mesh) {
  Mesh apart;
  for (Mesh::Triangle triangle : mesh.triangles) {
    for (Index* indices : {triangle.vertex, triangle.normal}) {
      auto& points = indices == triangle.vertex ? apart.vertices : apart.normals;
      const auto& from = indices == triangle.vertex ? mesh.vertices : mesh.normals;
      for (int corner = 0; corner < 3; ++corner) {
        points.push_back(from[indices[corner]]);
        indices[corner] = static_cast<Index>(points.size()) - 1;
      }
    }
    apart.triangles.push_back(triangle);
  }
  return apart;
}

/// Two meshes several times each, one of them smooth, spheres between them, and a mesh of its own.
Scene instances(unsigned of_each, int rings = 12) {
  Scene scene;
  for (int i = 0; i < 4; ++i)
    scene.add(matte({0.2 * i, 1, 1}));
  scene.materials[1].pigment.transmit = 0.5;
  const Object ball = mesh_object(taken_apart(ball_mesh(rings)), 0, scene.add(Interior{}));
  Mesh plates = ball_mesh(7);
  for (std::size_t t = 0; t < plates.triangles.size(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      plates.triangles[t].normal[corner] = kNoIndex;
      if (t % 5 == 0) plates.triangles[t].material[corner] = 3;
    }
  const Object plate = mesh_object(plates, 1, scene.add(Interior{}));
  for (unsigned i = 0; i < of_each; ++i) {
    for (const Object& object : {ball, plate}) {
      scene.objects.push_back(object);
      scene.objects.back().material = i % 3;
      scene.objects.back().transform =
          Transform::scale({1, 0.5 + 0.1 * (i % 7), 1})
              .then(Transform::rotate({10.0 * i, 25.0 * i, 0}))
              .then(Transform::translate({2.5 * (i % 5), 2.5 * (i / 5), i % 2 * 1.0}));
    }
    if (i % 4 == 1) scene.objects.push_back(sphere_at({1.0 * i, -2, 0}, 0.5, 2, 0));
  }
  scene.objects.push_back(mesh_object(ball_mesh(3), 2, 1));
  return scene;
}

/// The same with a mesh of its own for each object.
Scene without_instances(Scene scene) {
  for (Object& object : scene.objects)
    if (auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape))
      *mesh = std::make_shared<const Mesh>(**mesh);
  return scene;
}

/// Everything that records of objects say, in an order of its own: normals in place of their offsets.
std::vector<std::vector<float>> contents(const SceneImage& image) {
  const ImageHeader& h = image.header();
  std::vector<std::vector<float>> all;
  for (std::uint32_t i = 0; i < h.object_count; ++i) {
    const ObjectRecord& object = table<ObjectRecord>(image, h.object_offset)[i];
    std::vector<float> words = {static_cast<float>(object.kind_and_flags),
                                static_cast<float>((object.material - h.material_offset) / 128),
                                static_cast<float>((object.interior - h.interior_offset) / 16)};
    words.insert(words.end(), object.geometry, object.geometry + 12);
    if ((object.kind_and_flags & object_flag::smooth) != 0) {
      const auto& normals = *table<ExtraRecord>(image, object.extra);
      words.insert(words.end(), normals.value, normals.value + 9);
    } else {
      CHECK(object.extra == kNoOffset);
    }
    all.push_back(words);
  }
  std::sort(all.begin(), all.end());
  return all;
}

} // namespace

TEST_CASE("Instances of a mesh are copies of groups") {
  const Scene scene = instances(30);
  const SceneImage image(scene);
  const ImageHeader& h = image.header();
  REQUIRE(h.prototype_count == h.group_count);
  CHECK(h.longest_group <= kMaxCopiedObjects);
  const auto* objects = table<ObjectRecord>(image, h.object_offset);
  const auto* groups = table<GroupRecord>(image, h.group_offset);
  const auto* prototypes = table<std::uint32_t>(image, h.prototype_offset);
  std::uint32_t next = 0, copies = 0, alone = 0;
  for (std::uint32_t group = 0; group < h.group_count; ++group) {
    REQUIRE(groups[group].first == next);
    Aabb around = bounding_box(objects[next]);
    for (const std::uint32_t end = next + groups[group].count; next < end; ++next)
      around = united(around, bounding_box(objects[next]));
    CHECK(std::equal(around.min, around.min + 3, groups[group].min));
    CHECK(std::equal(around.max, around.max + 3, groups[group].max));
    if (prototypes[group] == kNoGroup)
      ++alone;
    else if (prototypes[group] != group)
      ++copies;
    if (prototypes[group] == kNoGroup) continue;
    REQUIRE(prototypes[prototypes[group]] == prototypes[group]);
    REQUIRE(groups[prototypes[group]].count == groups[group].count);
  }
  CHECK(next == h.object_count);
  CHECK(alone > 0);
  CHECK(copies == (h.group_count - alone) / 30 * 29);

  const SceneImage apart(without_instances(scene));
  CHECK(apart.header().prototype_count == 0);
  CHECK((contents(image) == contents(apart)));
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(h.bounds_min[axis] == apart.header().bounds_min[axis]);
    CHECK(h.bounds_max[axis] == apart.header().bounds_max[axis]);
  }
  const Bytes bytes = bytes_of(image);
  CHECK((bytes_of(SceneImage::from_bytes(bytes)) == bytes));
  AlignedBlock work;
  SceneImage again(crowd(100, 1));
  for (unsigned threads : {1u, 2u, 3u, 7u}) {
    again.assign(scene, work, threads, 1000);
    CHECK((bytes_of(again) == bytes));
  }
}

TEST_CASE("Instances of a large mesh are copies of short groups") {
  const Scene scene = instances(2, 60);
  const SceneImage image(scene);
  REQUIRE(image.header().prototype_count == image.header().group_count);
  CHECK(image.header().longest_group <= kMaxCopiedObjects);
  CHECK((contents(image) == contents(SceneImage(without_instances(scene)))));
  const Bytes bytes = bytes_of(image);
  AlignedBlock work;
  SceneImage again;
  for (unsigned threads : {2u, 5u}) {
    again.assign(scene, work, threads, 1000);
    CHECK((bytes_of(again) == bytes));
  }
}

TEST_CASE("Groups of a prototype are short where nothing tells triangles apart") {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles.resize(5000, {{0, 1, 2}});
  const MeshPrototype prototype(mesh, 2);
  CHECK(prototype.triangles().size() == 5000);
  CHECK(prototype.vertices().size() == 3);
  REQUIRE(prototype.groups().back() == 5000);
  for (std::uint32_t group = 0; group < prototype.group_count(); ++group) {
    REQUIRE(prototype.groups()[group] < prototype.groups()[group + 1]);
    REQUIRE(prototype.groups()[group + 1] - prototype.groups()[group] <= kMaxCopiedObjects);
  }
}

TEST_CASE("Instances of a mesh without areas are nothing") {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  mesh.triangles.resize(40, {{0, 1, 2}});
  Scene scene = instances(30);
  const SceneImage without(scene);
  scene.objects.insert(scene.objects.begin() + 1, 2, mesh_object(mesh, 0, 0));
  const SceneImage with(scene);
  CHECK(with.header().group_count == without.header().group_count);
  CHECK((contents(with) == contents(without)));
  CHECK((bytes_of(SceneImage::from_bytes(bytes_of(with))) == bytes_of(with)));
}

TEST_CASE("Meshes that are not worth while to share have groups of their own") {
  // Too few triangles in all.
  CHECK(SceneImage(instances(2)).header().prototype_count == 0);
  // Everything in one another.
  Scene scene = instances(30);
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    scene.objects[i].transform = Transform::rotate({1.0 * static_cast<double>(i), 0, 0});
  CHECK(SceneImage(scene).header().prototype_count == 0);
  // Triangles of several materials.
  scene = instances(30);
  for (Object& object : scene.objects)
    if (auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape)) {
      static std::shared_ptr<const Mesh> blended = [] {
        Mesh ball = ball_mesh(12);
        ball.triangles[7].material[1] = 2;
        return std::make_shared<const Mesh>(ball);
      }();
      *mesh = blended;
    }
  CHECK(SceneImage(scene).header().prototype_count == 0);
}

TEST_CASE("Instances that single precision cannot tell from points lose their triangles alone") {
  Scene scene = instances(30);
  const SceneImage before(scene);
  // Flattened to a line, and far away.
  scene.objects[5].transform = Transform();
  scene.objects[5].transform.rows[0] = scene.objects[5].transform.rows[1] = Vec3(0);
  scene.objects[9].transform = Transform::translate({1e9, 0, 0});
  const SceneImage after(scene);
  CHECK((contents(after) == contents(SceneImage(without_instances(scene)))));
  CHECK(after.header().object_count < before.header().object_count);
  CHECK(after.header().prototype_count != 0);
  // And what is too far away for single precision altogether is refused.
  scene.objects[9].transform = Transform::translate({1e30, 0, 0});
  SceneImage image(instances(30));
  const Bytes bytes = bytes_of(image);
  AlignedBlock work;
  CHECK_THROWS_AS(image.assign(scene, work, 2), InputError);
  CHECK((bytes_of(image) == bytes));
}

TEST_CASE("A sealed scene image with a fault in its copies is refused") {
  const Bytes good = bytes_of(SceneImage(instances(30)));
  const auto refused = [&](const std::function<void(ImageHeader&, std::uint32_t*)>& change) {
    Bytes bytes = good;
    ImageHeader& header = header_of(bytes);
    change(header, table<std::uint32_t>(bytes, header.prototype_offset));
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  refused([](ImageHeader& h, std::uint32_t*) { --h.prototype_count; });
  refused([](ImageHeader& h, std::uint32_t*) { h.prototype_offset = 0xFFFFFF80; });
  refused([](ImageHeader& h, std::uint32_t* prototypes) { prototypes[h.group_count - 1] = h.group_count; });
  refused(
      [](ImageHeader& h, std::uint32_t* prototypes) { prototypes[h.group_count - 1] = h.group_count - 2; });
  refused([](ImageHeader& h, std::uint32_t* prototypes) { prototypes[h.group_count - 1] = 0; });
}
