// What validate() takes and refuses, on both sides of every bound.
#include "celltrace/error.hpp"
#include "celltrace/scene.hpp"
#include "geometry/shape_geometry.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace celltrace;

namespace {

/// A sphere of one material and a light.
Scene small_scene() {
  Scene scene;
  scene.camera = Camera::look_at({0, 0, -5}, {0, 0, 0}, 60);
  scene.lights.push_back({{0, 5, -5}});
  Object ball;
  ball.shape = Sphere{{0, 0, 0}, 1};
  ball.material = scene.add(Material());
  ball.interior = scene.add(Interior());
  scene.objects.push_back(ball);
  return scene;
}

/// A change of a valid scene, and what validate() then says; "" if it still is valid.
struct Row {
  const char* name;
  std::function<void(Scene&)> change;
  const char* error;
};

void check_rows(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    INFO(row.name);
    Scene scene = small_scene();
    REQUIRE_NOTHROW(validate(scene));
    row.change(scene);
    if (*row.error == '\0')
      CHECK_NOTHROW(validate(scene));
    else
      CHECK_THROWS_WITH(validate(scene), Catch::Contains(row.error));
  }
}

/// Gives the material's pigment a map by a pattern.
std::function<void(Scene&)> pattern_of(const std::function<void(Pattern&)>& change) {
  return [change](Scene& scene) {
    PatternMap<Pigment> map;
    change(map.pattern);
    map.entries = {{0, {}}, {1, {}}};
    scene.materials[0].pigment.map = std::make_shared<const PatternMap<Pigment>>(map);
  };
}
template <class Kind> std::function<void(Scene&)> kind_of(const Kind& kind) {
  return pattern_of([kind](Pattern& pattern) { pattern.kind = kind; });
}
template <class Step> std::function<void(Scene&)> step_of(const Step& step) {
  return pattern_of([step](Pattern& pattern) { pattern.space.push_back(step); });
}

warp::Repeat repeat(int axis, double width) {
  warp::Repeat result;
  result.axis = axis;
  result.width = width;
  return result;
}
warp::BlackHole black_hole(double radius) {
  warp::BlackHole result;
  result.radius = radius;
  return result;
}
Turbulence octaves(int count) {
  Turbulence result;
  result.octaves = count;
  return result;
}

/// A union of a union and so on, around a sphere.
Object nested(int depth) {
  Object object;
  object.shape = Sphere{{0, 0, 0}, 1};
  object.material = 0;
  for (int i = 0; i < depth; ++i) {
    Object around;
    around.shape = std::make_shared<const Csg>(Csg{Csg::Operation::union_, {object}});
    around.material = 0;
    object = around;
  }
  return object;
}

/// A triangle of three vertices with a normal each.
Mesh triangle() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals = {{0, 0, -1}, {0, 0, -1}, {0, 0, -1}};
  Mesh::Triangle one;
  for (Index corner = 0; corner < 3; ++corner)
    one.vertex[corner] = one.normal[corner] = corner;
  mesh.triangles = {one};
  return mesh;
}
std::function<void(Scene&)> mesh_of(const std::function<void(Mesh&)>& change) {
  return [change](Scene& scene) {
    Mesh mesh = triangle();
    change(mesh);
    scene.objects[0].shape = std::make_shared<const Mesh>(mesh);
  };
}

} // namespace

