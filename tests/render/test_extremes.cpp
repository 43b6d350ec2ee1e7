// Scenes at the limits: of size, of distance, of transparency.
#include "celltrace/error.hpp"
#include "celltrace/image.hpp"
#include "prepare/coplanar_faces.hpp"
#include "records/light_feature.hpp"
#include "reference/tracer.hpp"
#include "render/backends.hpp"
#include "render/scenes.hpp"
#include "scene_image/scene_image.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

using namespace celltrace;
using namespace celltrace::test;

namespace {

Comparison against_reference(const Scene& scene) {
  const Image expected = reference::Tracer(scene).render(80, 60);
  return compare_images(expected, render(scene, backends().front().options(80, 60, 2)).image);
}

/// White and green ones.
Pigment squares() {
  Pigment checker;
  checker.map = std::make_shared<const PatternMap<Pigment>>(
      PatternMap<Pigment>{{pattern::Checker{}}, {{0, Pigment{{1, 1, 1}}}, {1, Pigment{{0, 0.5, 0}}}}});
  return checker;
}

Scene moved(const std::string& name, const Transform& by) {
  Scene scene = scene_named(name);
  for (Object& object : scene.objects)
    object.transform = object.transform.then(by);
  scene.camera.location = by.point(scene.camera.location);
  scene.camera.direction = by.direction(scene.camera.direction);
  scene.camera.right = by.direction(scene.camera.right);
  scene.camera.up = by.direction(scene.camera.up);
  for (Light& light : scene.lights)
    light.location = by.point(light.location);
  return scene;
}

} // namespace

TEST_CASE("Scenes far from the origin, large and small") {
  for (const char* name : {"glass and mirrors", "ellipsoids", "meshes"}) {
    for (const Transform& by : {Transform::translate({1000, -500, 700}), Transform::scale({1000, 1000, 1000}),
                                Transform::scale({0.05, 0.05, 0.05}), Transform::rotate({30, 40, 50})}) {
      const Comparison c = against_reference(moved(name, by));
      INFO(name << ", moved by " << by.rows[3].x << ", scaled by " << by.rows[0].x << ": " << to_text(c));
      CHECK(c.psnr >= 45);
    }
  }
}

TEST_CASE("A small scene in a large one") {
  Scene scene = scene_named("glass and mirrors");
  const Index sky = scene.add(matte({0.4, 0.6, 0.9}));
  scene.materials[sky].finish.ambient = Vec3(1);
  scene.materials[sky].finish.diffuse = 0;
  scene.objects.push_back(sphere_at({0, 0, 0}, 1e5, sky, scene.add(Interior{})));
  scene.objects.back().no_shadow = true;
  const Index ground = scene.add(matte({0.4, 0.8, 0.3}));
  scene.objects.push_back(sphere_at({0, -1001.5, 0}, 1000, ground, scene.add(Interior{})));
  const Comparison c = against_reference(scene);
  INFO(to_text(c));
  CHECK(c.psnr >= 45);
}

TEST_CASE("A planet with the camera on its ground") {
  Scene scene;
  scene.background = {0.4, 0.6, 0.9};
  scene.lights.push_back(Light{{5, 10, -8}});
  Material ground = matte({0.9, 0.8, 0.6});
  Pattern stripes{pattern::Gradient{{1, 0, 1}}};
  stripes.wave = Pattern::Wave::sine;
  stripes.frequency = 30;
  ground.pigment.map = std::make_shared<const PatternMap<Pigment>>(
      PatternMap<Pigment>{stripes, {{0, Pigment{{0.9, 0.8, 0.6}}}, {1, Pigment{{0.1, 0.4, 0.2}}}}});
  ground.finish.reflection_max = ground.finish.reflection_min = Vec3(0.4);
  const Index grounds = scene.add(ground), balls = scene.add(matte({1, 0.2, 0.2})),
              interior = scene.add(Interior{});
  scene.camera = camera_at({0, 1, -4}, {0, 0.8, 0});
  scene.objects = {sphere_at({0, -6371, 0}, 6371, grounds, interior),
                   sphere_at({0, 0.7, 0}, 0.7, balls, interior)};
  Object stretched = sphere_at({0, 0, 0}, 1, balls, interior);
  stretched.transform = Transform::scale({9000, 3000, 6000}).then(Transform::translate({2, 3000.2, -2}));
  Object inside = stretched; // a part of a CSG
  Csg csg;
  csg.operation = Csg::Operation::difference;
  csg.parts = {sphere_at({-3, 0, 0}, 1, balls, interior), inside};
  Object cut;
  cut.shape = std::make_shared<const Csg>(csg);
  scene.objects.push_back(cut);
  const Comparison c = against_reference(scene);
  INFO(to_text(c));
  CHECK(c.psnr >= 45);
}

