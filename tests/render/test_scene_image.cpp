// SceneImage: what its tables hold, and that nothing else than its own bytes is taken for one.
#include "celltrace/error.hpp"
#include "kernel/accel/object_bounds.hpp"
#include "kernel/lights/list.hpp"
#include "records/atmosphere.hpp"
#include "records/material.hpp"
#include "records/mesh.hpp"
#include "render/image_bytes.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

/// Returns the header of bytes, which need not be aligned as a header is.
ImageHeader copied_header(const Bytes& bytes) {
  ImageHeader header;
  std::memcpy(&header, bytes.data(), sizeof header);
  return header;
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
  const ImageHeader header = copied_header(good);
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
  const ImageHeader header = copied_header(good);
  REQUIRE(header.shape_data_count <= 7 + 80); // shared, and none of them level
  REQUIRE(header.shape_data_count > 80);
  const auto change_edges = [&](Bytes& b, const std::function<void(ShapeData&)>& change) {
    auto* objects = table<ObjectRecord>(b, header.object_offset);
    for (std::uint32_t i = 0; i < header.object_count; ++i) {
      if ((objects[i].kind_and_flags & object_flag::kind_mask) != kPrimitiveKind<PolygonPrimitive>) continue;
      auto* extra = table<ExtraRecord>(b, objects[i].extra);
      ShapeData edges = ShapeData::of(*extra);
      change(edges);
      return edges.put_in(*extra);
    }
  };
  refused([](Bytes& b) { header_of(b).shape_data_count = 0x10000000; });
  refused([](Bytes& b) { header_of(b).shape_data_count = 7; });
  refused([&](Bytes& b) { change_edges(b, [](ShapeData& edges) { edges.count = 88; }); });
  refused([&](Bytes& b) { change_edges(b, [](ShapeData& edges) { edges.first += 8; }); });
  refused([&](Bytes& b) { change_edges(b, [&](ShapeData& e) { e.first = header.extra_offset; }); });
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
  const ImageHeader header = copied_header(good);
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
  CHECK_THROWS_WITH(SceneImage(scene), Catch::Contains("object 1 has no shape"));
  auto polygon = std::make_shared<Polygon>();
  polygon->loops = {{{0, 0, 0}, {1, 0, 0}, {0, HUGE_VAL, 0}}};
  scene.objects[1].shape = std::shared_ptr<const Polygon>(polygon);
  CHECK_THROWS_WITH(SceneImage(scene), Catch::Contains("not finite"));
}