TEST_CASE("Patterns are taken up to their bounds") {
  const auto fractal = [](int pattern::Fractal::*member, int value) {
    pattern::Fractal result;
    result.*member = value;
    return kind_of(result);
  };
  const auto crackle = [](double metric) {
    pattern::Crackle result;
    result.metric = metric;
    return kind_of(result);
  };
  const auto facets = [](double metric, double size, double coords) {
    pattern::Facets result;
    result.metric = metric;
    result.size = size;
    result.coords = coords;
    return kind_of(result);
  };
  const auto brick = [](const Vec3& size) {
    pattern::Brick result;
    result.size = size;
    return kind_of(result);
  };
  using pattern::Fractal;
  check_rows({
      {"gradient", kind_of(pattern::Gradient{{0, 1e-9, 0}}), ""},
      {"no gradient", kind_of(pattern::Gradient{{0, 0, 0}}), "gradient has no direction"},
      {"brick", brick({1, -1, 1}), ""},
      {"flat x", brick({0, 1, 1}), "brick has no size"},
      {"flat y", brick({1, 0, 1}), "brick has no size"},
      {"flat z", brick({1, 1, 0}), "brick has no size"},
      {"crackle", crackle(0.001), ""},
      {"crackle 0", crackle(0), "crackle's metric"},
      {"crackle -1", crackle(-1), "crackle's metric"},
      {"facets", facets(0.001, 1, 0), ""},
      {"facets of coords", facets(2, 0, 1), ""},
      {"facets of both", facets(2, 1, 1), "both 'coords' and 'size'"},
      {"facets 0", facets(0, 1, 0), "metric of facets"},
      {"no rounds", fractal(&Fractal::iterations, 0), ""},
      {"most rounds", fractal(&Fractal::iterations, 65535), ""},
      {"less than no rounds", fractal(&Fractal::iterations, -1), "iterations"},
      {"more rounds", fractal(&Fractal::iterations, 65536), "iterations"},
      {"exponent 2", fractal(&Fractal::exponent, 2), ""},
      {"exponent 33", fractal(&Fractal::exponent, 33), ""},
      {"exponent 1", fractal(&Fractal::exponent, 1), "of no kind"},
      {"exponent 34", fractal(&Fractal::exponent, 34), "of no kind"},
      {"magnet 2", fractal(&Fractal::magnet, 2), ""},
      {"magnet 3", fractal(&Fractal::magnet, 3), "of no kind"},
      {"magnet -1", fractal(&Fractal::magnet, -1), "of no kind"},
      {"exterior 0", fractal(&Fractal::exterior, 0), ""},
      {"exterior 8", fractal(&Fractal::exterior, 8), ""},
      {"exterior 9", fractal(&Fractal::exterior, 9), "of no kind"},
      {"exterior -1", fractal(&Fractal::exterior, -1), "of no kind"},
      {"interior 0", fractal(&Fractal::interior, 0), ""},
      {"interior 8", fractal(&Fractal::interior, 8), ""},
      {"interior 9", fractal(&Fractal::interior, 9), "of no kind"},
      {"interior -1", fractal(&Fractal::interior, -1), "of no kind"},
      {"no pigment", kind_of(pattern::Grey{}), "pattern of a pigment has none"},
      {"no object", kind_of(pattern::Inside{}), "pattern of an object has none"},
      {"noise 0", pattern_of([](Pattern& p) { p.noise_generator = 0; }), ""},
      {"noise 3", pattern_of([](Pattern& p) { p.noise_generator = 3; }), ""},
      {"noise 4", pattern_of([](Pattern& p) { p.noise_generator = 4; }), "noise generator"},
      {"noise -1", pattern_of([](Pattern& p) { p.noise_generator = -1; }), "noise generator"},
      {"1 octave", step_of(octaves(1)), ""},
      {"10 octaves", step_of(octaves(10)), ""},
      {"no octave", step_of(octaves(0)), "octaves are not 1 to 10"},
      {"11 octaves", step_of(octaves(11)), "octaves are not 1 to 10"},
      {"repeat x", step_of(repeat(0, 1)), ""},
      {"repeat y", step_of(repeat(1, -1)), ""},
      {"repeat z", step_of(repeat(2, 1)), ""},
      {"repeat nothing", step_of(repeat(-1, 1)), "without axis or width"},
      {"repeat a fourth axis", step_of(repeat(3, 1)), "without axis or width"},
      {"repeat without width", step_of(repeat(2, 0)), "without axis or width"},
      {"hole", step_of(black_hole(0.001)), ""},
      {"hole 0", step_of(black_hole(0)), "radius is not greater than 0"},
      {"hole -1", step_of(black_hole(-1)), "radius is not greater than 0"},
  });
}