TEST_CASE("Rows of a picture that end at the edge of a floor's squares") {
  // Row 40 sees the floor at z = 1595: so far away, its rays are nearly along it.
  Scene scene;
  Material floor = matte({1, 1, 1});
  floor.pigment = squares();
  floor.finish.ambient = Vec3(1);
  floor.finish.diffuse = 0;
  Object plane;
  plane.shape = Plane{{0, 1, 0}, 0};
  plane.material = scene.add(floor);
  plane.interior = scene.add(Interior{});
  scene.objects.push_back(plane);
  scene.camera.location = {0, 3, -4};
  scene.camera.direction = Vec3(0, -1, 3) / std::sqrt(10.0);
  scene.camera.right = {4.0 / 3, 0, 0};
  scene.camera.up = Vec3(0, 3, 1) / std::sqrt(10.0);
  const Image image = render(scene, backends().front().options(320, 240, 2)).image;
  int wrong = 0;
  for (int x = 0; x < 320; ++x) {
    const double at = 480 * std::sqrt(10.0) * scene.camera.right.x * ((x + 0.5) / 320 - 0.5);
    const bool is_white = (static_cast<int>(std::floor(at)) + 1595) % 2 == 0;
    wrong += (image.pixel(x, 40)[0] != 0) != is_white;
  }
  CHECK(wrong <= 4);
}

TEST_CASE("A camera in a medium, before an opaque mirror that asks for it") {
  const auto in_medium = [](double ior) {
    Scene scene;
    Material mirror = matte({0.1, 0.1, 0.1});
    mirror.finish.reflection_max = Vec3(1);
    mirror.finish.reflection_fresnel = true;
    scene.objects.push_back(sphere_at({0, 0, 0}, 1, scene.add(mirror), scene.add(Interior{1.3})));
    const Index sky = scene.add(matte({0.4, 0.6, 0.9}));
    scene.materials[sky].finish.ambient = Vec3(1);
    scene.objects.push_back(sphere_at({0, 0, 0}, 50, sky, scene.add(Interior{ior})));
    scene.lights.push_back(Light{{5, 5, -5}});
    scene.camera.location = {0, 0, -3};
    return scene;
  };
  const Comparison c = against_reference(in_medium(1.6));
  INFO(to_text(c));
  CHECK(c.psnr >= 45);
  const auto picture = [&](double ior) {
    return render(in_medium(ior), backends().front().options(80, 60, 2)).image;
  };
  CHECK(compare_images(picture(1.6), picture(1.0)).psnr < 30);
}

TEST_CASE("Lights with an area behind many objects") {
  // More than are gathered: those are remembered that occlude one place, and tested for the next one.
  Scene scene;
  scene.camera = camera_at({0, 4, -9}, {0, 1, 0});
  Light light{{2, 12, -3}};
  light.area = LightArea{{2, 0, 0}, {0, 0, 2}, 5, 5, 1};
  scene.lights.push_back(light);
  const Index interior = scene.add(Interior{}), solid = scene.add(matte({0.8, 0.5, 0.3}));
  Material glass = matte({0.3, 0.9, 0.4});
  glass.pigment.filter = 0.7;
  const Index filters = scene.add(glass);
  Object floor;
  floor.shape = Plane{{0, 1, 0}, 0};
  floor.material = scene.add(matte({1, 1, 1}));
  floor.interior = interior;
  scene.objects.push_back(floor);
  for (int i = 0; i < 150; ++i) {
    const Vec3 at(0.7 * (i % 10) - 3, 0.5 + 1.1 * (i / 50), 0.8 * (i / 10 % 5) - 2);
    Object object = sphere_at(at, 0.3, i % 7 == 0 ? filters : solid, interior);
    if (i % 3 == 0) object.shape = Box{{at - Vec3(0.25), at + Vec3(0.25, 0.2, 0.3)}};
    scene.objects.push_back(object);
  }
  const Comparison c = against_reference(scene);
  INFO(to_text(c));
  CHECK(c.psnr >= 45);
  const Image first = render(scene, backends().front().options(80, 60, 2)).image;
  for (const TestBackend& backend : backends())
    CHECK(compare_images(first, render(scene, backend.options(80, 60, 1)).image).differing_pixels == 0);
}

