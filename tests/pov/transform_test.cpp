#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "celltrace/error.hpp"
#include "celltrace/scene.hpp"
#include "pov/parsing.hpp"

using namespace celltrace;

namespace {

bool near(const Vec3& a, const Vec3& b) {
  return glm::length(a - b) < 1e-12;
}

Transform parsed(const std::string& modifiers) {
  return test::parse("sphere { 0, 1 " + modifiers + " }").objects.at(0).transform;
}

} // namespace

TEST_CASE("rotations are left-handed, about x, then y, then z") {
  CHECK(near(Transform::rotate({0, 90, 0}).point({1, 0, 0}), {0, 0, -1}));
  CHECK(near(Transform::rotate({90, 0, 0}).point({0, 1, 0}), {0, 0, 1}));
  CHECK(near(Transform::rotate({0, 0, 90}).point({1, 0, 0}), {0, 1, 0}));
  CHECK(near(Transform::rotate({90, 90, 0}).point({0, 1, 0}), {1, 0, 0}));
  CHECK(near(Transform::rotate({0, 0, -450}).point({1, 0, 0}), {0, -1, 0}));
}

TEST_CASE("transformations compose, invert and carry normals") {
  const Transform t =
      Transform::scale({1, 2, 4}).then(Transform::rotate({10, 20, 30})).then(Transform::translate({1, 2, 3}));
  CHECK(near(t.inverse().point(t.point({5, 6, 7})), {5, 6, 7}));
  CHECK(t.then(t.inverse()).determinant() == Approx(1));
  CHECK(t.determinant() == Approx(8));
  const Vec3 tangent = t.direction({1, -1, 0});
  CHECK(glm::dot(tangent, t.normal({1, 1, 0})) == Approx(0).margin(1e-12));
  CHECK(Transform().is_identity());
  CHECK_FALSE(t.is_identity());
  CHECK(near(Transform::scale({0, 2, 0}).point({3, 3, 3}), {3, 6, 3}));
  Transform flat;
  flat.rows[2] = {0, 0, 0};
  CHECK_THROWS_AS(flat.inverse(), InputError);
}

TEST_CASE("the language's transformations") {
  CHECK(near(parsed("translate 1 scale 2").point({0, 0, 0}), {2, 2, 2}));
  CHECK(near(parsed("scale <1, 0, 2>").point({1, 1, 1}), {1, 1, 2}));
  CHECK(near(parsed("matrix <1,0,0, 0,1,0, 0,0,1, 5,6,7>").point({0, 0, 0}), {5, 6, 7}));
  CHECK(near(parsed("transform { rotate 90*y translate x }").point({1, 0, 0}), {1, 0, -1}));
  CHECK(near(parsed("translate x transform { translate 3*x inverse }").point({0, 0, 0}), {-2, 0, 0}));
  const auto named = test::parse("#declare T = transform { translate y } "
                                 "sphere { 0, 1 transform T transform { T } }");
  CHECK(near(named.objects.at(0).transform.point({0, 0, 0}), {0, 2, 0}));
  CHECK(test::error_line("sphere { 0, 1 matrix <1,0,1, 0,1,0, 1,0,1, 0,0,0> }") ==
        "scene.pov:1:1: error: this object's transformation is singular: it has no inverse");
  CHECK(test::error_line("sphere { 0, 1 matrix <1, 2> }") ==
        "scene.pov:1:15: error: a matrix has 12 numbers, not 2");
}

TEST_CASE("validate names the first fault") {
  Scene scene = test::parse("sphere { 0, 1 }");
  CHECK_NOTHROW(validate(scene));
  scene.objects[0].material = 7;
  CHECK_THROWS_WITH(validate(scene), "object 0, material: index 7 is out of range, there are 1");
  scene = test::parse("triangle { 0, x, y }");
  auto mesh = std::make_shared<Mesh>(*std::get<1>(scene.objects.at(0).shape));
  mesh->triangles[0].vertex[1] = 3;
  scene.objects[0].shape = std::shared_ptr<const Mesh>(mesh);
  CHECK_THROWS_WITH(validate(scene), "object 0, triangle 0 has an index that is out of range");
  scene.lights.push_back({{1e308 * 10, 0, 0}, {1, 1, 1}, false});
  CHECK_THROWS_WITH(validate(scene), "light 0 has a number that is not finite");
}