TEST_CASE("Slopes need a direction and ranges") {
  const auto slope = [](const std::function<void(pattern::Slope&)>& change) {
    pattern::Slope result;
    result.direction = {0, 1, 0};
    change(result);
    return kind_of(result);
  };
  check_rows({
      {"slope", slope([](auto&) {}), ""},
      {"altitude alone", slope([](auto& s) { std::swap(s.direction, s.altitude); }), ""},
      {"neither", slope([](auto& s) { s.direction = Vec3(0); }), "neither direction nor altitude"},
      {"one angle", slope([](auto& s) { s.least = s.most; }), "range of no width"},
      {"one height", slope([](auto& s) { s.lowest = s.highest; }), "range of no width"},
      {"falling", slope([](auto& s) { std::swap(s.least, s.most); }), ""},
  });
}

TEST_CASE("Normals, lights, fogs and rainbows are taken up to their bounds") {
  const auto normal = [](double accuracy) {
    return [accuracy](Scene& scene) {
      Normal result;
      result.accuracy = accuracy;
      scene.materials[0].normal = std::make_shared<const Normal>(result);
    };
  };
  const auto area = [](int columns, int rows, int adaptive) {
    return [=](Scene& scene) {
      scene.lights[0].area = LightArea{{1, 0, 0}, {0, 1, 0}, columns, rows, adaptive};
    };
  };
  const auto fog = [](int count) {
    return [count](Scene& scene) {
      Fog result;
      result.turbulence.octaves = count;
      scene.fogs.push_back(result);
    };
  };
  const auto rainbow = [](const Vec3& direction, const Vec3& up, std::size_t colours) {
    return [=](Scene& scene) {
      Rainbow bow;
      bow.direction = direction;
      bow.up = up;
      bow.colours.resize(colours);
      scene.rainbows.push_back(bow);
    };
  };
  const auto noise = [](int generator) {
    return [generator](Scene& scene) { scene.noise_generator = generator; };
  };
  const auto angle = [](double Camera::*which, double value) {
    return [=](Scene& scene) { scene.camera.*which = value; };
  };
  const Vec3 x(1, 0, 0), y(0, 1, 0);
  check_rows({
      {"normal", normal(1e-9), ""},
      {"normal 0", normal(0), "accuracy is not greater than 0"},
      {"area", area(1, 1, 0), ""},
      {"largest area", area(256, 256, 0), ""},
      {"no columns", area(0, 1, 0), "1 to 256 columns and rows"},
      {"more columns", area(257, 1, 0), "1 to 256 columns and rows"},
      {"more rows", area(1, 257, 0), "1 to 256 columns and rows"},
      {"no rows", area(1, 0, 0), "1 to 256 columns and rows"},
      {"negative level", area(1, 1, -1), "negative adaptive level"},
      {"fog 1", fog(1), ""},
      {"fog 10", fog(10), ""},
      {"fog 0", fog(0), "octaves are not 1 to 10"},
      {"fog 11", fog(11), "octaves are not 1 to 10"},
      {"rainbow", rainbow(x, y, 1), ""},
      {"rainbow of most colours", rainbow(x, y, 256), ""},
      {"no colours", rainbow(x, y, 0), "1 to 256 colours"},
      {"more colours", rainbow(x, y, 257), "1 to 256 colours"},
      {"up along it", rainbow(x, -x, 1), "no direction, or is up along it"},
      {"nowhere", rainbow(Vec3(0), y, 1), "no direction, or is up along it"},
      {"noise 1", noise(1), ""},
      {"noise 3", noise(3), ""},
      {"noise 0", noise(0), "noise generator that is not 1 to 3"},
      {"noise 4", noise(4), "noise generator that is not 1 to 3"},
      {"angle 0", angle(&Camera::angle, 0), ""},
      {"angle -1", angle(&Camera::angle, -1), "negative angle"},
      {"vertical angle 0", angle(&Camera::vertical_angle, 0), ""},
      {"vertical angle -1", angle(&Camera::vertical_angle, -1), "negative angle"},
  });
}

