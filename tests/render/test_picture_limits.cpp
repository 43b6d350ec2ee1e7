// Limits up to which pictures show what POV-Ray shows: the statistics name those that a scene passes, and
// none of a scene that just does not.
#include "celltrace/picture_limit.hpp"
#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"
#include "celltrace/transform.hpp"
#include "prepare/deep_cuts.hpp"
#include "render/scenes.hpp"
#include "scene_image/csg_parts.hpp"
#include "scene_image/scene_image.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

using namespace celltrace;
using namespace celltrace::test;

namespace {

using Operation = Csg::Operation;

RenderOptions small_picture() {
  RenderOptions options;
  options.width = 16;
  options.height = 12;
  options.spes = 1;
  return options;
}

PassedLimits limits_of(const Scene& scene) {
  return SceneImage(scene).limits();
}
PassedLimits limits_in_statistics(const Scene& scene) {
  return render(scene, small_picture()).statistics.limits;
}

Object box_at(const Vec3& low, const Vec3& high, Index material) {
  Object object;
  object.shape = Box{{low, high}};
  object.material = material;
  return object;
}

/// Looks straight down at the unit square around the middle of the xz plane.
Scene scene_from_above() {
  Scene scene;
  scene.camera = camera_at({0.001, 10, 0}, {0, 0, 0});
  return scene;
}

/// Returns boxes that are all the same, each of a material of its own.
Scene boxes_in_one_another(int count) {
  Scene scene = scene_from_above();
  for (int i = 0; i < count; ++i)
    scene.objects.push_back(box_at({-1, -1, -1}, {1, 0, 1}, scene.add(matte({0.001 * i, 1, 1}))));
  return scene;
}

/// Side by side along z, with tops in one plane that do not touch each other.
Scene row_of_boxes(int count, bool of_two_materials) {
  Scene scene = scene_from_above();
  const Index materials[] = {scene.add(matte({1, 1, 1})), scene.add(matte({1, 0, 0}))};
  for (int i = 0; i < count; ++i)
    scene.objects.push_back(
        box_at({-9, -1, 2.0 * i}, {9, 0, 2.0 * i + 1}, materials[of_two_materials ? i % 2 : 0]));
  return scene;
}

/// Adds balls beside all else until there are so many objects.
void fill_with_balls(Scene& scene, std::size_t objects) {
  for (std::size_t i = scene.objects.size(); i < objects; ++i)
    scene.objects.push_back(sphere_at({100.0 + static_cast<double>(i), 0, 0}, 0.25, 0, kNoIndex));
}

/// Returns the intersection of a ball and a box, which is like no other.
Object ball_in_box(int number, Index material) {
  return csg_object(Operation::intersection,
                    {sphere_at({0, 0, 0}, 1, material, kNoIndex),
                     box_at(Vec3(-0.7 - 0.0005 * number), Vec3(0.7 + 0.0005 * number), material)});
}

/// A slab of so many bricks with as many holes as `holes` says.
Scene slab(int bricks, int holes) {
  Scene scene;
  scene.camera.location = {0, 5, -20};
  scene.add(matte({1, 1, 1}));
  std::vector<Object> parts, all;
  for (int i = 0; i < bricks; ++i)
    parts.push_back(box_at({i + 0.0, 0, 0}, {i + 1.0, 1, 1}, 0));
  all.push_back(csg_object(Operation::union_, std::move(parts)));
  for (int i = 0; i < holes; ++i)
    all.push_back(box_at({i + 0.25, 0.5, -1}, {i + 0.75, 2, 2}, 0));
  scene.objects = {csg_object(Operation::difference, std::move(all))};
  return scene;
}

} // namespace

TEST_CASE("Scenes with faces in one plane say if they have too many objects") {
  Scene scene = boxes_in_one_another(2);
  fill_with_balls(scene, most_of(PictureLimit::coplanar_objects));
  CHECK(limits_of(scene).empty());
  fill_with_balls(scene, most_of(PictureLimit::coplanar_objects) + 1);
  CHECK(limits_of(scene) == PassedLimits{PictureLimit::coplanar_objects});
  // Faces that look the same may be in any order.
  scene.objects[1].material = scene.objects[0].material;
  CHECK(limits_of(scene).empty());
  scene = row_of_boxes(100, true);
  fill_with_balls(scene, most_of(PictureLimit::coplanar_objects) + 1);
  CHECK(limits_of(scene).empty());
}

TEST_CASE("Faces in one plane say if too many are near each other, overlap, or lie on one another") {
  CHECK(limits_of(row_of_boxes(1400, true)).empty()); // 979,300 pairs
  CHECK(limits_of(row_of_boxes(1500, true)) == PassedLimits{PictureLimit::coplanar_comparisons});
  CHECK(limits_of(row_of_boxes(1500, false)).empty());

  // One may be moved by as many steps as there are.
  CHECK(limits_of(boxes_in_one_another(33)).empty());
  CHECK(limits_in_statistics(boxes_in_one_another(34)) == PassedLimits{PictureLimit::coplanar_layers});
  CHECK(limits_of(boxes_in_one_another(362)) == PassedLimits{PictureLimit::coplanar_layers});
  CHECK(limits_of(boxes_in_one_another(363)) == PassedLimits{PictureLimit::coplanar_pairs}); // 65,703
}

TEST_CASE("CSG says if it has too many faces to find cuts that are too shallow") {
  const auto limits_of_cuts = [](const Scene& scene) {
    PassedLimits limits;
    const Eye eye(scene.camera);
    deepen_cuts(scene, {eye, {}, &limits});
    return limits;
  };
  // Faces are compared as long as no more than 4,194,304 comparisons were before: 2,044 of 342 bricks.
  CHECK(limits_of_cuts(slab(342, 340)).empty());
  CHECK(limits_of_cuts(slab(342, 341)) == PassedLimits{PictureLimit::shallow_cuts});
}

