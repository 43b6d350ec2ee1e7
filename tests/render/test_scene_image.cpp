// SceneImage: what its tables hold, and that nothing else than its own bytes is taken for one.
#include "celltrace/error.hpp"
#include "kernel/accel/object_bounds.hpp"
#include "kernel/lights/list.hpp"
#include "kernel/textures/list.hpp"
#include "render/scenes.hpp"
#include "scene/mesh_prototype.hpp"
#include "scene/scene_image.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes_of(const SceneImage& image) {
  return image.to_bytes();
}

ImageHeader& header_of(Bytes& bytes) {
  return *reinterpret_cast<ImageHeader*>(bytes.data());
}

/// Makes the checksum right again after a change: FNV-1a over 64-bit words, its own field as 0.
void seal(Bytes& bytes) {
  header_of(bytes).checksum = 0;
  std::uint64_t sum = 0xCBF29CE484222325u;
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word;
    std::memcpy(&word, bytes.data() + at, 8);
    sum = (sum ^ word) * 0x100000001B3u;
  }
  header_of(bytes).checksum = sum;
}

template <class Record> Record* table(Bytes& bytes, std::uint32_t offset) {
  return reinterpret_cast<Record*>(bytes.data() + offset);
}
template <class Record> const Record* table(const SceneImage& image, std::uint32_t offset) {
  return reinterpret_cast<const Record*>(image.base() + offset);
}

} // namespace

TEST_CASE("A scene image survives as bytes") {
  for (const NamedScene& named : scenes()) {
    INFO(named.name);
    const SceneImage image(named.make());
    const Bytes bytes = bytes_of(image);
    CHECK(bytes.size() % 128 == 0);
    CHECK(reinterpret_cast<std::uintptr_t>(image.base()) % 128 == 0);
    const SceneImage again = SceneImage::from_bytes(bytes);
    CHECK(bytes_of(again) == bytes);
    CHECK(reinterpret_cast<std::uintptr_t>(again.base()) % 128 == 0);
  }
}

TEST_CASE("Quadrics that are no ellipsoids have no bounds") {
  Scene scene = ground(false);
  scene.objects.push_back(scene.objects[0]);
  scene.objects[1].shape = Quadric{};
  const ImageHeader ball = SceneImage(scene).header();
  CHECK(ball.object_count == 1);
  CHECK(ball.unbounded_count == 1);
  scene.objects[1].shape = Quadric{{1, -1, 1}, {}, {}, -1};
  const ImageHeader hyperboloid = SceneImage(scene).header();
  CHECK(hyperboloid.object_count == 0);
  CHECK(hyperboloid.unbounded_count == 2);
}

TEST_CASE("The same scene makes the same bytes") {
  CHECK(bytes_of(SceneImage(scene_named("meshes"))) == bytes_of(SceneImage(scene_named("meshes"))));
}

TEST_CASE("Making room for a grid keeps the static part") {
  SceneImage image(scene_named("meshes"));
  const Bytes bytes = bytes_of(image);
  for (std::uint32_t cells : {1u, 1000u, 50u}) {
    image.reserve_accelerator(cells * sizeof(CellRecord), 3 * cells);
    CHECK(bytes_of(image) == bytes);
    CHECK(image.table_offset() == bytes.size());
    CHECK(image.table_offset() % 128 == 0);
    CHECK(image.list_offset() % 128 == 0);
    CHECK(image.list_offset() >= image.table_offset() + cells * sizeof(CellRecord));
  }
  CHECK_THROWS_AS(image.reserve_accelerator(0x100000000, 1), InputError);
}

TEST_CASE("Any flipped bit of a scene image is noticed") {
  const Bytes bytes = bytes_of(SceneImage(scene_named("glass and mirrors")));
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    Bytes damaged = bytes;
    damaged[at] ^= std::byte{static_cast<unsigned char>(1u << at % 8)};
    REQUIRE_THROWS_AS(SceneImage::from_bytes(damaged), InputError);
  }
}

TEST_CASE("A scene image of the wrong length is refused") {
  Bytes bytes = bytes_of(SceneImage(scene_named("meshes")));
  for (std::size_t length : {std::size_t{0}, std::size_t{127}, std::size_t{128}, bytes.size() / 2,
                             bytes.size() - 1, bytes.size() - 128})
    CHECK_THROWS_AS(SceneImage::from_bytes(std::span(bytes).first(length)), InputError);
  bytes.resize(bytes.size() + 128);
  CHECK_THROWS_AS(SceneImage::from_bytes(bytes), InputError);
}