TEST_CASE("A distant camera with a long lens") {
  Scene scene = scene_named("highlights");
  scene.camera.location = {0, 1500, -7000};
  scene.camera = camera_at(scene.camera.location, {0.5, 0, 0});
  scene.camera.direction *= 1000;
  const Comparison c = against_reference(scene);
  INFO(to_text(c));
  CHECK(c.psnr >= 45);
}

TEST_CASE("Blended transparent faces in a row lose no ray") {
  Scene scene;
  scene.camera = camera_at({0, 0, -4}, {0, 0, 0});
  scene.background = {0.9, 0.8, 0.7};
  scene.max_trace_level = 6;
  for (int i = 0; i < 3; ++i) {
    Material m = matte({0.9 - 0.2 * i, 0.5, 0.5 + 0.2 * i});
    m.pigment.transmit = 0.7 + 0.1 * i;
    m.finish.reflection_min = m.finish.reflection_max = Vec3(0.1);
    scene.add(m);
  }
  Mesh mesh;
  mesh.vertices = {{-9, -9, 0}, {9, -9, 0}, {0, 12, 0}};
  mesh.triangles = {{{0, 1, 2}, {kNoIndex, kNoIndex, kNoIndex}, {0, 1, 2}}};
  for (int layer = 0; layer < 3; ++layer) {
    scene.objects.push_back(mesh_object(mesh, 0, scene.add(Interior{})));
    scene.objects.back().transform = Transform::translate({0, 0, 0.3 * layer});
  }
  const RenderResult result = render(scene, backends().front().options(20, 15, 2));
  CHECK(result.statistics.dropped_rays == 0);
  CHECK(compare_images(reference::Tracer(scene).render(20, 15), result.image).psnr >= 45);
}

TEST_CASE("Averages of many mirrors have room for their rays") {
  PatternMap<Material> mirrors;
  mirrors.is_average = true;
  for (int i = 0; i < 80; ++i) {
    Material mirror = matte({0.5, 0.5, 0.5});
    mirror.finish.reflection_max = mirror.finish.reflection_min = Vec3(0.1);
    mirror.finish.reflection_exponent = i % 2 == 0 ? 1 : 0.9;
    Normal bumps{Pattern{pattern::Bumps{}}, 0.03};
    bumps.pattern.space = {Transform::translate({17.3 * i, 0, 0})};
    mirror.normal = std::make_shared<const Normal>(bumps);
    mirrors.entries.push_back({1, mirror});
  }
  Material average;
  average.map = std::make_shared<const PatternMap<Material>>(mirrors);
  Scene scene;
  scene.camera = camera_at({0, 6, -11}, {0, 0.5, 0});
  scene.background = {0.5, 0.6, 0.9};
  scene.lights = {{{10, 10, -10}}};
  scene.max_trace_level = 3;
  scene.adc_bailout = 0.002;
  Object floor;
  floor.shape = Plane{{0, 1, 0}, -1};
  floor.material = scene.add(average);
  floor.interior = scene.add(Interior{});
  scene.objects = {floor, sphere_at({0, 0.5, 0}, 1, floor.material, floor.interior)};
  CHECK(SceneImage(scene).header().surface_nodes == 120);
  for (const bool area : {false, true}) {
    if (area) scene.lights[0].area = LightArea{{1, 0, 0}, {0, 1, 0}, 2, 2, 0};
    const RenderResult result = render(scene, backends().front().options(12, 9, 1));
    CHECK(result.statistics.dropped_rays == 0);
    CHECK(result.statistics.reflection_rays > 4000);
  }
}

TEST_CASE("Sixteen spheres in each other, more than a ray remembers") {
  Scene scene;
  scene.camera = camera_at({0, 0.1, -30}, {0, 0, 0});
  scene.background = {0.5, 0.6, 0.9};
  scene.max_trace_level = 40;
  Material m = matte({0.9, 0.9, 1});
  m.pigment.transmit = 0.97;
  const Index material = scene.add(m);
  for (int i = 0; i < 7; ++i)
    scene.objects.push_back(sphere_at({0, 0, 0}, 16 - i, material, scene.add(Interior{1.02})));
  const RenderResult seven = render(scene, backends().front().options(40, 30, 2));
  CHECK(seven.statistics.dropped_rays == 0);
  CHECK(compare_images(reference::Tracer(scene).render(40, 30), seven.image).psnr >= 45);
  for (int i = 7; i < 15; ++i)
    scene.objects.push_back(sphere_at({0, 0, 0}, 16 - i, material, scene.add(Interior{1.02})));
  const RenderResult fifteen = render(scene, backends().front().options(40, 30, 2));
  CHECK(fifteen.complete);
  CHECK(fifteen.statistics.dropped_rays > 0); // and says so
}