TEST_CASE("Indices are taken up to the last one") {
  check_rows({
      {"material", [](Scene& s) { s.objects[0].material = 1; },
       "object 0, material: index 1 is out of range"},
      {"no material", [](Scene& s) { s.objects[0].material = kNoIndex; }, "is out of range"},
      {"interior", [](Scene& s) { s.objects[0].interior = 1; },
       "object 0, interior: index 1 is out of range"},
      {"no interior", [](Scene& s) { s.objects[0].interior = kNoIndex; }, ""},
      {"group", [](Scene& s) { s.objects[0].light_group = 0; }, "light group: index 0 is out of range"},
      {"a group's light",
       [](Scene& s) {
         s.light_groups.resize(1);
         s.light_groups[0].lights = {0};
         s.objects[0].light_group = 0;
       },
       ""},
      {"a group's other light",
       [](Scene& s) {
         s.light_groups.resize(1);
         s.light_groups[0].lights = {1};
       },
       "light group 0"},
      {"mesh", mesh_of([](Mesh&) {}), ""},
      {"vertex", mesh_of([](Mesh& m) { m.triangles[0].vertex[2] = 3; }), "triangle 0 has an index"},
      {"normal", mesh_of([](Mesh& m) { m.triangles[0].normal[1] = 3; }), "triangle 0 has an index"},
      {"two normals", mesh_of([](Mesh& m) { m.triangles[0].normal[1] = kNoIndex; }),
       "triangle 0 has an index"},
      {"no normals", mesh_of([](Mesh& m) {
         for (Index& normal : m.triangles[0].normal)
           normal = kNoIndex;
       }),
       ""},
      {"a corner's material", mesh_of([](Mesh& m) { m.triangles[0].material[2] = 0; }), ""},
      {"a corner's other", mesh_of([](Mesh& m) { m.triangles[0].material[2] = 1; }),
       "triangle 0 has an index"},
      {"coordinates", mesh_of([](Mesh& m) { m.coordinates.resize(1); }), ""},
      {"other coordinates", mesh_of([](Mesh& m) { m.coordinates.resize(2); }), "for other triangles"},
  });
  // Triangles without normals are looked at four at a time, and those that are left one by one.
  for (std::size_t wrong = 0; wrong < 10; ++wrong) {
    INFO("triangle " << wrong);
    const auto with = [wrong](const std::function<void(Mesh::Triangle&)>& change) {
      return mesh_of([=](Mesh& mesh) {
        mesh.normals.clear();
        Mesh::Triangle flat = mesh.triangles[0];
        for (Index& normal : flat.normal)
          normal = kNoIndex;
        mesh.triangles.assign(10, flat);
        change(mesh.triangles[wrong]);
      });
    };
    const std::string error = "triangle " + std::to_string(wrong) + " has an index";
    check_rows({
        {"as they are", with([](auto&) {}), ""},
        {"vertex", with([](auto& t) { t.vertex[0] = 3; }), error.c_str()},
        {"no vertex", with([](auto& t) { t.vertex[1] = kNoIndex; }), error.c_str()},
        {"normal", with([](auto& t) { t.normal[2] = 0; }), error.c_str()},
        {"material", with([](auto& t) { t.material[0] = 0; }), ""},
        {"other material", with([](auto& t) { t.material[2] = 1; }), error.c_str()},
    });
  }
}

TEST_CASE("Objects nest as deep as they may") {
  const auto in_scene = [](int depth) { return [depth](Scene& scene) { scene.objects[0] = nested(depth); }; };
  const auto clipped = [](int depth) {
    return [depth](Scene& scene) {
      scene.objects[0].clipped_by = std::make_shared<const std::vector<Object>>(1, nested(depth));
    };
  };
  check_rows({
      {"as deep as may be", in_scene(kDeepestCsg), ""},
      {"deeper", in_scene(kDeepestCsg + 1), "CSG that nests too deeply"},
      {"clipped", clipped(kDeepestCsg - 1), ""},
      {"clipped deeper", clipped(kDeepestCsg), "nests too deeply"},
  });
}