TEST_CASE("A sealed scene image with a fault in it is refused") {
  const Bytes good = bytes_of(SceneImage(scene_named("meshes")));
  const auto refused = [&](const std::function<void(Bytes&)>& change, const std::string& word) {
    Bytes bytes = good;
    change(bytes);
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains(word));
  };
  const auto objects = [](Bytes& b) { return table<ObjectRecord>(b, header_of(b).object_offset); };
  const auto lights = [](Bytes& b) { return table<LightRecord>(b, header_of(b).light_offset); };
  Bytes sealed = good;
  seal(sealed);
  REQUIRE(sealed == good);

  refused([](Bytes& b) { header_of(b).magic ^= 1; }, "not a scene image");
  refused([](Bytes& b) { header_of(b).version = 77; }, "version 77");
  refused([](Bytes& b) { header_of(b).bytes += 128; }, "size");
  refused([](Bytes& b) { header_of(b).object_offset += 64; }, "offset");
  refused([](Bytes& b) { header_of(b).object_offset = 0; }, "offset");
  refused([](Bytes& b) { header_of(b).object_offset = 0xFFFFFF80; }, "offset");
  refused([](Bytes& b) { header_of(b).object_count = 0xFFFFFFFF; }, "offset");
  refused([](Bytes& b) { header_of(b).material_count = 0x10000000; }, "offset");
  refused([](Bytes& b) { header_of(b).light_count = 0x10000000; }, "offset");
  refused([](Bytes& b) { header_of(b).interior_offset = 0x7FFFFF80; }, "offset");
  refused([](Bytes& b) { header_of(b).extra_count = 0; }, "offset");
  refused([](Bytes& b) { header_of(b).blend_count = 0; }, "offset");
  refused([&](Bytes& b) { objects(b)->kind_and_flags = 200; }, "offset");
  refused([&](Bytes& b) { lights(b)->kind_and_flags = Lights::kCount; }, "offset");
  refused([&](Bytes& b) { objects(b)->material += 16; }, "offset");
  refused([&](Bytes& b) { objects(b)->material = 0; }, "offset");
  refused([&](Bytes& b) { objects(b)->interior = kNoOffset; }, "offset");
  refused([&](Bytes& b) { objects(b)->kind_and_flags |= object_flag::blended; }, "offset");
  refused([&](Bytes& b) { objects(b)->kind_and_flags |= object_flag::smooth; }, "offset");
  refused([](Bytes& b) { header_of(b).unbounded_count = 0xFFFFFFFF; }, "offset");
  refused([](Bytes& b) { header_of(b).csg_count = 0x10000000; }, "offset");
  refused([](Bytes& b) { table<BlendRecord>(b, header_of(b).blend_offset)->material[2] = 5; }, "offset");
}