TEST_CASE("Numbers beyond single precision are refused") {
  const auto refused = [](auto change) {
    Scene scene = scene_named("highlights");
    change(scene);
    CHECK_THROWS_AS(render(scene, backends().front().options(16, 12, 1)), InputError);
  };
  refused([](Scene& s) { s.objects[1].shape = Sphere{{0, 0, 0}, 1e300}; });
  refused([](Scene& s) { s.objects[1].shape = Sphere{{0, 1e39, 0}, 1}; });
  refused([](Scene& s) { s.objects[0].transform = Transform::scale({1e39, 1, 1}); });
}

namespace {

/// Shapes of one white material, seen with a mirror's finish so that normals show, before a wall.
Scene white_shapes(std::initializer_list<Object> objects) {
  Scene scene;
  scene.camera = camera_at({2.5, 3, -5.5}, {0, 0, 0});
  scene.background = {0.5, 0.6, 0.7};
  scene.lights = {{{-3, 9, -8}, {1, 1, 1}}};
  Material white = matte({1, 1, 1});
  white.finish.reflection_min = white.finish.reflection_max = Vec3(0.3);
  const Index material = scene.add(white), interior = scene.add(Interior{});
  for (Object object : objects) {
    object.material = material;
    object.interior = interior;
    scene.objects.push_back(object);
  }
  return scene;
}

Object shaped(decltype(Object::shape) shape, const Transform& transform = {}) {
  Object object;
  object.shape = std::move(shape);
  object.transform = transform;
  return object;
}

} // namespace

TEST_CASE("Thin boxes and cylinders have the normals of their faces up to the rim") {
  const Transform turned = Transform::rotate({20, 30, 10});
  for (const double thickness : {0.0, 1e-6, 1e-5, 1e-4, 1e-3}) {
    const Scene scene = white_shapes({
        shaped(Box{{{-2, -1, 0}, {0.2, 1.2, thickness}}}, turned),
        shaped(Box{{{-1, -1.5, -1}, {2, thickness - 1.5, 1}}}),
        shaped(Box{{{-1, -1, -1}, {1, 1, 1}}},
               Transform::scale({0.7, 0.5 * thickness + 1e-7, 0.7}).then(Transform::translate({1.2, 1, 0}))),
        shaped(Cylinder{{1.2, 0.2, 0}, {1.2, 0.2 + std::max(thickness, 1e-6), 0}, 0.8, false}),
    });
    const Comparison c = against_reference(scene);
    INFO(thickness << ": " << to_text(c));
    CHECK(c.psnr >= 50);
  }
}

TEST_CASE("Rays in the plane of a face are inside of it, and hit another one") {
  // Pixels are 32/240 in size: the middles of rows 97 and 142 are at y = 3 and -3.
  for (const Object& object :
       {shaped(Box{{{-3, -3, -3}, {3, 3, 3}}}), shaped(Cylinder{{0, -3, 0}, {0, 3, 0}, 3, false}),
        shaped(Box{{{-3, -1, -1}, {3, 1, 1}}},
               Transform::scale({1, 3, 3}).then(Transform::rotate({90, 0, 0})))}) {
    Scene scene = white_shapes({object});
    scene.background = {0, 0, 0};
    scene.lights = {{{0, 0, -1000}, {1, 1, 1}}};
    scene.camera = orthographic_camera({0, 0, -100}, {0, 0, 0}, 32 * 4.0 / 3);
    const Image image = render(scene, backends().front().options(320, 240, 2)).image;
    for (int y = 90; y < 150; ++y) {
      INFO("row " << y);
      CHECK((image.pixel(160, y)[0] > 0.5f) == (y >= 97 && y <= 142));
    }
  }
}

