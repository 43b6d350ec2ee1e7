// Meshes without an inside in CSG: which crossings of a ray are found, which is POV-Ray's rule.
#include "reference/tracer.hpp"
#include "render/backends.hpp"
#include "render/image_bytes.hpp"
#include "render/scenes.hpp"
#include "scene_image/csg_parts.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <functional>
#include <memory>
#include <vector>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

/// A triangle that rays along z in the middle cross at `hit`, and whose box they enter at `enter`.
struct Sheet {
  double enter, hit;
};

std::shared_ptr<Mesh> mesh_of(const std::vector<Sheet>& sheets) {
  auto mesh = std::make_shared<Mesh>();
  for (const Sheet& sheet : sheets) {
    const auto first = static_cast<Index>(mesh->vertices.size());
    const auto enter = static_cast<float>(sheet.enter), hit = static_cast<float>(sheet.hit);
    mesh->vertices.insert(mesh->vertices.end(),
                          {{-10, -10, enter}, {10, -10, enter}, {0, 10, 2 * hit - enter}});
    mesh->triangles.push_back({{first, first + 1, first + 2}});
  }
  return mesh;
}

/// Seen from z = -20 along z.
Scene scene_with(Object object, const Finish& finish = {{1, 1, 1}, {0, 0, 0}, 0}) {
  Scene scene;
  scene.camera.kind = Camera::Kind::orthographic;
  scene.camera.location = {0, 0, -20};
  scene.camera.right = {0.1, 0, 0};
  scene.camera.up = {0, 0.1, 0};
  scene.add(Material{Pigment{{1, 1, 1}}, finish});
  scene.objects.push_back(std::move(object));
  return scene;
}

/// The mesh where it is within 0.1 of a distance.
Object cut_at(const std::shared_ptr<const Mesh>& mesh, double at) {
  Object whole, slice;
  whole.shape = mesh;
  slice.shape = Box{{{-9, -9, at - 0.1}, {9, 9, at + 0.1}}};
  return csg_object(Csg::Operation::intersection, {whole, slice});
}

bool is_seen(const Scene& scene, const TestBackend& backend) {
  const Image image = render(scene, backend.options(4, 4, 1)).image;
  return image.rgba[0] == 255;
}

} // namespace

TEST_CASE("POV-Ray finds the crossings of a mesh in CSG up to a box behind the last one") {
  struct Case {
    std::vector<Sheet> sheets;
    std::vector<bool> found;
  };
  // Checked with POV-Ray 3.7.0.10.
  const Case cases[] = {
      {{{0, 10}, {1, 5}, {2, 8}, {6, 6}}, {true, true, true, true}},
      {{{0, 10}, {1, 5}, {2, 8}, {8.5, 8.5}}, {true, true, true, false}},
      {{{0, 10}, {1, 5}, {2, 4.5}, {6, 6}}, {true, true, true, false}},
      {{{0, 10}, {1, 5}, {2, 8}, {30, 31}}, {true, true, true, false}},
      {{{1, 1}, {3, 3}}, {true, false}},
  };
  for (const TestBackend& backend : backends())
    for (const Case& c : cases)
      for (std::size_t i = 0; i < c.sheets.size(); ++i) {
        INFO(backend.spu() << ", crossing at " << c.sheets[i].hit);
        CHECK(is_seen(scene_with(cut_at(mesh_of(c.sheets), c.sheets[i].hit)), backend) == c.found[i]);
      }
}

TEST_CASE("What clips a mesh by itself comes before its crossings are found") {
  Object object;
  object.shape = mesh_of({{1, 1}, {3, 3}});
  Object slice;
  slice.shape = Box{{{-9, -9, 2.9}, {9, 9, 3.1}}};
  object.clipped_by = std::make_shared<const std::vector<Object>>(std::vector<Object>{slice});
  for (const TestBackend& backend : backends()) {
    CHECK(is_seen(scene_with(object), backend));
    CHECK(!is_seen(scene_with(csg_object(Csg::Operation::intersection, {object, slice})), backend));
  }
}

TEST_CASE("Meshes without an inside share their tree, and those of one triangle need none") {
  const auto mesh = mesh_of({{1, 1}, {3, 3}, {4, 5}, {6, 6}, {7, 9}, {8, 8}});
  Scene scene = scene_with(cut_at(mesh, 3));
  scene.objects.push_back(cut_at(mesh, 6));
  const auto parts = [&] { return CsgParts(scene, Eye(scene.camera)); };
  const std::size_t records = parts().crossed_meshes.records().size();
  CHECK(records > 6);
  scene.objects.push_back(cut_at(mesh, 9));
  CHECK(parts().crossed_meshes.records().size() == records);
  scene.objects = {cut_at(mesh_of({{1, 1}}), 1)};
  CHECK(parts().crossed_meshes.records().empty());
}

TEST_CASE("A shadow ray goes on behind what it has passed") {
  // A floor behind two sheets of glass, of which the second is found only from the first one on.
  Object glass = csg_object(Csg::Operation::intersection, {});
  Object sheets, space, floor;
  sheets.shape = mesh_of({{1, 1}, {3, 3}});
  space.shape = Box{{{-9, -9, -9}, {9, 9, 9}}};
  sheets.material = space.material = 1;
  glass = csg_object(Csg::Operation::intersection, {sheets, space});
  floor.shape = Plane{{0, 0, -1}, -5};
  Scene scene = scene_with(floor, Finish{{0, 0, 0}, {0, 0, 0}, 1});
  scene.camera.location = {0, 0, 4};
  scene.lights.push_back({{0, 0, -10}});
  scene.gamma_mode = GammaMode::none;
  Material clear;
  clear.pigment.transmit = 0.5;
  scene.add(clear);
  for (const TestBackend& backend : backends()) {
    scene.objects = {floor, glass};
    const int both = render(scene, backend.options(4, 4, 1)).image.rgba[0];
    CHECK(both == Approx(64).margin(2));
  }
}

TEST_CASE("A sealed scene image with a fault in the tree of a mesh is refused") {
  const Bytes good = bytes_of(SceneImage(scene_with(cut_at(mesh_of({{1, 1}, {3, 3}, {4, 5}}), 3))));
  CHECK_NOTHROW(SceneImage::from_bytes(good));
  const auto refused = [&](const std::function<void(CrossedMeshRecord*, ImageHeader&)>& change) {
    Bytes bytes = good;
    ImageHeader& h = header_of(bytes);
    REQUIRE(h.crossed_mesh_count == 4);
    change(table<CrossedMeshRecord>(bytes, h.crossed_mesh_offset), h);
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  refused([](CrossedMeshRecord* r, ImageHeader& h) { r[0].next = h.crossed_mesh_offset; });
  refused([](CrossedMeshRecord* r, ImageHeader&) { r[0].next += 64; });
  refused([](CrossedMeshRecord* r, ImageHeader&) { r[1].next += 64; });
  refused([](CrossedMeshRecord* r, ImageHeader&) { r[3].next += 4; });
  refused([](CrossedMeshRecord*, ImageHeader& h) { h.crossed_mesh_count = 0; });
}