TEST_CASE("A sealed scene image with a fault in its light groups is refused") {
  const Bytes good = bytes_of(SceneImage(scene_named("light groups")));
  const auto refused = [&](const std::function<void(Bytes&)>& change) {
    Bytes bytes = good;
    change(bytes);
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  const auto lights = [](Bytes& b) { return table<LightRecord>(b, header_of(b).light_offset); };
  const ImageHeader header = *reinterpret_cast<const ImageHeader*>(good.data());
  REQUIRE(header.light_set_count == 41);
  REQUIRE(header.light_word_count == 2 * header.light_count); // no light shines on everything
  refused([](Bytes& b) { header_of(b).light_set_count = 0; });
  refused([](Bytes& b) { header_of(b).light_set_count = 40; }); // an object has a later one
  refused([](Bytes& b) { header_of(b).light_set_count = kMaxLightSets + 1; });
  refused([](Bytes& b) { header_of(b).light_word_count = 0x40000000; });
  refused([](Bytes& b) { header_of(b).light_word_count -= 1; });
  refused([](Bytes& b) { header_of(b).light_word_offset += 4; });
  refused([&](Bytes& b) { lights(b)[3].lit_sets += 2; });
  refused([&](Bytes& b) { lights(b)[header.light_count - 1].lit_sets += 4; });
  refused([&](Bytes& b) { lights(b)->lit_sets = header.light_offset; });
}

TEST_CASE("A sealed scene image with a fault in its polygons is refused") {
  const Bytes good = bytes_of(SceneImage(scene_named("polygons")));
  const auto refused = [&](const std::function<void(Bytes&)>& change) {
    Bytes bytes = good;
    change(bytes);
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  const ImageHeader header = *reinterpret_cast<const ImageHeader*>(good.data());
  REQUIRE(header.polygon_edge_count <= 7 + 80); // shared, and none of them level
  REQUIRE(header.polygon_edge_count > 80);
  const auto change_edges = [&](Bytes& b, const std::function<void(PolygonEdges&)>& change) {
    auto* objects = table<ObjectRecord>(b, header.object_offset);
    for (std::uint32_t i = 0; i < header.object_count; ++i) {
      if ((objects[i].kind_and_flags & object_flag::kind_mask) != kPrimitiveKind<PolygonPrimitive>) continue;
      auto* extra = table<ExtraRecord>(b, objects[i].extra);
      PolygonEdges edges = PolygonEdges::of(*extra);
      change(edges);
      return edges.put_in(*extra);
    }
  };
  refused([](Bytes& b) { header_of(b).polygon_edge_count = 0x10000000; });
  refused([](Bytes& b) { header_of(b).polygon_edge_count = 7; });
  refused([&](Bytes& b) { change_edges(b, [](PolygonEdges& edges) { edges.count = 88; }); });
  refused([&](Bytes& b) { change_edges(b, [](PolygonEdges& edges) { edges.first += 8; }); });
  refused([&](Bytes& b) { change_edges(b, [&](PolygonEdges& e) { e.first = header.extra_offset; }); });
}

TEST_CASE("A sealed scene image with a fault in its rainbows is refused") {
  const Bytes good = bytes_of(SceneImage(scene_named("rainbows")));
  const auto refused = [&](const std::function<void(Bytes&)>& change) {
    Bytes bytes = good;
    change(bytes);
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  const auto bows = [](Bytes& b) { return table<RainbowRecord>(b, header_of(b).rainbow_offset); };
  REQUIRE(reinterpret_cast<const ImageHeader*>(good.data())->rainbow_count == 3);
  refused([](Bytes& b) { header_of(b).rainbow_count = 0x10000000; });
  refused([&](Bytes& b) { bows(b)[1].entry_count = 0; });
  refused([&](Bytes& b) { bows(b)[2].entry_count = 5; });
  refused([&](Bytes& b) { bows(b)[0].entries += 16; });
  refused([&](Bytes& b) { bows(b)[0].entries = header_of(b).material_offset; });
}

TEST_CASE("A sealed scene image with a fault in its projectors is refused") {
  const Bytes good = bytes_of(SceneImage(scene_named("projected lights")));
  const auto refused = [&](const std::function<void(Bytes&)>& change) {
    Bytes bytes = good;
    change(bytes);
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  const auto lights = [](Bytes& b) { return table<LightRecord>(b, header_of(b).light_offset); };
  const ImageHeader header = *reinterpret_cast<const ImageHeader*>(good.data());
  REQUIRE(header.projector_count == 7); // a box, a torus, two surfaces of a CSG, two triangles, a plane
  REQUIRE(header.unbounded_count == 0);
  refused([](Bytes& b) { header_of(b).projector_count = 0xFFFFFFFF; });
  refused([](Bytes& b) { header_of(b).projector_count = 6; });
  refused([&](Bytes& b) { lights(b)[1].projector -= 64; });
  refused([&](Bytes& b) { lights(b)[1].projector += 4; });
  refused([&](Bytes& b) { lights(b)[1].projector_count = 8; });
  refused([&](Bytes& b) { ++lights(b)[5].projector_count; });
}

TEST_CASE("Projectors that are not sound are refused") {
  const auto with = [](const Object& projector) {
    Scene scene = scene_named("projected lights");
    scene.lights[3].projected_through = std::make_shared<const Object>(projector);
    return scene;
  };
  Object object;
  object.shape = Sphere{{0, HUGE_VAL, 0}, 1};
  CHECK_THROWS_WITH(SceneImage(with(object)), Catch::Contains("projector 2"));
  object = mesh_object(floor_mesh(0, 1), 0, 0);
  CHECK_NOTHROW(SceneImage(with(object)));
  Object whole;
  whole.shape = std::make_shared<const Csg>(Csg{Csg::Operation::intersection, {object, object}});
  CHECK_THROWS_WITH(SceneImage(with(whole)), Catch::Contains("mesh"));
  whole.shape = std::make_shared<const Csg>(Csg{Csg::Operation::union_, {object, object}});
  CHECK(SceneImage(with(whole)).header().projector_count == 7 + 2);
  Mesh broken = floor_mesh(0, 1);
  broken.triangles[0].vertex[1] = 4;
  CHECK_THROWS_WITH(SceneImage(with(mesh_object(broken, 0, 0))), Catch::Contains("out of range"));
  whole.shape = std::shared_ptr<const Csg>();
  CHECK_THROWS_WITH(SceneImage(with(whole)), Catch::Contains("no CSG"));
}

TEST_CASE("Rainbows that are not sound are refused, and those that are not seen left out") {
  const auto with = [](const std::function<void(Rainbow&)>& change) {
    Scene scene = scene_named("rainbows");
    change(scene.rainbows[1]);
    return scene;
  };
  CHECK_THROWS_WITH(SceneImage(with([](Rainbow& r) { r.up = r.direction * 2.0; })),
                    Catch::Contains("rainbow 1"));
  CHECK_THROWS_WITH(SceneImage(with([](Rainbow& r) { r.angle = HUGE_VAL; })), Catch::Contains("not finite"));
  CHECK_THROWS_WITH(SceneImage(with([](Rainbow& r) { r.colours.clear(); })), Catch::Contains("colours"));
  CHECK_THROWS_WITH(SceneImage(with([](Rainbow& r) { r.colours.resize(257); })), Catch::Contains("colours"));
  CHECK(SceneImage(with([](Rainbow& r) { r.width = 0; })).header().rainbow_count == 2);
  CHECK(SceneImage(with([](Rainbow& r) { r.distance = -1; })).header().rainbow_count == 2);
}

TEST_CASE("Polygons that are not sound are refused") {
  Scene scene = scene_named("polygons");
  scene.objects[1].shape = std::shared_ptr<const Polygon>();
  CHECK_THROWS_WITH(SceneImage(scene), Catch::Contains("object 1 has no polygon"));
  auto polygon = std::make_shared<Polygon>();
  polygon->loops = {{{0, 0, 0}, {1, 0, 0}, {0, HUGE_VAL, 0}}};
  scene.objects[1].shape = std::shared_ptr<const Polygon>(polygon);
  CHECK_THROWS_WITH(SceneImage(scene), Catch::Contains("not finite"));
}

TEST_CASE("Light groups that are not sound are refused") {
  Scene scene = scene_named("light groups");
  scene.light_groups[1].lights.push_back(static_cast<Index>(scene.lights.size()));
  CHECK_THROWS_WITH(SceneImage(scene), Catch::Contains("light group 1"));
  scene = scene_named("light groups");
  scene.objects[3].light_group = 40;
  CHECK_THROWS_WITH(SceneImage(scene), Catch::Contains("object 3, light group"));
  scene = scene_named("light groups");
  scene.light_groups.resize(kMostLightGroups);
  CHECK_NOTHROW(SceneImage(scene));
  scene.light_groups.resize(kMostLightGroups + 1);
  CHECK_THROWS_WITH(SceneImage(scene), Catch::Contains("255 light groups"));
}

TEST_CASE("A sealed scene image with a fault in the inside of a mesh is refused") {
  const Bytes good = bytes_of(SceneImage(scene_named("cut meshes")));
  const auto refused = [&](const std::function<void(Bytes&, const ImageHeader&)>& change) {
    Bytes bytes = good;
    change(bytes, *reinterpret_cast<const ImageHeader*>(good.data()));
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  const auto grids = [](Bytes& b, const ImageHeader& h) {
    return table<MeshGridRecord>(b, h.mesh_grid_offset);
  };
  const auto words = [](Bytes& b, const ImageHeader& h) {
    return table<std::uint32_t>(b, h.mesh_word_offset);
  };
  const ImageHeader header = *reinterpret_cast<const ImageHeader*>(good.data());
  REQUIRE(header.mesh_grid_count == 2); // instances share theirs
  const auto first = [&](Bytes& b) { return *grids(b, header); };
  refused([](Bytes& b, const ImageHeader&) { header_of(b).mesh_triangle_count = 0x10000000; });
  refused([](Bytes& b, const ImageHeader&) { header_of(b).mesh_word_offset += 4; });
  refused([](Bytes& b, const ImageHeader&) { header_of(b).mesh_grid_count = 0; });
  refused([](Bytes& b, const ImageHeader&) { header_of(b).mesh_word_count = 5; });
  refused([&](Bytes& b, const ImageHeader& h) { grids(b, h)->columns = 0; });
  refused([&](Bytes& b, const ImageHeader& h) { grids(b, h)->rows = kMaxMeshGridSide + 1; });
  refused([&](Bytes& b, const ImageHeader& h) { grids(b, h)->starts += 2; });
  refused([&](Bytes& b, const ImageHeader& h) { grids(b, h)->starts = h.mesh_triangle_offset; });
  refused([&](Bytes& b, const ImageHeader& h) { words(b, h)[0] -= 4; });
  refused([&](Bytes& b, const ImageHeader& h) { words(b, h)[1] = h.mesh_triangle_offset + 4; });
  refused([&](Bytes& b, const ImageHeader& h) { ++words(b, h)[1]; });
  refused([&](Bytes& b, const ImageHeader& h) {
    words(b, h)[first(b).columns * first(b).rows + 1] += sizeof(ObjectRecord) / 2;
  });
  refused([](Bytes& b, const ImageHeader& h) {
    auto* solids = table<SolidRecord>(b, h.solid_offset);
    for (std::uint32_t i = 0; i < h.solid_count; ++i)
      if (solids[i].object.kind_and_flags == kMeshSolid) solids[i].object.extra += 8;
  });
}

TEST_CASE("What is wrong with a mesh in CSG is said") {
  Scene scene = scene_named("cut meshes");
  const auto refused = [&](const std::function<void(Mesh&)>& change, const std::string& message) {
    Mesh mesh = floor_mesh(0, 1);
    change(mesh);
    Object clipped = sphere_at({0, 0, 0}, 1, 0, 0);
    clipped.clipped_by = std::make_shared<const std::vector<Object>>(std::vector{mesh_object(mesh, 0, 0)});
    const Object part = mesh_object(mesh, 0, 0);
    for (const Object& object :
         {part, clipped, [&] {
            Object csg;
            csg.shape = std::make_shared<const Csg>(Csg{Csg::Operation::merge, {clipped, part}});
            return csg;
          }()}) {
      scene.objects = {object};
      CHECK_THROWS_WITH(SceneImage(scene), message);
    }
  };
  refused([](Mesh& mesh) { mesh.inside_vector.y = std::numeric_limits<double>::infinity(); },
          "object 0 has an inside vector that is not finite");
  refused([](Mesh& mesh) { mesh.inside_vector.z = std::numeric_limits<double>::quiet_NaN(); },
          "object 0 has an inside vector that is not finite");
  refused([](Mesh& mesh) { mesh.triangles[1].vertex[2] = 4; },
          "object 0, triangle 1 has an index that is out of range");
}

TEST_CASE("Spheres that a transformation leaves round stay spheres") {
  Scene scene;
  scene.add(matte({1, 1, 1}));
  scene.add(Interior{});
  const auto kind_of = [&](const Transform& transform, ObjectRecord* record = nullptr) {
    scene.objects = {sphere_at({1, 2, 3}, -0.5, 0, 0)};
    scene.objects[0].transform = transform;
    const SceneImage image(scene);
    REQUIRE(image.header().object_count == 1);
    const auto* object = table<ObjectRecord>(image, image.header().object_offset);
    if (record != nullptr) *record = *object;
    return static_cast<ObjectKind>(object->kind_and_flags & object_flag::kind_mask);
  };
  ObjectRecord r;
  const Transform turned = Transform::scale({2, 2, 2}).then(Transform::rotate({10, 20, 90}));
  CHECK(kind_of(turned, &r) == ObjectKind::sphere);
  CHECK(r.geometry[3] == Approx(1));
  CHECK(r.geometry[0] == Approx(turned.point({1, 2, 3}).x));
  CHECK((r.kind_and_flags & object_flag::opaque) != 0);
  CHECK(kind_of(Transform::scale({2, -2, 2}), &r) == ObjectKind::sphere);
  CHECK(r.geometry[1] == -4);
  CHECK(kind_of(Transform::scale({2, 2.001, 2})) == ObjectKind::ellipsoid);
  CHECK(kind_of(Transform::matrix({1, 0, 0, 0.1, 1, 0, 0, 0, 1, 0, 0, 0})) == ObjectKind::ellipsoid);
}

TEST_CASE("What cannot be hit is left out") {
  Scene scene;
  scene.add(matte({1, 1, 1}));
  scene.add(Interior{});
  Mesh mesh = floor_mesh(0, 1);
  mesh.triangles.push_back({{1, 1, 2}, {kNoIndex, kNoIndex, kNoIndex}, {kNoIndex, kNoIndex, kNoIndex}});
  mesh.vertices.push_back({0, 0, 0});
  mesh.triangles.push_back(
      {{0, 2, 4}, {kNoIndex, kNoIndex, kNoIndex}, {kNoIndex, kNoIndex, kNoIndex}}); // a line
  scene.objects = {sphere_at({0, 0, 0}, 0, 0, 0), mesh_object(mesh, 0, 0), mesh_object(Mesh{}, 0, 0)};
  CHECK(SceneImage(scene).header().object_count == 2);
}

TEST_CASE("A triangle with some normals only is refused") {
  Scene scene;
  scene.add(matte({1, 1, 1}));
  scene.add(Interior{});
  for (int missing = 0; missing < 3; ++missing) {
    Mesh mesh = floor_mesh(0, 1);
    mesh.normals = {{0, 1, 0}, {0, 1, 0.1f}};
    const Index normals[3] = {0, 1, 1};
    for (int i = 0; i < 3; ++i)
      mesh.triangles[0].normal[i] = i == missing ? kNoIndex : normals[i];
    scene.objects = {mesh_object(mesh, 0, 0)};
    CHECK_THROWS_AS(SceneImage(scene), InputError);
  }
}

TEST_CASE("Faces and materials are flagged for what the kernel may skip") {
  Scene scene;
  Material clear = matte({1, 1, 1});
  clear.pigment.transmit = 0.5;
  scene.materials = {matte({1, 0, 0}), matte({0, 1, 0}), clear};
  scene.add(Interior{});
  Mesh mesh = floor_mesh(0, 1);
  const Index same[3] = {1, 1, 1};
  const Index mixed[3] = {0, kNoIndex, 2};
  std::copy(same, same + 3, mesh.triangles[0].material);
  std::copy(mixed, mixed + 3, mesh.triangles[1].material);
  scene.objects = {mesh_object(mesh, 1, 0)};
  scene.objects[0].no_shadow = true;
  const SceneImage image(scene);
  const ImageHeader& h = image.header();
  const auto* objects = table<ObjectRecord>(image, h.object_offset);
  const auto material = [&](std::uint32_t index) { return h.material_offset + index * 128; };
  CHECK(objects[0].kind_and_flags == (1u | object_flag::opaque | object_flag::no_shadow));
  CHECK(objects[0].material == material(1));
  CHECK(objects[1].kind_and_flags == (1u | object_flag::blended | object_flag::no_shadow));
  const auto* blend = table<BlendRecord>(image, objects[1].material);
  CHECK(blend->material[0] == material(0));
  CHECK(blend->material[1] == material(1));
  CHECK(blend->material[2] == material(2));
}

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

namespace {

/// Finds records of an image by what they say.
struct TextureRecords {
  explicit TextureRecords(Bytes& bytes) : b(bytes), h(header_of(bytes)) {}

  MaterialRecord& material(std::uint32_t flags) {
    auto* all = table<MaterialRecord>(b, h.material_offset);
    auto* found = std::find_if(all, all + h.material_count,
                               [&](const MaterialRecord& r) { return (r.flags & flags) == flags; });
    REQUIRE(found != all + h.material_count);
    return *found;
  }
  PatternRecord& pattern(std::uint32_t offset) { return *table<PatternRecord>(b, offset); }
  PatternRecord& stepped() {
    auto* all = table<PatternRecord>(b, h.pattern_offset);
    auto* found =
        std::find_if(all, all + h.pattern_count, [&](const PatternRecord& r) { return r.step_count != 0; });
    REQUIRE(found != all + h.pattern_count);
    return *found;
  }
  /// Makes a pattern's first entry a map.
  void nest(std::uint32_t pattern_offset, std::uint32_t child) {
    pattern(pattern_offset).kind_and_flags |= pattern_flag::nested;
    entry_of(pattern_offset).child = child;
  }
  NormalRecord& normal(bool is_mapped) {
    auto* all = table<NormalRecord>(b, h.normal_offset);
    auto* found = std::find_if(all, all + h.normal_count,
                               [&](const NormalRecord& r) { return (r.is_mapped != 0) == is_mapped; });
    REQUIRE(found != all + h.normal_count);
    return *found;
  }
  MapEntryRecord& entry_of(std::uint32_t pattern_offset) {
    return *table<MapEntryRecord>(b, pattern(pattern_offset).entries);
  }
  template <class Record> std::uint32_t offset_of(const Record& record) const {
    return static_cast<std::uint32_t>(reinterpret_cast<const std::byte*>(&record) - b.data());
  }

  Bytes& b;
  ImageHeader& h;
};

/// A pigment of a map whose only entry is `inner`.
Pigment around(const Pigment& inner, const Pattern& pattern = {}) {
  Pigment outer;
  outer.map = map_of<Pigment>(pattern, {{0, inner}});
  return outer;
}
Pigment nested_pigment(int maps) {
  Pigment pigment;
  for (int i = 0; i < maps; ++i)
    pigment = around(pigment);
  return pigment;
}
Scene scene_of(const Material& material) {
  Scene scene;
  scene.materials = {material};
  return scene;
}
Scene scene_of(const Pigment& pigment) {
  Material material;
  material.pigment = pigment;
  return scene_of(material);
}

} // namespace

TEST_CASE("A sealed scene image with a fault in its tables of random numbers is refused") {
  const auto bytes_with = [](const pattern::Kind& kind, int generator, const std::vector<SpaceStep>& space) {
    Scene scene;
    Pattern pattern;
    pattern.kind = kind;
    pattern.noise_generator = generator;
    pattern.space = space;
    Material material;
    material.pigment.map = std::make_shared<const PatternMap<Pigment>>(
        PatternMap<Pigment>{pattern, {{0, Pigment{Vec3(0)}}, {1, Pigment{Vec3(1)}}}});
    scene.materials = {material};
    return bytes_of(SceneImage(scene));
  };
  const auto refused = [](const Bytes& good,
                          const std::function<void(ImageHeader&, PatternRecord&)>& change) {
    Bytes bytes = good;
    CHECK_NOTHROW(SceneImage::from_bytes(bytes));
    ImageHeader& header = header_of(bytes);
    change(header, *table<PatternRecord>(bytes, header.pattern_offset));
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  using H = ImageHeader;
  using P = PatternRecord;
  const Bytes crackle = bytes_with(pattern::Crackle{}, 0, {});
  refused(crackle, [](H& h, P&) { h.feature_count = 0; });
  refused(crackle, [](H& h, P&) { --h.feature_count; });
  refused(crackle, [](H& h, P&) { h.feature_offset = 0xFFFFFF80; });
  refused(crackle, [](H&, P& p) { p.table += 16; });
  const Bytes gradients = bytes_with(pattern::Crackle{{-1, 1, 0}, 2, 0, true}, 3, {});
  refused(gradients, [](H& h, P&) { h.gradient_count = 0; });
  refused(gradients, [](H& h, P&) { h.feature_count = 0; });
  refused(gradients, [](H&, P& p) { p.table -= 128; });
  const Bytes waves = bytes_with(pattern::Waves{}, 0, {});
  refused(waves, [](H& h, P&) { h.wave_count = 5; });
  refused(waves, [](H&, P& p) { p.parameter[0] = 1e9f; });
  refused(waves, [](H&, P& p) { p.parameter[0] = 0; });
  refused(waves, [](H&, P& p) { p.table = kNoOffset; });
  refused(bytes_with(pattern::Fractal{}, 0, {}), [](H&, P& p) { p.parameter[2] = 1e9f; });
  const Bytes grey = bytes_with(pattern::Grey{std::make_shared<const Pigment>()}, 0, {});
  // The pigment's own pattern is the first, the one that asks it follows.
  const auto second = [](P& p) -> P& { return *(&p + 1); };
  refused(grey, [&](H&, P& p) { second(p).table += 64; });
  refused(grey, [&](H&, P& p) { second(p).table += sizeof(P); });
  refused(grey, [&](H&, P& p) { second(p).table += 2 * sizeof(P); });
  refused(grey, [&](H&, P& p) { second(p).kind_and_flags &= ~pattern_flag::nested; });
  refused(grey, [](H&, P& p) { p.entry_count = 0; });
  Object ball;
  ball.shape = Sphere{};
  const Bytes inside = bytes_with(pattern::Inside{std::make_shared<const Object>(ball)}, 0, {});
  refused(inside, [](H& h, P&) { h.csg_count = 0; });
  refused(inside, [](H&, P& p) { p.table += 16; });
  warp::BlackHole hole;
  hole.repeat = Vec3(2);
  hole.turbulence = Vec3(1);
  const Bytes holes = bytes_with(pattern::Bozo{}, 0, {hole});
  refused(holes, [](H& h, P&) { h.feature_count = 0; });
}

TEST_CASE("A sealed scene image with a fault in its textures is refused") {
  const Bytes good = bytes_of(SceneImage(scene_named("textures")));
  const auto refused = [&](const std::function<void(TextureRecords&)>& change) {
    Bytes bytes = good;
    TextureRecords records(bytes);
    change(records);
    REQUIRE(bytes != good);
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  using R = TextureRecords;
  SECTION("tables") {
    refused([](R& r) { r.h.pattern_count = 0x10000000; });
    refused([](R& r) { r.h.pattern_offset = 0xFFFFFF80; });
    refused([](R& r) { r.h.space_step_count = 0x10000000; });
    refused([](R& r) { r.h.map_entry_count = 0x10000000; });
    refused([](R& r) { r.h.normal_count = 0x10000000; });
    refused([](R& r) { r.h.pattern_count = 0; });
    refused([](R& r) { r.h.space_step_count = 0; });
    refused([](R& r) { r.h.map_entry_count = 0; });
    refused([](R& r) { r.h.normal_count = 0; });
  }
  SECTION("patterns") {
    refused([](R& r) { r.pattern(r.h.pattern_offset).kind_and_flags |= pattern_flag::kind_mask; });
    refused([](R& r) {
      r.pattern(r.h.pattern_offset).kind_and_flags = pattern_flag::average | Patterns::kCount;
    });
    refused([](R& r) { r.pattern(r.h.pattern_offset).turbulence.octaves = 11; });
    refused([](R& r) { r.pattern(r.material(material_flag::patterned).pattern).entries += 16; });
    refused([](R& r) { r.pattern(r.material(material_flag::patterned).pattern).entries = kNoOffset; });
    refused([](R& r) { r.pattern(r.material(material_flag::patterned).pattern).entry_count = 0xFFFFFFFF; });
    refused([](R& r) { r.pattern(r.material(material_flag::patterned).pattern).entry_count = 0; });
    refused([](R& r) { r.pattern(r.material(material_flag::mapped).pattern).entry_count = 0; });
  }
  SECTION("steps") {
    refused([](R& r) { r.stepped().steps += 64; });
    refused([](R& r) { r.stepped().steps = 0; });
    refused([](R& r) { r.stepped().step_count = 0xFFFFFFFF; });
    refused(
        [](R& r) { table<SpaceStepRecord>(r.b, r.h.space_step_offset)->turbulence.octaves = 0xFFFFFFFF; });
  }
  SECTION("entries, and maps that contain themselves") {
    refused([](R& r) { r.nest(r.material(material_flag::patterned).pattern, 0); });
    refused([](R& r) { r.entry_of(r.material(material_flag::mapped).pattern).child = kNoOffset; });
    refused([](R& r) { r.entry_of(r.normal(true).pattern).child += 32; });
    refused([](R& r) {
      const std::uint32_t pattern = r.material(material_flag::patterned).pattern;
      r.nest(pattern, pattern);
    });
    refused([](R& r) {
      const MaterialRecord& material = r.material(material_flag::mapped);
      r.entry_of(material.pattern).child = r.offset_of(material);
    });
    refused([](R& r) {
      const NormalRecord& normal = r.normal(true);
      r.entry_of(normal.pattern).child = r.offset_of(normal);
    });
  }
  SECTION("normals") {
    refused([](R& r) { r.normal(false).pattern = kNoOffset; });
    refused([](R& r) { r.normal(true).pattern += 64; });
    refused([](R& r) { r.pattern(r.normal(true).pattern).entry_count = 0; });
  }
  SECTION("materials, and layers that go round") {
    refused([](R& r) { r.material(material_flag::patterned).pattern += 64; });
    refused([](R& r) { r.material(material_flag::mapped).pattern = kNoOffset; });
    refused([](R& r) { r.material(material_flag::disturbed).normal = kNoOffset; });
    refused([](R& r) { r.material(material_flag::layered).below += 64; });
    refused([](R& r) { r.material(material_flag::layered).below = kNoOffset; });
    refused([](R& r) {
      MaterialRecord& material = r.material(material_flag::layered);
      material.below = r.offset_of(material);
    });
    refused([](R& r) {
      const std::uint32_t top = r.offset_of(r.material(material_flag::layered));
      MaterialRecord& below = *table<MaterialRecord>(r.b, r.material(material_flag::layered).below);
      below.flags |= material_flag::layered;
      below.below = top;
    });
    refused([](R& r) { // a texture map is no layer
      MaterialRecord& material = r.material(material_flag::mapped);
      material.flags |= material_flag::layered;
      material.below = r.offset_of(material) + std::uint32_t{sizeof(MaterialRecord)};
    });
  }
  SECTION("sky") {
    refused([](R& r) { r.h.sky += 64; });
    refused([](R& r) { r.h.sky = 0; });
    refused([](R& r) { r.h.sky = r.offset_of(r.material(material_flag::mapped)); });
    refused([](R& r) {
      MaterialRecord& top = *table<MaterialRecord>(r.b, r.h.sky);
      table<MaterialRecord>(r.b, top.below)->below = r.h.sky;
    });
    refused([](R& r) {
      MaterialRecord& top = *table<MaterialRecord>(r.b, r.h.sky);
      top.flags &= ~material_flag::layered;
      top.below = r.h.sky;
    });
  }
}

TEST_CASE("A sealed scene image that asks for more of surfaces than is found out is refused") {
  const Bytes good = bytes_of(SceneImage(scene_named("surfaces")));
  CHECK_NOTHROW(SceneImage::from_bytes(good));
  const auto refused = [&](const std::function<void(Bytes&, ImageHeader&)>& change) {
    Bytes bytes = good;
    change(bytes, *table<ImageHeader>(bytes, 0));
    REQUIRE(bytes != good);
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  const auto object_with = [](Bytes& bytes, const ImageHeader& h, std::uint32_t flags) {
    auto* objects = table<ObjectRecord>(bytes, h.object_offset);
    while ((objects->kind_and_flags & flags) != flags)
      ++objects;
    return objects;
  };
  refused([](Bytes&, ImageHeader& h) { h.light_ways &= ~light_way::by_surface; });
  refused([](Bytes&, ImageHeader& h) { h.light_ways &= ~light_way::stepwise; });
  refused([&](Bytes& b, ImageHeader& h) {
    object_with(b, h, object_flag::by_surface)->kind_and_flags &= ~object_flag::by_surface;
  });
  refused([&](Bytes& b, ImageHeader& h) {
    object_with(b, h, object_flag::by_surface | object_flag::blended)->kind_and_flags &=
        ~object_flag::by_surface;
  });
  refused([&](Bytes& b, ImageHeader& h) {
    object_with(b, h, object_flag::by_surface | static_cast<std::uint32_t>(ObjectKind::triangle))->extra += 4;
  });
  refused([&](Bytes& b, ImageHeader& h) { // the sky has no surface
    h.sky = object_with(b, h, object_flag::by_surface)->material;
  });
}

TEST_CASE("Surface coordinates of a mesh are in its image where a material asks for them") {
  Scene scene = scene_named("surfaces");
  const SceneImage image(scene);
  const ImageHeader& h = image.header();
  const auto* objects = table<ObjectRecord>(image, h.object_offset);
  int mapped = 0;
  for (std::uint32_t i = 0; i < h.object_count; ++i) {
    if ((objects[i].kind_and_flags & object_flag::kind_mask) !=
        static_cast<std::uint32_t>(ObjectKind::triangle))
      continue;
    ++mapped;
    REQUIRE((objects[i].kind_and_flags & object_flag::by_surface) != 0);
    REQUIRE(objects[i].extra != kNoOffset);
    const float(&uv)[6] = table<ExtraRecord>(image, objects[i].extra)->bounds;
    CHECK(uv[0] == 0);
    CHECK(uv[1] == 0);
    CHECK(uv[2] == 1);
    CHECK(uv[5] == ((objects[i].kind_and_flags & object_flag::blended) != 0 ? 1 : 2));
  }
  CHECK(mapped == 2);
  for (Material& material : scene.materials)
    material = matte({1, 1, 1});
  const SceneImage plain(scene);
  CHECK((plain.header().light_ways & (light_way::by_surface | light_way::stepwise)) == 0);
  auto mesh = std::make_shared<Mesh>(*std::get<std::shared_ptr<const Mesh>>(scene.objects.back().shape));
  mesh->coordinates.pop_back();
  scene.objects.back().shape = std::shared_ptr<const Mesh>(mesh);
  CHECK_THROWS_WITH(SceneImage(scene), Catch::Contains("surface coordinates"));
  Scene sky;
  Pigment pigment = scene_named("patterns").materials[0].pigment;
  auto map = std::make_shared<PatternMap<Pigment>>(*pigment.map);
  map->pattern.uv_mapping = true;
  pigment.map = map;
  sky.sky_sphere = {pigment};
  CHECK_THROWS_WITH(SceneImage(sky), Catch::Contains("no surface"));
}

TEST_CASE("Pigments say of themselves whether an entry is a map") {
  const SceneImage image(scene_of(nested_pigment(2)));
  Bytes bytes = bytes_of(image);
  TextureRecords records(bytes);
  PatternRecord& outer = records.pattern(records.material(material_flag::patterned).pattern);
  CHECK((outer.kind_and_flags & pattern_flag::nested) != 0);
  CHECK((records.pattern(records.entry_of(records.offset_of(outer)).child).kind_and_flags &
         pattern_flag::nested) == 0);
  outer.kind_and_flags &= ~pattern_flag::nested;
  seal(bytes);
  CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
}

TEST_CASE("Textures that are too deep or too long are refused by name") {
  const auto refused = [](const Scene& scene, const std::string& message) {
    CHECK_THROWS_WITH(validate(scene), message);
    CHECK_THROWS_WITH(SceneImage(scene), message);
  };
  SECTION("maps in maps") {
    CHECK_NOTHROW(SceneImage::from_bytes(bytes_of(SceneImage(scene_of(nested_pigment(kDeepestMap))))));
    refused(scene_of(nested_pigment(kDeepestMap + 1)), "material 0 has maps that nest more than 5 deep");
    Normal normal;
    Material material;
    for (int i = 0; i <= kDeepestMap; ++i) {
      normal.map = map_of<Normal>({}, {{0, normal}});
      material.map = map_of<Material>({}, {{0, material}});
    }
    refused(scene_of(material), "material 0 has maps that nest more than 5 deep");
    Material disturbed;
    disturbed.normal = std::make_shared<const Normal>(normal);
    refused(scene_of(disturbed), "material 0 has maps that nest more than 5 deep");
    Scene scene;
    scene.sky_sphere = {nested_pigment(kDeepestMap + 1)};
    refused(scene, "the sky sphere has maps that nest more than 5 deep");
  }
  SECTION("a map that is known to be sound, deeper inside another one") {
    Scene scene = scene_of(nested_pigment(kDeepestMap));
    const Pigment deep = scene.materials[0].pigment;
    scene.materials[0].pigment.map = map_of<Pigment>({}, {{0, deep.map->entries[0].value}, {1, deep}});
    refused(scene, "material 0 has maps that nest more than 5 deep");
  }
  SECTION("entries") {
    PatternMap<Pigment> map;
    Pigment pigment;
    map.entries.resize(kMostMapEntries, {0.5, Pigment{}});
    pigment.map = std::make_shared<const PatternMap<Pigment>>(map);
    CHECK_NOTHROW(SceneImage(scene_of(pigment)));
    map.entries.push_back({0.5, Pigment{}});
    pigment.map = std::make_shared<const PatternMap<Pigment>>(map);
    refused(scene_of(pigment), "material 0 has a map of more than 256 entries");
    map.entries.clear();
    pigment.map = std::make_shared<const PatternMap<Pigment>>(map);
    refused(scene_of(pigment), "material 0 has a map without entries");
  }
  SECTION("layers") {
    Material material;
    for (int i = 1; i < kMostLayers; ++i)
      material.below = std::make_shared<const Material>(material);
    CHECK_NOTHROW(SceneImage::from_bytes(bytes_of(SceneImage(scene_of(material)))));
    material.below = std::make_shared<const Material>(material);
    refused(scene_of(material), "material 0 has more than 64 layers");
    Scene scene;
    scene.sky_sphere.resize(kMostLayers);
    CHECK_NOTHROW(SceneImage::from_bytes(bytes_of(SceneImage(scene))));
    scene.sky_sphere.emplace_back();
    refused(scene, "the sky sphere has more than 64 layers");
    Material mapped, top;
    mapped.map = map_of<Material>({}, {{0, top}});
    top.below = std::make_shared<const Material>(mapped);
    refused(scene_of(top), "material 0 has a texture map for a layer");
  }
  SECTION("numbers") {
    Pigment pigment = around(Pigment{});
    const auto with = [&](const std::function<void(PatternMap<Pigment>&)>& change) {
      PatternMap<Pigment> map = *pigment.map;
      change(map);
      Pigment changed;
      changed.map = std::make_shared<const PatternMap<Pigment>>(map);
      return scene_of(changed);
    };
    const auto no_number = std::numeric_limits<double>::quiet_NaN();
    refused(with([&](auto& map) { map.entries[0].position = no_number; }),
            "material 0 has a number that is not finite");
    refused(with([&](auto& map) { map.entries[0].value.filter = no_number; }),
            "material 0 has a number that is not finite");
    refused(with([&](auto& map) { map.pattern.phase = no_number; }),
            "material 0 has a number that is not finite");
    refused(with([&](auto& map) { map.is_average = true; }),
            "material 0 has an average whose weights are not greater than 0");
    refused(with([&](auto& map) { map.pattern.turbulence.octaves = 11; }),
            "material 0 has turbulence whose octaves are not 1 to 10");
    refused(with([&](auto& map) { map.pattern.noise_generator = 4; }),
            "material 0 has a noise generator that is not 0 to 3");
  }
}

TEST_CASE("A map that several share is written once, and maps in several spaces end") {
  // Each level has the one below many times: in one space there is one of each.
  const auto pyramid = [](const Pattern& pattern) {
    Pigment pigment;
    for (int level = 0; level < kDeepestMap; ++level) {
      PatternMap<Pigment> map;
      map.pattern = pattern;
      for (int i = 0; i < kMostMapEntries; ++i)
        map.entries.push_back({i / 256.0, pigment});
      pigment.map = std::make_shared<const PatternMap<Pigment>>(map);
    }
    return scene_of(pigment);
  };
  const SceneImage image(pyramid({}));
  CHECK(image.header().pattern_count == std::uint32_t{kDeepestMap});
  CHECK(image.header().map_entry_count == std::uint32_t{kDeepestMap * kMostMapEntries});
  CHECK_NOTHROW(SceneImage::from_bytes(bytes_of(image)));

  Pattern moved;
  moved.space = {Transform::scale({1, 2, 3})};
  CHECK_NOTHROW(validate(pyramid(moved)));
  CHECK_THROWS_WITH(SceneImage(pyramid(moved)),
                    "all textures together have more than 4194304 entries of maps");
  moved.space.clear();
  for (int i = 0; i < 64; ++i)
    moved.space.emplace_back(Turbulence{{0.1, 0.1, 0.1}});
  CHECK_THROWS_WITH(SceneImage(pyramid(moved)),
                    "all textures together have more than 4194304 warps of patterns");
}