TEST_CASE("Squares are whole on distant faces that lie where the squares end") {
  Scene scene = white_shapes({
      shaped(Box{{{-2, -2, 0}, {-1, 0, 1}}}),
      shaped(Box{{{-3, -1e-5, 1.5}, {-1.5, 1e-5, 2.5}}}),
      shaped(Cylinder{{0.5, -2, 0}, {0.5, 0, 0}, 1, false}),
      shaped(Cone{{2, 0, 1}, {2, -1, 1}, 0.7, 0.2, false}),
      shaped(Disc{{-0.5, 1, 0}, {0, 1, 0}, 0.5, 0.1}, Transform::translate({0, 0, 1.5})),
      shaped(std::make_shared<const Polygon>(
          Polygon{{{{1, 1, 2}, {2, 1, 2}, {2, 2, 2}, {1, 2, 2}, {1, 1, 2}}}})),
  });
  for (Material& material : scene.materials)
    material.pigment = squares();
  scene.camera.location = {300, 700, -1500};
  scene.camera = camera_at(scene.camera.location, {0, 0, 0});
  scene.camera.direction *= 400;
  const Comparison c = against_reference(scene);
  INFO(to_text(c));
  CHECK(c.psnr >= 45);
}

TEST_CASE("Boxes that are much longer than they are thick are as thick as they say") {
  for (const double length : {1e5, 1e6, 1e7, 2e9}) {
    const Scene scene = white_shapes({
        shaped(Box{{{-length, -1, -length}, {length, 0, length}}}),
        shaped(Sphere{{0, 0.5, 0}, 0.8}),
    });
    const Comparison c = against_reference(scene);
    INFO(length << ": " << to_text(c));
    CHECK(c.psnr >= 45);
  }
}

TEST_CASE("Points where surfaces of a CSG coincide are in boxes, but only in open cylinders and cones") {
  const Transform turned = Transform::rotate({0, 25, 5}).then(Transform::translate({0, 0.01, 0}));
  const auto colour = [](Scene& scene, const Vec3& rgb) {
    Material m = matte(rgb);
    m.finish.ambient = Vec3(1);
    m.finish.diffuse = 0;
    return scene.add(m);
  };
  /// The first shape without the second, or where no CSG is asked for, both of them.
  const auto picture = [&](const decltype(Object::shape)& first, const decltype(Object::shape)& second,
                           bool csg) {
    Scene scene;
    scene.camera = camera_at({2, 7, -5}, {0, 0, 0});
    const Index red = colour(scene, {1, 0, 0}), green = colour(scene, {0, 1, 0});
    const Index interior = scene.add(Interior{});
    Object one = shaped(first), other = shaped(second);
    one.material = red;
    other.material = green;
    one.interior = other.interior = interior;
    if (csg) {
      const auto difference = std::make_shared<Csg>(Csg{Csg::Operation::difference, {one, other}});
      scene.objects = {shaped(std::shared_ptr<const Csg>(difference))};
      scene.objects[0].material = red;
      scene.objects[0].interior = interior;
    } else {
      scene.objects = {one, other};
    }
    for (Object& object : scene.objects)
      object.transform = turned;
    return render(scene, backends().front().options(80, 60, 2)).image;
  };
  const Box block{{{-1.5, -1, -1.5}, {1.5, 1, 1.5}}}, hole{{{-1, -0.5, -1}, {1, 1, 1}}};
  // The hole's lid is seen, which lies a little higher in the other picture.
  const Box lid{{{-1, 0.9, -1}, {1, 1.0001, 1}}};
  CHECK(compare_images(picture(block, hole, true), picture(block, lid, false)).psnr >= 40);
  const Cylinder drum{{0, -1, 0}, {0, 1, 0}, 1.5, false}, bore{{0, -0.5, 0}, {0, 1, 0}, 1, false};
  const Cylinder sunk{{0, -0.5, 0}, {0, 0.9, 0}, 1, false};
  CHECK(compare_images(picture(drum, bore, true), picture(drum, sunk, false)).psnr >= 40);
  const Cone frustum{{0, -1, 0}, {0, 1, 0}, 2, 1.5, false}, funnel{{0, -0.5, 0}, {0, 1, 0}, 0.3, 1, false};
  CHECK(compare_images(picture(frustum, funnel, true), picture(frustum, sunk, false)).psnr >= 40);
  // These have no lid, as if they reached farther out.
  for (const bool is_cone : {false, true}) {
    const auto hollow = [&](double height) {
      const double radius = is_cone ? 0.3 + 0.7 * (height + 0.5) / 1.5 : 1;
      const Cone opening{{0, -0.5, 0}, {0, height, 0}, 0.3, radius, true};
      const Cylinder pipe{{0, -0.5, 0}, {0, height, 0}, radius, true};
      return is_cone ? picture(drum, opening, true) : picture(drum, pipe, true);
    };
    CHECK(compare_images(hollow(1), hollow(1.01)).psnr >= 40);
  }
}