TEST_CASE("Plain polygons are triangles") {
  using Points = std::vector<Vec3>;
  const Points square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto triangles = [](const std::vector<Points>& loops, const std::function<void(Material&)>& change) {
    Scene scene = ground(false);
    change(scene.materials[scene.objects[0].material]);
    scene.objects.push_back(scene.objects[0]);
    scene.objects[1].shape = std::make_shared<const Polygon>(Polygon{loops});
    scene.objects[1].transform = Transform::translate({0, 2, 0});
    const ImageHeader image = SceneImage(scene).header();
    return image.shape_data_count == 0 ? image.object_count : 0;
  };
  const auto as_it_is = [](Material&) {};
  CHECK(triangles({{square[0], square[1], square[2]}}, as_it_is) == 1);
  CHECK(triangles({square}, as_it_is) == 2);
  CHECK(triangles({{square.rbegin(), square.rend()}}, as_it_is) == 2);
  Points ring;
  for (int i = 0; i < 9; ++i)
    ring.push_back({std::cos(i * 0.698), std::sin(i * 0.698), 5});
  CHECK(triangles({{ring.begin(), ring.end() - 1}}, as_it_is) == 6);

  CHECK(triangles({ring}, as_it_is) == 0);
  CHECK(triangles({{ring[0], ring[4], ring[8], ring[3], ring[7], ring[2], ring[6]}}, as_it_is) ==
        0); // a star
  CHECK(triangles({{square[0], square[1], square[2], {0.9, 0.1, 0}}}, as_it_is) == 0);
  CHECK(triangles({{square[0], square[1], square[2], {0, 1, 0.01}}}, as_it_is) == 0);
  CHECK(triangles({square, {{0.2, 0.2, 0}, {0.2, 0.4, 0}, {0.4, 0.2, 0}}}, as_it_is) == 0);
  CHECK(triangles({square}, [](Material& material) { material.pigment.transmit = 0.5; }) == 0);
  CHECK(triangles({square}, [](Material& material) {
          material.inside = std::make_shared<const Material>(material);
        }) == 0);
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

TEST_CASE("A sealed scene image with a solid of no kind is refused") {
  const Bytes good = bytes_of(SceneImage(scene_named("cut meshes")));
  const auto with_kind = [&](std::uint32_t kind) {
    Bytes bytes = good;
    const ImageHeader& h = header_of(bytes);
    REQUIRE(h.solid_count > 0);
    ObjectRecord& object = table<SolidRecord>(bytes, h.solid_offset)->object;
    object.kind_and_flags = kind;
    object.extra = kNoOffset;
    seal(bytes);
    return bytes;
  };
  CHECK_NOTHROW(SceneImage::from_bytes(with_kind(kernel::kEmptySolid)));
  for (const std::uint32_t kind : {kernel::kPrimitives, kernel::kMeshSolid - 1, kernel::kMeshSolid | 0x100u})
    CHECK_THROWS_WITH(SceneImage::from_bytes(with_kind(kind)), Catch::Contains("offset"));
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
  const ImageHeader header = copied_header(good);
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
  // Of a set of measured points one wants to know which.
  refused([](Mesh& mesh) { mesh.vertices[3].y = std::numeric_limits<float>::quiet_NaN(); },
          "object 0, vertex 3 has a number that is not finite");
  refused(
      [](Mesh& mesh) {
        mesh.normals = {{0, 1, 0}, {0, std::numeric_limits<float>::infinity(), 0}};
      },
      "object 0, normal 1 has a number that is not finite");
  refused(
      [](Mesh& mesh) {
        mesh.coordinates.resize(mesh.triangles.size());
        mesh.coordinates[1].corner[2].y = std::numeric_limits<float>::quiet_NaN();
      },
      "object 0, triangle 1 has surface coordinates that are not finite");
}

TEST_CASE("Every index of every triangle is looked at") {
  constexpr Index kHigh = 0x80000000;
  Scene scene;
  scene.add(Material());
  scene.add(Material());
  for (std::size_t count = 1; count <= 9; ++count) {
    Mesh sound;
    sound.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    sound.triangles.assign(count, {{0, 3, 1}, {kNoIndex, kNoIndex, kNoIndex}, {1, 0, kNoIndex}});
    const auto check = [&](const Mesh& mesh, bool is_sound) {
      scene.objects = {mesh_object(mesh, 0, kNoIndex)};
      if (is_sound)
        REQUIRE_NOTHROW(validate(scene));
      else
        REQUIRE_THROWS_AS(validate(scene), InputError);
    };
    check(sound, true);
    for (std::size_t i = 0; i < count; ++i)
      for (int corner = 0; corner < 3; ++corner) {
        const auto refused = [&](Index(Mesh::Triangle::*which)[3], std::initializer_list<Index> values) {
          for (const Index value : values) {
            Mesh mesh = sound;
            (mesh.triangles[i].*which)[corner] = value;
            check(mesh, false);
          }
        };
        refused(&Mesh::Triangle::vertex, {4, kHigh - 1, kHigh, kHigh + 1, kNoIndex - 1, kNoIndex});
        refused(&Mesh::Triangle::normal, {0, 1, kHigh - 1, kHigh, kNoIndex - 1});
        refused(&Mesh::Triangle::material, {2, 3, kHigh - 1, kHigh, kNoIndex - 1});
      }
  }
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
  CHECK((objects[1].material & material_word::flags_mask) == material_word::spawns);
  const auto* blend = table<BlendRecord>(image, material_word::offset(objects[1].material));
  CHECK(blend->material[0] == material(0));
  CHECK(blend->material[1] == material(1));
  CHECK(blend->material[2] == material(2));
}