TEST_CASE("Large spheres say if the camera is near too many of them") {
  Scene scene;
  scene.camera = camera_at({0, 0.5, 0}, {0, 0, 9});
  scene.add(matte({1, 1, 1}));
  const auto add = [&](std::size_t count) {
    for (std::size_t i = scene.objects.size(); i < count; ++i)
      scene.objects.push_back(sphere_at({0, -1000.0 - i, 0}, 1000.0 + i, 0, kNoIndex));
  };
  add(most_of(PictureLimit::large_spheres));
  CHECK(limits_of(scene).empty());
  add(most_of(PictureLimit::large_spheres) + 1);
  CHECK(limits_of(scene) == PassedLimits{PictureLimit::large_spheres});
}

TEST_CASE("Surfaces that coincide say if there are too many, or too many objects") {
  Scene pairs;
  pairs.camera.location = {3, 4, -9};
  const auto add = [&](int count) {
    for (int i = static_cast<int>(pairs.objects.size()); i < count; ++i)
      pairs.objects.push_back(ball_in_box(i, pairs.add(matte({0.002 * i, 1, 1}))));
  };
  add(362); // 65,341 pairs
  CHECK(limits_of(pairs).empty());
  add(363); // 65,703
  CHECK(limits_of(pairs) == PassedLimits{PictureLimit::coincident_pairs});

  Scene objects;
  objects.camera.location = {3, 4, -9};
  for (int i = 0; i < 2; ++i)
    objects.objects.push_back(ball_in_box(i, objects.add(matte({1.0 * i, 1, 1}))));
  const std::size_t parts = CsgParts(objects, Eye(objects.camera)).parts.size();
  fill_with_balls(objects, most_of(PictureLimit::coincident_objects) - parts);
  CHECK(limits_of(objects).empty());
  fill_with_balls(objects, most_of(PictureLimit::coincident_objects) - parts + 1);
  CHECK(limits_of(objects) == PassedLimits{PictureLimit::coincident_objects});
  objects.materials[1] = objects.materials[0];
  objects.objects[1] = ball_in_box(1, 0);
  CHECK(limits_of(objects).empty());
}

TEST_CASE("Cameras that are far away among objects say if these are too many") {
  Scene scene;
  scene.camera = orthographic_camera({0, 0, 0}, {0, 0, 1}, 0.01);
  scene.add(matte({1, 1, 1}));
  scene.objects = {sphere_at({0, 0, 20}, 1, 0, kNoIndex), sphere_at({-5, -5, -20}, 1, 0, kNoIndex),
                   sphere_at({-5, 5, -20}, 1, 0, kNoIndex)};
  fill_with_balls(scene, most_of(PictureLimit::far_camera_objects));
  CHECK(limits_in_statistics(scene).empty());
  fill_with_balls(scene, most_of(PictureLimit::far_camera_objects) + 1);
  CHECK(limits_in_statistics(scene) == PassedLimits{PictureLimit::far_camera_objects});
  scene.objects[0].shape = Sphere{{0, 0, 1.5}, 1}; // near
  CHECK(limits_in_statistics(scene).empty());
}

TEST_CASE("Cameras say if they are inside of too many interiors") {
  Scene scene;
  scene.camera = camera_at({0, 0.1, 0}, {0, 0, 9});
  Material material = matte({1, 1, 1});
  material.pigment.transmit = 0.9;
  scene.add(material);
  const auto add = [&](std::size_t count) {
    for (std::size_t i = scene.objects.size(); i < count; ++i)
      scene.objects.push_back(
          sphere_at({0, 0, 0}, 1.0 + static_cast<double>(i), 0, scene.add(Interior{1.02})));
  };
  add(most_of(PictureLimit::camera_interiors));
  CHECK(limits_in_statistics(scene).empty());
  add(most_of(PictureLimit::camera_interiors) + 1);
  CHECK(limits_in_statistics(scene) == PassedLimits{PictureLimit::camera_interiors});
}

TEST_CASE("Later frames say which limits are passed, too") {
  Scene scene = boxes_in_one_another(34);
  Renderer renderer(small_picture());
  renderer.render(scene);
  scene.camera.location.x += 0.001;
  CHECK(renderer.render(scene.camera).statistics.limits == PassedLimits{PictureLimit::coplanar_layers});
  scene.objects.pop_back();
  CHECK(renderer.render(scene).statistics.limits.empty());
}

TEST_CASE("Statistics name limits and say what they mean") {
  RenderStatistics statistics, rows;
  statistics.limits = {PictureLimit::coplanar_pairs};
  rows.limits = {PictureLimit::camera_interiors, PictureLimit::coplanar_pairs};
  add_rows(statistics, rows);
  const nlohmann::json limits = nlohmann::json::parse(to_json(statistics))["limits"];
  REQUIRE(limits.size() == 2);
  CHECK(limits[0]["limit"] == "coplanar_pairs");
  CHECK(limits[0]["most"] == 65536);
  CHECK_THAT(limits[0]["text"].get<std::string>(), Catch::StartsWith("more than 65536 pairs of faces"));
  CHECK(limits[1]["limit"] == "camera_interiors");
}

TEST_CASE("No scene of the project passes a limit") {
  for (const auto& entry : std::filesystem::directory_iterator(CELLTRACE_SOURCE_DIR "/tests/scenes")) {
    if (entry.path().extension() != ".pov") continue;
    INFO(entry.path().filename().string());
    CHECK(limits_in_statistics(parse_file(entry.path())).empty());
  }
}