TEST_CASE("Thin tori have smooth outlines") {
  for (const double minor : {0.1, 0.03, 0.01, 0.0035}) {
    const Transform turned = Transform::rotate({20, 30, 10});
    const Comparison c = against_reference(white_shapes({shaped(Torus{1.7, minor}, turned)}));
    INFO(minor << ": " << to_text(c));
    CHECK(c.psnr >= 50);
  }
}

TEST_CASE("Shadow rays miss what is near behind a translucent surface") {
  // A floor under glass that is not seen itself, in light from above.
  const auto scene_of = [](const std::vector<std::pair<double, double>>& boxes,
                           const std::vector<float>& sheets) {
    Scene scene;
    scene.camera = orthographic_camera({0, 4, -4}, {0, 0, 0}, 4);
    scene.lights.emplace_back().location = {0.1, 100, 0.2};
    const Index white = scene.add(matte({1, 1, 1})), clear = scene.add(glass({0.7, 0.8, 0.9}));
    scene.objects.push_back(mesh_object(floor_mesh(0, 3), white, scene.add(Interior{})));
    for (const auto& [bottom, top] : boxes) {
      Object object;
      object.shape = Box{{{-1, bottom, -1}, {1, top, 1}}};
      object.material = clear;
      scene.objects.push_back(object);
    }
    for (const float height : sheets)
      scene.objects.push_back(mesh_object(floor_mesh(height, 1), clear, kNoIndex));
    for (std::size_t i = 1; i < scene.objects.size(); ++i)
      scene.objects[i].no_image = true;
    return scene;
  };
  const auto is_flagged = [](const Scene& scene) {
    return (SceneImage(scene).header().light_features & kernel::light_feature::near_surfaces) != 0;
  };
  struct Case {
    std::vector<std::pair<double, double>> boxes;
    std::vector<float> seen; ///< the heights of the surfaces that count
  };
  const std::vector<std::pair<double, double>> layers = {
      {1, 1.2}, {1.2005, 1.3}, {1.3004, 1.3008}, {1.5, 1.6}};
  for (const Case& c : {Case{{{1, 1.0005}}, {1}},                         // thin
                        Case{{{1, 1.2}, {1.2005, 1.5}}, {1, 1.2f, 1.5f}}, // a gap
                        Case{{{1, 1.2}, {1.2, 1.5}}, {1, 1.2f, 1.5f}},    // none
                        Case{layers, {1, 1.2f, 1.3f, 1.5f, 1.6f}}}) {
    const Scene scene = scene_of(c.boxes, {}), expected = scene_of({}, c.seen);
    CHECK(is_flagged(scene));
    for (const TestBackend& backend : backends()) {
      const RenderOptions options = backend.options(40, 30, 2);
      const Comparison comparison =
          compare_images(render(expected, options).image, render(scene, options).image);
      INFO(backend.spu() << ", " << c.boxes.size() << " boxes: " << to_text(comparison));
      CHECK(comparison.psnr > 60);
    }
  }
  CHECK_FALSE(is_flagged(scene_of({{1, 1.2}, {1.3, 1.4}}, {1.5f})));
  CHECK_FALSE(is_flagged(scene_of({}, {1, 1.1f})));
  Scene opaque = scene_of({{1, 1.2}, {1.2, 1.3}}, {});
  opaque.objects.back().material = 0;
  CHECK_FALSE(is_flagged(opaque));
  opaque.objects.back().material = 1;
  opaque.objects.back().no_shadow = true;
  CHECK_FALSE(is_flagged(opaque));
}

