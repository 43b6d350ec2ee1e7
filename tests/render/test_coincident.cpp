// Which of several surfaces at one place is seen: the first object, and what order objects are in.
#include "memory/aligned_block.hpp"
#include "render/scenes.hpp"
#include "scene_image/coincident_surfaces.hpp"
#include "scene_image/csg_parts.hpp"
#include "scene_image/scene_image.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

using namespace celltrace;
using test::csg_object;

namespace {

using Operation = Csg::Operation;

Object ball(Index material, double radius = 1) {
  Object object;
  object.shape = Sphere{{0, 0, 0}, radius};
  object.material = material;
  return object;
}
Object box(double half) {
  Object object;
  object.shape = Box{{Vec3(-half), Vec3(half)}};
  object.material = 9;
  return object;
}

/// The materials of the unit balls among the parts of an object, in order.
std::vector<Index> order_in(Object object) {
  Scene scene;
  scene.objects.push_back(std::move(object));
  std::vector<Index> materials;
  for (const CsgPart& part : CsgParts(scene, Eye(scene.camera)).parts)
    if (part.object.material < 9) materials.push_back(part.object.material);
  return materials;
}

std::vector<std::size_t> order_of(const Scene& scene) {
  const Eye eye(scene.camera);
  PassedLimits limits;
  return order_of_tests(scene, eye, scene.objects.size(), CsgParts(scene, eye), limits);
}

} // namespace

TEST_CASE("Parts of a CSG are in the order in which POV-Ray shows them where they coincide") {
  const Object both = csg_object(Operation::union_, {ball(1), ball(2)});
  const Object three = csg_object(Operation::union_, {both, ball(3)});
  CHECK(order_in(three) == std::vector<Index>{1, 2, 3});
  CHECK(order_in(csg_object(Operation::merge, {ball(1), ball(2)})) == std::vector<Index>{2, 1});
  CHECK(order_in(csg_object(Operation::intersection, {ball(1), ball(2), box(2)})) ==
        std::vector<Index>{2, 1});
  CHECK(order_in(csg_object(Operation::intersection, {box(2), three})) == std::vector<Index>{1, 2, 3});
  CHECK(order_in(csg_object(Operation::difference, {three, ball(9, 0.5)})) == std::vector<Index>{1, 2, 3});
  CHECK(order_in(csg_object(Operation::intersection, {csg_object(Operation::intersection, {three, box(3)}),
                                                      box(2)})) == std::vector<Index>{3, 2, 1});
  CHECK(order_in(csg_object(Operation::union_, {csg_object(Operation::intersection, {both, box(2)}),
                                                ball(3)})) == std::vector<Index>{1, 2, 3});
  Object clipped = three;
  clipped.clipped_by = std::make_shared<const std::vector<Object>>(std::vector<Object>{box(2)});
  CHECK(order_in(clipped) == std::vector<Index>{3, 1, 2});
}

TEST_CASE("Of CSGs that have a surface in common the one comes first whose box rays enter first") {
  Scene scene;
  scene.camera.location = {0.1, 0.2, -9};
  scene.lights.resize(1);
  Object plane;
  plane.shape = Plane{{0, 0, -1}, 0.2};
  plane.transform = Transform::rotate({0, 10, 0});
  const auto cut = [&](double half) { return csg_object(Operation::intersection, {plane, box(half)}); };
  for (const double half : {1.0, 1.1, 1.05, 0.9})
    scene.objects.push_back(cut(half));
  CHECK(order_of(scene) == std::vector<std::size_t>{1, 2, 0, 3});

  SECTION("but of fewer than three objects, with lights, the one that is first in the scene") {
    scene.objects.resize(2);
    CHECK(order_of(scene) == std::vector<std::size_t>{1, 0});
    scene.lights.clear();
    CHECK(order_of(scene) == std::vector<std::size_t>{0, 1});
  }
  SECTION("and others stay where they are: shapes, and CSGs behind them") {
    scene.objects.insert(scene.objects.begin() + 1, ball(0));
    scene.objects.push_back(csg_object(Operation::merge, {ball(1, 2), ball(2, 3)}));
    CHECK(order_of(scene) == std::vector<std::size_t>{1, 2, 3, 0, 4, 5});
  }
  SECTION("which an image keeps: it is not updated to another order") {
    scene.materials.resize(10);
    AlignedBlock work;
    SceneImage image;
    image.assign(scene, work, 1, SceneImage::kObjectsAThread, {true, true});
    CHECK(image.update(scene, work, 1));
    std::swap(scene.objects[0], scene.objects[1]);
    CHECK_FALSE(image.update(scene, work, 1));
  }
  SECTION("unless their parts of it are in different places") {
    for (std::size_t i = 0; i < 4; ++i)
      scene.objects[i].transform = Transform::rotate({0, -10, 0})
                                       .then(Transform::translate({4.0 * static_cast<double>(i), 0, 0}))
                                       .then(Transform::rotate({0, 10, 0}));
    CHECK(order_of(scene) == std::vector<std::size_t>{0, 1, 2, 3});
  }
}

TEST_CASE("A CSG comes before a shape that has the same surface if it does in the scene") {
  Scene scene;
  scene.camera.location = {0, 0, -9};
  scene.objects = {ball(1, 0.5), csg_object(Operation::intersection, {ball(2), box(2)}), ball(3)};
  CHECK(order_of(scene) == std::vector<std::size_t>{0, 1, 2});
  std::swap(scene.objects[1], scene.objects[2]);
  CHECK(order_of(scene) == std::vector<std::size_t>{0, 1, 2});
}

TEST_CASE("Every object has a place in the order, however many share a surface") {
  Scene scene;
  scene.camera.location = {3, 4, -9};
  for (int i = 0; i < 300; ++i) {
    Object one = csg_object(i % 3 == 0 ? Operation::merge : Operation::intersection,
                            {ball(1), box(0.7 + 0.3 * (i * 7 % 10) / 10.0)});
    one.transform = Transform::rotate({0, 90.0 * (i % 4), 0});
    scene.objects.push_back(std::move(one));
  }
  std::vector<std::size_t> order = order_of(scene);
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> all(300);
  std::iota(all.begin(), all.end(), std::size_t{0});
  CHECK(order == all);
}