TEST_CASE("Holes that are cut hardly deeper than a wall are open") {
  // As far away as that, single precision does not tell the faces apart.
  for (const double distance : {10.0, 300.0, 3000.0}) {
    for (const double beyond : {1e-7, 3e-7, 1e-6, 1e-5}) {
      Scene scene;
      scene.camera = camera_at(Vec3(0.2, 0.3, -1) * distance, {0, 0, 0});
      scene.background = Vec3(0.1, 0.2, 0.9);
      scene.lights.push_back({Vec3(-2, 3, -2) * distance});
      const double size = 0.2 * distance, over = beyond * distance;
      const Index stone = scene.add(matte({0.9, 0.7, 0.5})), inside = scene.add(matte({0.2, 0.8, 0.3}));
      const Index interior = scene.add(Interior{});
      const auto part = [&](auto shape, Index material) {
        Object object;
        object.interior = interior;
        object.shape = shape;
        object.material = material;
        return object;
      };
      const auto low = -0.1 * size - over, high = 0.1 * size + over;
      auto wall = std::make_shared<Csg>();
      wall->operation = Csg::Operation::difference;
      wall->parts = {part(Box{{{-size, -size, -0.1 * size}, {size, size, 0.1 * size}}}, stone),
                     part(Box{{{-0.7 * size, -0.5 * size, low}, {-0.2 * size, 0.5 * size, high}}}, inside),
                     part(Cylinder{{0.1 * size, 0, high}, {0.1 * size, 0, low}, 0.2 * size}, inside),
                     part(Cone{{0.6 * size, 0, low}, {0.6 * size, 0, high}, 0.3 * size, 0.1 * size}, inside)};
      Object object;
      object.interior = interior;
      object.shape = std::shared_ptr<const Csg>(wall);
      object.transform = Transform::rotate({10, 20, 30});
      scene.objects.push_back(object);
      const Comparison c = against_reference(scene);
      INFO(distance << ", " << beyond << ": " << to_text(c));
      CHECK(c.psnr >= 45);
    }
  }
}

TEST_CASE("Of faces in one plane the one is seen that POV-Ray tests first") {
  const auto box = [](Scene& scene, const Vec3& from, const Vec3& to, const Vec3& colour) {
    Object object;
    object.shape = Box{{from, to}};
    object.material = scene.add(matte(colour));
    scene.materials[object.material].finish.ambient = Vec3(1);
    scene.materials[object.material].finish.diffuse = 0;
    scene.objects.push_back(object);
  };
  // Where they overlap, seen along z or against it, with something aside so that POV-Ray has a tree.
  for (const double direction : {1.0, -1.0}) {
    for (const double turn : {0.0, 35.0}) {
      Scene scene;
      scene.camera = orthographic_camera({0.05, 0.03, -10 * direction}, {0.05, 0.03, 0}, 1);
      const double thickness = 0.3 * direction;
      box(scene, {-1, -1, 0}, {3, 1, thickness}, {1, 0, 0});     // its middle is at x = 1
      box(scene, {-2, -1, 0}, {2, 1, 2 * thickness}, {0, 1, 0}); // 0
      box(scene, {-3, -1, 0}, {5, 1, thickness}, {0, 0, 1});     // 1, behind the others
      box(scene, {20, 0, 3}, {21, 1, 4}, {1, 1, 1});
      for (Object& object : scene.objects)
        object.transform = Transform::rotate({0, 0, turn});
      for (const TestBackend& backend : backends()) {
        const Image image = render(scene, backend.options(32, 24, 1)).image;
        INFO(backend.spu() << ", " << direction << ", turned by " << turn);
        for (int y = 0; y < image.height; ++y)
          for (int x = 0; x < image.width; ++x) {
            REQUIRE(image.pixel(x, y)[0] == 0);
            REQUIRE(image.pixel(x, y)[1] == 255);
          }
      }
    }
  }
}

TEST_CASE("Planes are in front of faces of boxes in them, and copies of one object stay where they are") {
  Scene scene;
  scene.camera = orthographic_camera({0.1, 10, 0.2}, {0.1, 0, 0.2}, 1);
  scene.camera.right = {1, 0, 0};
  scene.camera.up = {0, 0, 0.75};
  Object floor;
  Object lid;
  lid.shape = Box{{{-2, -1, -2}, {2, 0, 2}}};
  lid.material = scene.add(matte({1, 0, 0}));
  floor.shape = Plane{{0, 1, 0}, 0};
  floor.material = scene.add(matte({0, 0, 1}));
  for (const Index material : {lid.material, floor.material}) {
    scene.materials[material].finish.ambient = Vec3(1);
    scene.materials[material].finish.diffuse = 0;
  }
  Object aside;
  aside.shape = Sphere{{9, 0, 0}, 1};
  aside.material = floor.material;
  scene.objects = {lid, floor, aside};
  for (const TestBackend& backend : backends()) {
    const Image image = render(scene, backend.options(32, 24, 1)).image;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        REQUIRE(image.pixel(x, y)[2] == 255);
  }
  // What looks the same is not moved: the image is that of one box and one below it.
  Scene twice;
  twice.add(matte({1, 1, 1}));
  lid.material = 0;
  twice.objects = {lid, lid};
  const std::vector<std::uint32_t> opaque(2, kernel::object_flag::opaque);
  CHECK_FALSE(move_faces_apart(twice, {Eye(twice.camera), opaque}).has_value());
  twice.objects[1].material = twice.add(matte({1, 0, 0}));
  twice.camera.location = {0, 5, -9};
  const std::optional<Scene> apart = move_faces_apart(twice, {Eye(twice.camera), opaque});
  REQUIRE(apart.has_value());
  const auto& moved = std::get<Box>(apart->objects[0].shape); // of two objects the first one is seen
  CHECK(moved.corner[1].y > 0);
  CHECK(moved.corner[1].y < 1e-4);
  CHECK(moved.corner[0].y == -1);
}

TEST_CASE("Through transparent cylinders and cones is seen what they stand on") {
  for (const double height : {0.0, 0.3, -1.0, 5.7}) {
    for (const bool on_box : {false, true}) {
      Scene scene;
      scene.background = {1, 0, 0};
      scene.camera = camera_at({0.7, height + 4, -3}, {0.1, height, 0});
      Material ground = matte({0, 0, 1});
      ground.finish.ambient = Vec3(1);
      ground.finish.diffuse = 0;
      Material clear = ground;
      clear.pigment.transmit = 1;
      const Index of_ground = scene.add(ground), of_clear = scene.add(clear),
                  interior = scene.add(Interior{});
      const auto add = [&](decltype(Object::shape) shape, Index material) {
        Object object = shaped(std::move(shape));
        object.material = material;
        object.interior = interior;
        scene.objects.push_back(object);
      };
      if (on_box)
        add(Box{{{-90, height - 1, -90}, {90, height, 90}}}, of_ground);
      else
        add(Plane{{0, 1, 0}, height}, of_ground);
      add(Cylinder{{0, height, 0}, {0, height + 0.05, 0}, 0.8}, of_clear);
      add(Cone{{1, height + 0.7, 0.5}, {1, height, 0.5}, 0.2, 0.6}, of_clear);
      for (const TestBackend& backend : backends()) {
        const Image image = render(scene, backend.options(80, 60, 1)).image;
        INFO(backend.spu() << ", at " << height << (on_box ? ", on a box" : ""));
        int below = 0;
        for (int y = 0; y < image.height; ++y)
          for (int x = 0; x < image.width; ++x)
            below += image.pixel(x, y)[0] != 0;
        CHECK(below <= 1); // a ray that enters within 0.0001 of the ground misses it
      }
    }
  }
}

TEST_CASE("A camera beyond the box around an open mesh is not inside of it") {
  // The ray along the inside vector crosses the mesh once from all places in front of it.
  auto mesh = std::make_shared<Mesh>();
  mesh->vertices = {{-3, -3, 0}, {3, -3, 0}, {0, 3, 1}};
  mesh->triangles.push_back({{0, 1, 2}});
  mesh->inside_vector = {0, 0, 1};
  Scene scene;
  Material white;
  white.pigment.rgb = Vec3(1);
  scene.add(white);
  scene.lights.push_back({{0, 0, -100}});
  scene.fogs.emplace_back().distance = 3;
  Object wall, open;
  wall.shape = Plane{{0, 0, 1}, -20};
  wall.interior = scene.add(Interior());
  open.shape = std::shared_ptr<const Mesh>(mesh);
  open.interior = scene.add(Interior());
  open.no_image = true; // the wall is seen through it
  scene.objects = {wall, open};
  scene.camera.direction = {0, 0, -1};
  const auto brightness = [&](double z, const Transform& by) {
    scene.camera.location = {0, -2, z};
    scene.objects[1].transform = by;
    return int{render(scene, backends().front().options(4, 4, 1)).image.rgba[0]};
  };
  const int in_fog = brightness(-1, Transform());
  CHECK(in_fog < 5);
  CHECK(brightness(0.05, Transform()) > 80);
  CHECK(brightness(0.95, Transform()) == in_fog); // behind the mesh
  CHECK(brightness(-1, Transform::scale({1, 1, 3})) == in_fog);
  CHECK(brightness(-1, Transform::translate({0, 0, -1.05})) > 80);
}
