#include "render/scenes.hpp"

#include <cmath>
#include <stdexcept>

#include <glm/geometric.hpp>

namespace celltrace::test {

namespace {

Index new_interior(Scene& scene, double ior = 1) {
  return scene.add(Interior{ior});
}

void add_sphere(Scene& scene, const Vec3& centre, double radius, const Material& material, double ior = 1) {
  scene.objects.push_back(sphere_at(centre, radius, scene.add(material), new_interior(scene, ior)));
}

void add_floor(Scene& scene, float height, const Vec3& near_colour, const Vec3& far_colour) {
  Mesh mesh = floor_mesh(height, 8);
  for (Index& material : mesh.triangles[1].material)
    material = static_cast<Index>(scene.materials.size());
  scene.add(matte(far_colour));
  scene.objects.push_back(mesh_object(mesh, scene.add(matte(near_colour)), new_interior(scene)));
}

Scene with_camera(const Camera& camera) {
  Scene scene;
  scene.camera = camera;
  scene.background = {0.15, 0.25, 0.4};
  scene.lights = {{{4, 6, -5}, {0.9, 0.9, 0.8}, false}, {{-5, 3, -4}, {0.2, 0.25, 0.35}, true}};
  return scene;
}

/// Every highlight there is, most of the picture empty at the left.
Scene highlights() {
  Scene scene = with_camera(camera_at({0, 1.5, -7}, {0, 0.3, 0}));
  add_floor(scene, -1, {0.6, 0.5, 0.3}, {0.3, 0.5, 0.35});
  for (int i = 0; i < 12; ++i) {
    Material m = matte({0.2 + 0.06 * i, 0.9 - 0.05 * i, 0.3 + 0.04 * (i % 5)});
    m.finish.phong = i % 3 == 0 ? 0.8 : 0;
    m.finish.phong_size = i % 2 == 0 ? 20 : 90;
    m.finish.specular = i % 3 == 1 ? 0.7 : 0;
    m.finish.roughness = 0.01 + 0.01 * i;
    m.finish.metallic = i % 4 == 3 ? 1 : 0;
    m.finish.brilliance = i % 5 == 0 ? 3 : 1;
    m.finish.emission = i == 7 ? Vec3(0.3, 0, 0) : Vec3(0);
    add_sphere(scene, {0.3 + 0.8 * (i % 4), -0.6 + 0.8 * (i / 4), 0.3 * i - 1}, 0.42, m);
  }
  return scene;
}

Scene glass_and_mirrors() {
  Scene scene = with_camera(camera_at({0.5, 1.2, -6}, {0, 0, 0}));
  scene.max_trace_level = 9;
  add_floor(scene, -1, {0.9, 0.8, 0.7}, {0.3, 0.3, 0.8});
  add_sphere(scene, {-1.2, 0, 0}, 1, glass({0.95, 1, 0.95}), 1.5);
  Material core = glass({1, 0.8, 0.6});
  core.finish.reflection_min = Vec3(0);
  core.finish.reflection_max = Vec3(1);
  core.finish.reflection_fresnel = true;
  add_sphere(scene, {-1.2, 0, 0}, 0.5, core, 1.1);
  Material steel = matte({0.6, 0.6, 0.7});
  steel.finish.diffuse = 0.2;
  steel.finish.reflection_min = {0.4, 0.4, 0.4};
  steel.finish.reflection_max = {0.9, 0.9, 0.9};
  steel.finish.reflection_falloff = 2;
  steel.finish.reflection_metallic = 0.5;
  add_sphere(scene, {1.3, 0, 0.7}, 1, steel);
  Material bronze = matte({0.8, 0.5, 0.2});
  bronze.finish.reflection_min = bronze.finish.reflection_max = Vec3(0.6);
  bronze.finish.reflection_exponent = 1.8;
  add_sphere(scene, {-2.4, -0.5, -1.4}, 0.5, bronze);
  Material water = glass({0.8, 0.9, 1});
  water.pigment.transmit = 0.1;
  water.finish.reflection_max = Vec3(1);
  water.finish.reflection_min = Vec3(0);
  water.finish.reflection_fresnel = true;
  water.finish.conserve_energy = true;
  add_sphere(scene, {0.5, -0.5, -1.6}, 0.5, water, 1.33);
  add_sphere(scene, {2.2, 1.2, -1}, 0.3, matte({1, 0.2, 0.2}));
  scene.objects.back().no_shadow = true;
  return scene;
}

Scene ellipsoids() {
  Scene scene = with_camera(camera_at({0, 0.5, -6}, {0, 0, 0}));
  add_floor(scene, -2, {0.5, 0.5, 0.5}, {0.7, 0.7, 0.2});
  for (int i = 0; i < 9; ++i) {
    Material m = i % 3 == 2 ? glass({0.9, 0.7, 0.9}) : matte({0.3 + 0.07 * i, 0.5, 0.9 - 0.08 * i});
    m.finish.phong = 0.5;
    add_sphere(scene, {0.1, 0, 0}, 0.7, m, i % 3 == 2 ? 1.3 : 1);
    scene.objects.back().transform =
        Transform::scale({1, 0.25 + 0.1 * i, 0.6})
            .then(Transform::rotate({20.0 * i, 35.0 * i, 10.0 * i}))
            .then(Transform::translate({1.5 * (i % 3) - 1.5, 1.2 * (i / 3) - 1.0, 0.2 * i}));
  }
  return scene;
}

/// Smooth and flat meshes, instances, faces of one material and faces that blend three.
Scene meshes() {
  Scene scene = with_camera(camera_at({0, 1, -6}, {0, 0, 0}));
  add_floor(scene, -1.2f, {0.5, 0.6, 0.5}, {0.8, 0.8, 0.8});
  const Index colours[3] = {scene.add(matte({1, 0.1, 0.1})), scene.add(matte({0.1, 1, 0.1})),
                            scene.add(matte({0.1, 0.2, 1}))};
  Material pane = matte({0.9, 0.9, 0.2});
  pane.pigment.filter = 0.7;
  const Index clear = scene.add(pane);
  Mesh ball = ball_mesh(5);
  const Object smooth = mesh_object(ball, colours[0], new_interior(scene));
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
    for (Index& normal : ball.triangles[t].normal)
      normal = kNoIndex;
    for (int i = 0; i < 3; ++i)
      ball.triangles[t].material[i] = colours[(t / 2 + (t % 3 == 0 ? i : 0)) % 3];
    if (t % 4 == 1) ball.triangles[t].material[1] = clear;
  }
  scene.objects.push_back(smooth);
  scene.objects.back().transform = Transform::translate({-1.6, 0, 0});
  scene.objects.push_back(smooth);
  scene.objects.back().transform = Transform::scale({0.5, 1, -0.5}).then(Transform::translate({0.1, 0, 2}));
  scene.objects.push_back(mesh_object(ball, colours[2], new_interior(scene)));
  scene.objects.back().transform = Transform::rotate({10, 20, 30}).then(Transform::translate({1.5, 0, 0}));
  return scene;
}

/// The pigments' opacity and the picture's encoding as they were before version 3.7.
Scene legacy_orthographic() {
  Scene scene = with_camera(orthographic_camera({3, 3, -6}, {0, 0, 0}, 6));
  scene.version = 3.62;
  scene.gamma_mode = GammaMode::none;
  scene.ambient_light = {1.5, 1, 0.5};
  for (int i = 0; i < 10; ++i) {
    Material m = matte({0.8, 0.4, 0.1 * i});
    m.pigment.filter = i % 2 == 0 ? 0.5 : 0;
    m.pigment.transmit = i % 3 == 0 ? 0.25 : 0;
    add_sphere(scene, {1.1 * (i % 4) - 1.6, 0.9 * (i / 4) - 1, 0.5 * (i % 3)}, 0.6, m);
  }
  return scene;
}

/// Between two half mirrors: nearly every bounce leaves a ray behind for later.
Scene half_mirrors() {
  Scene scene = with_camera(camera_at({0, 0.3, 0.2}, {0.2, 0, 3}));
  scene.max_trace_level = 30;
  Material m = matte({0.5, 0.7, 0.9});
  m.pigment.transmit = 0.5;
  m.finish.diffuse = 0.05;
  m.finish.reflection_min = m.finish.reflection_max = Vec3(0.95);
  Mesh wall;
  wall.vertices = {{-9, -9, 0}, {9, -9, 0}, {0, 12, 0}};
  wall.triangles = {{{0, 1, 2}, {kNoIndex, kNoIndex, kNoIndex}, {kNoIndex, kNoIndex, kNoIndex}}};
  const Index material = scene.add(m);
  for (double z : {-1.0, 2.0}) {
    scene.objects.push_back(mesh_object(wall, material, new_interior(scene)));
    scene.objects.back().transform = Transform::rotate({0, z, 0}).then(Transform::translate({0, 0, z}));
  }
  add_sphere(scene, {0.4, -0.3, 1}, 0.2, matte({1, 0.3, 0.1}));
  return scene;
}

Scene inside_glass() {
  Scene scene = with_camera(camera_at({0, 0, -1}, {0.3, 0, 2}));
  scene.max_trace_level = 7;
  add_floor(scene, -3, {0.9, 0.4, 0.4}, {0.2, 0.7, 0.3});
  Material m = glass({0.95, 0.95, 1});
  m.finish.reflection_min = m.finish.reflection_max = Vec3(0);
  add_sphere(scene, {0, 0, 0}, 2, m, 1.4);
  add_sphere(scene, {0, 0, 0}, 3, m, 1.2);
  add_sphere(scene, {0.6, 0.3, 1.9}, 0.7, m,
             1.6); // overlaps the inner one: left in another order than entered
  add_sphere(scene, {0.3, -0.4, 0.8}, 0.2, matte({0.9, 0.9, 0.1}));
  add_sphere(scene, {1.5, 0.5, 6}, 1, matte({0.2, 0.4, 1}));
  return scene;
}

Scene empty() {
  return with_camera(camera_at({0, 0, -5}, {0, 0, 0}));
}

Scene dark() {
  Scene scene = highlights();
  scene.lights.clear();
  scene.gamma_mode = GammaMode::srgb;
  return scene;
}

/// All in one plane, in a working space of gamma 2.2, lit from in front and seen at a slant.
Scene flat_gamma() {
  Scene scene = with_camera(camera_at({2, 1, -5}, {0, 0, 0}));
  scene.assumed_gamma = 2.2;
  Mesh mesh;
  for (int i = 0; i < 40; ++i) {
    const float x = static_cast<float>(i % 8) - 4;
    const float y = static_cast<float>(i / 8) - 2.5f;
    const Index first = static_cast<Index>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {{x, y, 0}, {x + 0.9f, y + 0.1f, 0}, {x + 0.3f, y + 0.8f, 0}});
    mesh.triangles.push_back({{first, first + 1, first + 2}, {kNoIndex, kNoIndex, kNoIndex}, {}});
    for (Index& material : mesh.triangles.back().material)
      material = static_cast<Index>(i % 3);
  }
  scene.add(matte({0.9, 0.3, 0.2}));
  scene.add(matte({0.3, 0.9, 0.2}));
  scene.add(matte({0.2, 0.3, 0.9}));
  scene.objects.push_back(mesh_object(mesh, 0, new_interior(scene)));
  return scene;
}

/// Lights of every kind over a floor, with translucent things in them.
Scene kinds_of_lights() {
  Scene scene = with_camera(camera_at({0.5, 2.5, -7}, {0, 0, 0}));
  add_floor(scene, -1, {0.9, 0.85, 0.8}, {0.7, 0.8, 0.9});
  for (int i = 0; i < 6; ++i)
    add_sphere(scene, {1.4 * (i % 3) - 1.4, -0.4, 1.8 * (i / 3) - 0.9}, 0.55,
               matte({0.8, 0.5 + 0.08 * i, 0.4}));
  add_sphere(scene, {0.6, 0.9, -0.5}, 0.4, glass({0.9, 0.7, 0.6}), 1.2);
  const auto add_light = [&](Light::Kind kind, const Vec3& location, const Vec3& point_at,
                             const Vec3& colour) {
    Light light{location, colour * 0.6};
    light.kind = kind;
    light.point_at = point_at;
    scene.lights.push_back(light);
    return &scene.lights.back();
  };
  scene.lights.clear();
  Light* light = add_light(Light::Kind::spotlight, {-4, 5, -3}, {-1, -0.5, 0}, {1, 0.8, 0.5});
  light->radius = 8;
  light->falloff = 16;
  add_light(Light::Kind::point, {6, 9, -8}, {0, 0, 0}, {0.5, 0.5, 0.6})->parallel = true;
  light = add_light(Light::Kind::cylinder, {3, 5, 0}, {1, -1, 0.5}, {0.4, 0.7, 1.2});
  light->radius = 0.5;
  light->falloff = 1.2;
  light = add_light(Light::Kind::point, {0, 1.6, -2}, {0, 0, 0}, {0.9, 0.4, 0.6});
  light->fade_distance = 1.5;
  light->fade_power = 2;
  light = add_light(Light::Kind::spotlight, {0.6, 3, -0.5}, {0.6, 0, -0.5}, {0.6, 1, 0.6});
  light->tightness = 5;
  light->fade_distance = 3;
  light->fade_power = 1.5;
  light = add_light(Light::Kind::spotlight, {-1, 3, 4}, {-1, -1, 2}, {1, 1, 0.3});
  light->radius = light->falloff = 20;
  light->shadowless = true;
  light = add_light(Light::Kind::cylinder, {-3, 4, -1}, {-2, -1, -2}, {1, 0.3, 0.3});
  light->radius = 0;
  light->falloff = 0.8;
  light->tightness = 1.5;
  light->fade_distance = 4;
  light->fade_power = 1;
  // Half of what there is lies behind it.
  add_light(Light::Kind::point, {0, -0.4, 0}, {0.2, -1, 0.3}, {0.15, 0.1, 0.1})->parallel = true;
  return scene;
}

/// Shadows of areas, with a grid that is divided where it has to be, and others.
Scene soft_shadows() {
  Scene scene = scene_named("kinds of lights");
  LightArea area;
  area.across = {1.2, 0, 0};
  area.along = {0, 0.2, 1};
  area.columns = 5;
  area.rows = 4;
  scene.lights[0].area = area;
  area.columns = area.rows = 9;
  area.adaptive = 1;
  area.circular = true;
  scene.lights[1].area = area;
  area.orient = true;
  area.adaptive = 0;
  scene.lights[2].area = area;
  scene.lights.resize(4);
  return scene;
}

/// Seen by a camera that has no ray in some of the pixels, and in some packets none at all.
Scene dome() {
  Scene scene = scene_named("kinds of lights");
  scene.background = {0.3, 0.4, 0.9};
  scene.camera.kind = Camera::Kind::omnimax;
  scene.camera.right = glm::normalize(scene.camera.right) * 0.8;
  scene.camera.up = glm::normalize(scene.camera.up);
  return scene;
}

Pigment mapped(const Pattern& pattern, std::vector<PatternMap<Pigment>::Entry> entries,
               bool is_average = false) {
  Pigment pigment;
  pigment.map = map_of<Pigment>(pattern, std::move(entries), is_average);
  return pigment;
}

Pattern pattern_of(const pattern::Kind& kind, const Transform& transform = {}) {
  Pattern pattern;
  pattern.kind = kind;
  if (!transform.is_identity()) pattern.space = {transform};
  return pattern;
}

Material painted(const Pigment& pigment) {
  Material material;
  material.pigment = pigment;
  return material;
}

/// Pigments of patterns without noise: lists, blends and waves, nested, averaged, filtering.
Scene patterns() {
  Scene scene = with_camera(camera_at({0.4, 2.1, -6.3}, {0.1, 0.1, 0}));
  const Transform turned = Transform::scale(Vec3(0.43)).then(Transform::rotate({20, 30, 40}));
  const Pigment stripes =
      mapped(pattern_of(pattern::Gradient{{1, 0.2, 0}}, turned),
             {{0.3, {{0.9, 0.3, 0.1}}}, {0.5, {{0.9, 0.8, 0.3}}}, {0.9, {{0.2, 0.3, 0.8}}}});
  const Pigment cubes =
      mapped(pattern_of(pattern::Checker{}, Transform::scale(Vec3(0.61)).then(Transform::rotate({0, 37, 0}))),
             {{0, stripes}, {1, {{0.6, 0.7, 0.6}}}});
  scene.objects.push_back(mesh_object(floor_mesh(-1.03f, 8), scene.add(painted(cubes)), new_interior(scene)));
  for (int i = 0; i < 6; ++i) {
    Pattern waves = pattern_of(pattern::Gradient{{0, 1, 0.3}}, Transform::translate({0, 0.11, 0}));
    waves.wave = static_cast<Pattern::Wave>(i);
    waves.wave_exponent = 2.5;
    waves.frequency = 1 + 0.25 * i;
    waves.phase = 0.13 * i;
    Material m =
        painted(mapped(waves, {{0, {{0.2, 0.1, 0.5}, 0.1 * i, 0}}, {1, {{1, 0.9, 0.4}, 0.1, 0.1 * i}}}));
    m.finish.phong = 0.4;
    add_sphere(scene, {1.3 * (i % 3) - 1.3, -0.35 + 1.2 * (i / 3), 0.6 * (i / 3)}, 0.6, m);
  }
  const Pigment average = mapped({}, {{1, stripes}, {2, cubes}, {0.5, {{0, 0.5, 1}}}}, true);
  add_sphere(scene, {-0.7, -0.6, -1.5}, 0.4, painted(average));
  Material mirror = painted(stripes);
  mirror.finish.reflection_min = mirror.finish.reflection_max = Vec3(0.5);
  add_sphere(scene, {0.8, -0.6, -1.5}, 0.4, mirror);
  return scene;
}

/// Patterns of pigments and of objects, in each other and in maps of textures, and lists with waves.
Scene patterns_of_patterns() {
  Scene scene = with_camera(camera_at({0.4, 2.1, -6.3}, {0.1, 0.1, 0}));
  const auto shared = [](const Pigment& pigment) { return std::make_shared<const Pigment>(pigment); };
  Pattern waves = pattern_of(pattern::Gradient{{1, 0.4, 0}}, Transform::scale(Vec3(0.6)));
  waves.wave = Pattern::Wave::sine;
  const Pigment stripes = mapped(waves, {{0, {{0.9, 0.1, 0.3}}}, {1, {{0.2, 1, 0.6}}}});
  const Pigment rings =
      mapped(pattern_of(pattern::Onion{}), {{0, {{0, 0, 0}}}, {0.5, {{1, 0.9, 1}}}, {1, {{0, 0, 0}}}});
  const Pigment mixed = mapped({}, {{1, stripes}, {2, rings}}, true);
  Csg csg;
  csg.operation = Csg::Operation::difference;
  Object ball, box;
  ball.shape = Sphere{{0, 0, 0}, 1.1};
  box.shape = Box{{{-0.5, -0.6, -2}, {0.4, 0.5, 2}}};
  csg.parts = {ball, box};
  auto cut = std::make_shared<Object>();
  cut->shape = std::make_shared<const Csg>(csg);
  const auto grey = [&](const Pigment& of) {
    return pattern_of(pattern::Grey{shared(of)}, Transform::rotate({20, 30, 0}));
  };
  const Pigment bright = mapped(grey(mixed), {{0.1, {{0.1, 0.2, 0.6}}}, {0.9, {{1, 0.9, 0.5}}}});
  const Pigment in_cut = mapped(pattern_of(pattern::Inside{cut}, Transform::scale(Vec3(0.45))),
                                {{0, {{0.8, 0.7, 0.3}}}, {1, bright}});
  Pattern soft = pattern_of(pattern::Checker{}, Transform::scale(Vec3(0.37)));
  soft.frequency = 0.4;
  soft.phase = 0.2;
  const Pigment pale = mapped(soft, {{0, {{0.9, 0.2, 0.1}}}, {1, {{0.1, 0.3, 0.9}, 0, 0.4}}});
  const Pigment blend = mapped(soft, {{0, rings}, {1, stripes}});
  const Pigment deep = mapped(grey(in_cut), {{0, {{0.3, 0.1, 0.1}}}, {1, {{0.9, 1, 0.8}}}});
  scene.objects.push_back(
      mesh_object(floor_mesh(-1.03f, 8), scene.add(painted(bright)), new_interior(scene)));
  const Pigment all[] = {bright, in_cut, pale, blend, deep, mixed};
  for (int i = 0; i < 6; ++i)
    add_sphere(scene, {1.3 * (i % 3) - 1.3, -0.35 + 1.2 * (i / 3), 0.6 * (i / 3)}, 0.6, painted(all[i]));
  return scene;
}

/// Pigments on the surfaces of all shapes that have coordinates of their own, and of some that have none; in
/// CSG, clear, and as faces that blend.
Scene surfaces() {
  Scene scene = with_camera(camera_at({0.5, 2.4, -7}, {0, 0, 0}));
  const auto waves = [](const Vec3& along, bool uv_mapping, double filter) {
    Pattern pattern = pattern_of(pattern::Gradient{along}, Transform::scale(Vec3(0.25)));
    pattern.wave = Pattern::Wave::sine;
    pattern.uv_mapping = uv_mapping;
    return mapped(pattern, {{0, {{0.9, 0.3, 0.1}, filter}}, {1, {{0.9, 0.9, 0.5}, filter}}});
  };
  // In a map on the surface everything is; a map on it does not mind what is around.
  Pattern outer = pattern_of(pattern::Gradient{{0, 0.5, 0}}, Transform::translate({0, -0.25, 0}));
  outer.uv_mapping = true;
  const Pigment on_surface =
      mapped(outer, {{0.2, waves({1, 0, 0}, false, 0)}, {0.8, waves({0, 1, 0}, false, 0)}});
  Pattern around = pattern_of(pattern::Gradient{{0, 0.3, 0}}, Transform::translate({0, -1.5, 0}));
  const Pigment inside_map = mapped(around, {{0, waves({1, 0, 0}, true, 0)}, {1, waves({0, 1, 0}, true, 0)}});
  const Index painted_on[3] = {scene.add(painted(on_surface)), scene.add(painted(inside_map)),
                               scene.add(painted(waves({1, 0, 0}, true, 0.7)))};
  const Index plain = scene.add(painted(waves({1, 0, 0.3}, false, 0)));
  const auto add = [&](auto shape, const Transform& transform, Index material) {
    Object object;
    object.shape = shape;
    object.transform = transform;
    object.material = material;
    object.interior = new_interior(scene);
    scene.objects.push_back(object);
    return object;
  };
  const auto placed = [](double x, double y, double z) {
    return Transform::rotate({25, 30, 15}).then(Transform::translate({x, y, z}));
  };
  add(Sphere{{0.1, 0, 0}, 0.8}, placed(-2.4, 0.9, 0), painted_on[0]);
  add(Sphere{{0, 0, 0}, 0.7}, Transform::scale({-1, 0.6, 1}).then(placed(-0.8, 1.1, 0)), painted_on[1]);
  add(Sphere{{0, 0, 0}, 0.6}, Transform::scale({-1, 1, 1}).then(placed(2.6, 1.1, 0)), painted_on[1]);
  add(Box{{{-0.5, -0.6, -0.4}, {0.6, 0.5, 0.7}}}, placed(0.9, 0.9, 0), painted_on[0]);
  add(Torus{0.6, 0.25}, placed(-2.1, -0.9, -0.5), painted_on[0]);
  add(Cylinder{{0, -0.5, 0}, {0, 0.5, 0}, 0.4}, placed(-0.6, -0.8, -0.6), painted_on[1]);
  add(Sphere{{0, 0, 0}, 0.5}, placed(0.6, -0.8, -1), painted_on[2]);
  const auto facing = [&](const pattern::Slope& slope, double filter) {
    Pattern pattern = pattern_of(slope, Transform::rotate({0, 0, 30}));
    pattern.frequency = 1.5;
    pattern.wave = Pattern::Wave::triangle;
    return scene.add(
        painted(mapped(pattern, {{0, {{0.2, 0.9, 0.3}, filter}}, {1, {{0.9, 0.2, 0.9}, filter}}})));
  };
  add(Sphere{{0, 0, 0}, 0.4}, placed(1.4, -1, -1.6), facing({{0.3, 1, -0.5}, 0.2, 0.7}, 0));
  add(Sphere{{0, 0, 0}, 0.4}, placed(-1.2, -1, -1.6), facing({{1, 0, 0}, 0, 1, {0, 2, 0.5}, -1, 0.5}, 0.8));
  auto csg = std::make_shared<Csg>();
  csg->operation = Csg::Operation::difference;
  csg->parts = {add(Box{{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}}, Transform(), painted_on[0]),
                add(Sphere{{-0.2, 0.3, -0.5}, 0.45}, Transform(), painted_on[1])};
  scene.objects.resize(scene.objects.size() - 2);
  add(std::shared_ptr<const Csg>(csg), placed(2.1, -0.7, -0.5), 0);
  Mesh mesh = floor_mesh(-1.6f, 3);
  mesh.coordinates = {{{{0, 0}, {1, 0}, {1, 2}}}, {{{0, 0}, {1, 2}, {0, 1}}}};
  const Index blend[3] = {painted_on[0], plain, kNoIndex};
  std::copy(blend, blend + 3, mesh.triangles[1].material);
  scene.objects.push_back(mesh_object(mesh, painted_on[1], new_interior(scene)));
  return scene;
}

/// What else textures are made of: noise, turbulence, normals, layers, maps of textures, a sky.
Scene textures() {
  Scene scene = with_camera(camera_at({0.3, 1.9, -6.4}, {0, 0.2, 0}));
  const Transform small = Transform::scale(Vec3(0.37));
  Pattern clouds = pattern_of(pattern::Bozo{}, small);
  clouds.turbulence = {{0.4, 0.6, 0.4}, 4, 0.6, 2.2};
  clouds.noise_generator = 1;
  const Pigment marbled =
      mapped(clouds, {{0.2, {{0.2, 0.3, 0.7}}}, {0.5, {{0.8, 0.8, 0.6}}}, {0.8, {{0.9, 0.4, 0.2}}}});
  const Pigment veil = mapped(pattern_of(pattern::Gradient{{1, 0.1, 0}}, small),
                              {{0, {{0.9, 0.2, 0.2}, 0, 0.1}}, {0.6, {{0.8, 1, 0.9}, 0.6, 0.3}}});
  scene.sky_sphere = {
      mapped(pattern_of(pattern::Gradient{{0, 1, 0}}), {{0, {{0.9, 0.7, 0.5}}}, {1, {{0.1, 0.3, 0.8}}}}),
      mapped(clouds, {{0.4, {{1, 1, 1}, 0, 1}}, {0.9, {{1, 1, 1}, 0, 0.1}}})};

  Normal bumps;
  bumps.pattern = pattern_of(pattern::Bumps{}, Transform::scale(Vec3(0.21)));
  bumps.amount = 0.7;
  Normal waves;
  waves.pattern = pattern_of(pattern::Gradient{{0.2, 1, 0}}, Transform::scale(Vec3(0.3)));
  waves.pattern.wave = Pattern::Wave::sine;
  waves.amount = 0.6;
  Normal both;
  both.map = map_of<Normal>(pattern_of(pattern::Gradient{{0, 0, 1}}), {{0.2, bumps}, {0.8, waves}});

  Material rough = painted(marbled);
  rough.normal = std::make_shared<const Normal>(both);
  rough.finish.phong = 0.5;
  Material layered = painted(veil);
  layered.below = std::make_shared<const Material>(rough);
  layered.finish.reflection_min = layered.finish.reflection_max = Vec3(0.2);
  Material steel = matte({0.4, 0.45, 0.5});
  steel.normal = std::make_shared<const Normal>(waves);
  steel.finish.reflection_min = steel.finish.reflection_max = Vec3(0.5);
  Pattern warped = pattern_of(pattern::Bozo{}, small);
  warped.space.insert(warped.space.begin(), Turbulence{{0.7, 0.2, 0.5}, 6, 0.5, 2});
  Material blend;
  blend.map = map_of<Material>(warped, {{0.35, layered}, {0.5, rough}, {0.65, steel}});
  Material squares;
  squares.map = map_of<Material>(pattern_of(pattern::Checker{}, Transform::scale(Vec3(0.83))),
                                 {{0, matte({0.7, 0.7, 0.6})}, {1, blend}});
  Material window = painted(veil);
  window.normal = std::make_shared<const Normal>(bumps);
  const Material all[] = {rough, layered, steel, blend, squares, window};
  scene.objects.push_back(mesh_object(floor_mesh(-1.03f, 8), scene.add(squares), new_interior(scene)));
  for (int i = 0; i < 6; ++i)
    add_sphere(scene, {1.3 * (i % 3) - 1.3, -0.35 + 1.2 * (i / 3), 0.6 * (i / 3)}, 0.6, all[i],
               i == 5 ? 1.2 : 1);
  // A mesh whose corners blend three of them.
  Mesh ball = ball_mesh(4);
  for (std::size_t t = 0; t < ball.triangles.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner)
      ball.triangles[t].material[corner] = static_cast<Index>(1 + (t + corner * (t % 2)) % 3);
  scene.objects.push_back(mesh_object(ball, 1, new_interior(scene)));
  scene.objects.back().transform = Transform::scale(Vec3(0.45)).then(Transform::translate({0.6, -0.5, -1.6}));
  return scene;
}

/// Meshes in CSG: cut, cutting, inverse, clipped, blended, smooth and flat, closed and without an inside.
Scene cut_meshes() {
  Scene scene = with_camera(camera_at({0.3, 1.4, -6}, {0, -0.1, 0}));
  add_floor(scene, -1.2f, {0.5, 0.6, 0.5}, {0.8, 0.8, 0.8});
  const Index colours[3] = {scene.add(matte({1, 0.3, 0.2})), scene.add(matte({0.2, 0.9, 0.3})),
                            scene.add(glass({0.8, 0.9, 1}))};
  Mesh ball = ball_mesh(6);
  ball.inside_vector = {0.2, 1, 0.1};
  const auto smooth = std::make_shared<const Mesh>(ball);
  ball = ball_mesh(5);
  ball.inside_vector = {0, 0, -3};
  for (std::size_t t = 0; t < ball.triangles.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      ball.triangles[t].normal[corner] = kNoIndex;
      ball.triangles[t].material[corner] = colours[(t + corner * (t % 2)) % 2];
    }
  const auto blended = std::make_shared<const Mesh>(ball);
  // Without an inside. Of several triangles POV-Ray shows in CSG only what its search finds: the reference
  // does not.
  ball.inside_vector = Vec3(0);
  ball.vertices = {{-1, -0.8f, 0.3f}, {1.1f, -0.7f, 0}, {0.1f, 1.2f, 0.2f}};
  ball.triangles.resize(1);
  for (Index corner = 0; corner < 3; ++corner)
    ball.triangles[0].vertex[corner] = corner;
  const auto open = std::make_shared<const Mesh>(ball);
  const auto solid = [&](auto shape, Index material, const Transform& transform = {}) {
    Object object;
    object.shape = std::move(shape);
    object.material = material;
    object.transform = transform;
    return object;
  };
  const auto add = [&](Csg::Operation operation, std::vector<Object> parts, const Transform& transform) {
    const Index interior = new_interior(scene, 1.1);
    for (Object& part : parts)
      part.interior = interior;
    auto csg = std::make_shared<const Csg>(Csg{operation, std::move(parts)});
    scene.objects.push_back(solid(std::move(csg), 0, transform));
  };
  const Transform turned = Transform::rotate({20, 30, 10});
  add(Csg::Operation::difference,
      {solid(smooth, colours[0]), solid(blended, colours[1], Transform::translate({0.3, 0.4, -0.8})),
       solid(Cylinder{{0, -2, 0}, {0, 2, 0}, 0.3}, colours[1])},
      turned.then(Transform::translate({-1.5, 0, 0})));
  Object outside = solid(smooth, colours[1], Transform::scale({0.8, 1.3, 0.8}));
  outside.inverse = true;
  add(Csg::Operation::intersection, {solid(Box{}, colours[0], Transform::scale(Vec3(0.8))), outside},
      turned.then(Transform::translate({1, 0.1, 1.5})));
  add(Csg::Operation::merge,
      {solid(smooth, colours[2]), solid(smooth, colours[2], Transform::translate({0.9, 0, 0}))},
      Transform::scale(Vec3(0.6)).then(Transform::translate({0.9, -0.4, -1.2})));
  scene.objects.push_back(solid(blended, colours[0], Transform::translate({-0.2, 0.9, 2})));
  scene.objects.back().interior = new_interior(scene);
  scene.objects.back().clipped_by = std::make_shared<const std::vector<Object>>(std::vector<Object>{
      solid(Plane{{0, 0.3, 1}, 0.1}, 0, Transform::translate({-0.2, 0.9, 2})),
      solid(smooth, 0, Transform::scale({1, 0.7, 1}).then(Transform::translate({-0.4, 0.8, 2})))});
  add(Csg::Operation::difference, {solid(open, colours[0]), solid(Sphere{{0, 0.5, -0.5}, 0.8}, colours[1])},
      Transform::scale(Vec3(0.5)).then(Transform::translate({2.2, 0.2, 0})));
  return scene;
}

/// Fog, insides that fade and throw caustics, films, and what only some rays see.
Scene fog_and_insides() {
  Scene scene = glass_and_mirrors();
  Fog everywhere;
  everywhere.colour = {0.7, 0.8, 0.9};
  everywhere.filter = 0.3;
  everywhere.transmit = 0.1;
  everywhere.distance = 12;
  Fog ground;
  ground.colour = {0.9, 0.7, 0.6};
  ground.distance = 5;
  ground.is_ground = true;
  ground.offset = -0.8;
  ground.altitude = 0.4;
  ground.up = {0.1, 1, 0};
  scene.fogs = {everywhere, ground};
  for (std::size_t i = 0; i < scene.interiors.size(); ++i) {
    Interior& interior = scene.interiors[i];
    interior.hollow = i % 2 == 0;
    interior.refraction = 1.2 - 0.1 * static_cast<double>(i % 4);
    interior.fade_distance = 0.8;
    interior.fade_power = i % 3 == 0 ? 1000 : 1.5;
    interior.fade_colour = {0.2, 0.5, 0.8};
    interior.caustics = 0.2;
  }
  for (Material& material : scene.materials) {
    material.finish.irid = 0.3;
    material.finish.irid_thickness = 0.6;
  }
  scene.objects.back().no_image = true;
  scene.objects[scene.objects.size() - 2].no_reflection = true;
  return scene;
}

/// Polygons with holes, with lines that cross, shared by objects, clear, cut and in CSG.
Scene polygons() {
  Scene scene = with_camera(camera_at({0, 1, -6}, {0, 0, 0}));
  add_floor(scene, -1.5, {0.5, 0.6, 0.5}, {0.8, 0.8, 0.8});
  auto star = std::make_shared<Polygon>();
  auto frame = std::make_shared<Polygon>();
  star->loops.resize(1);
  frame->loops.resize(2);
  for (int i = 0; i < 7; ++i) {
    const double angle = 2 * 3.14159265358979 * (3 * i % 7) / 7;
    star->loops[0].push_back({std::cos(angle), std::sin(angle), 0.2});
  }
  for (int i = 0; i < 40; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 40, r = i % 2 == 0 ? 1 : 0.8;
    // In a slanted plane, and the hole the other way around.
    frame->loops[0].push_back({r * std::cos(angle), r * std::sin(angle), 0.5 * r * std::cos(angle)});
    frame->loops[1].push_back({0.5 * std::cos(angle), -0.4 * std::sin(angle), 0.25 * std::cos(angle)});
  }
  const auto add = [&](const std::shared_ptr<const Polygon>& polygon, const Material& material,
                       const Transform& transform) {
    Object object;
    object.shape = polygon;
    object.transform = transform;
    object.material = scene.add(material);
    object.interior = new_interior(scene);
    scene.objects.push_back(object);
  };
  add(star, matte({0.9, 0.3, 0.2}), Transform::translate({-1.5, 0.3, 0}));
  add(star, glass({0.9, 0.9, 0.3}),
      Transform::scale({1, 0.5, 1})
          .then(Transform::rotate({60, 20, 10}))
          .then(Transform::translate({0.4, -1, -1})));
  add(frame, matte({0.3, 0.8, 0.3}), Transform::rotate({0, 30, 0}).then(Transform::translate({1.4, 0.2, 0})));
  add(frame, matte({0.4, 0.5, 0.9}),
      Transform::rotate({80, 0, 0}).then(Transform::translate({-0.2, 1.1, 1})));
  scene.objects.back().clipped_by = std::make_shared<const std::vector<Object>>(
      std::vector<Object>{sphere_at({0.3, 1, 1}, 0.9, 0, scene.objects.back().interior)});
  Object part = scene.objects[1];
  part.transform = Transform();
  const Object ball = sphere_at({0, 0, 0}, 0.7, scene.objects[3].material, part.interior);
  auto csg = std::make_shared<const Csg>(Csg{Csg::Operation::intersection, {part, ball}});
  Object cut = part;
  cut.shape = csg;
  cut.transform = Transform::translate({0, 0.2, -1.5});
  scene.objects.push_back(cut);
  return scene;
}

/// Lights of every kind that shine through something alone.
Scene projected_lights() {
  Scene scene = with_camera(camera_at({0, 3, -7}, {0, 0, 0}));
  scene.lights.pop_back();
  scene.lights[0].colour = Vec3(0.15);
  add_floor(scene, -1, {0.5, 0.6, 0.5}, {0.8, 0.8, 0.8});
  for (int i = 0; i < 4; ++i)
    add_sphere(scene, {1.3 * i - 2, -0.4, 0.3 * i}, 0.5,
               i == 2 ? glass({0.9, 0.8, 0.9}) : matte({0.9, 0.8, 0.4}));
  add_sphere(scene, {-0.7, 2.6, -0.7}, 0.2, matte({1, 0, 0})); // before a projector
  const auto project = [&](Light light, const Object& projector) {
    light.projected_through = std::make_shared<const Object>(projector);
    scene.lights.push_back(light);
  };
  Object box;
  box.shape = Box{{{-1.6, 1, -1.6}, {-0.2, 1.1, 0}}};
  project({{-0.5, 4, -0.5}, {0.9, 0.6, 0.4}}, box);
  Object ring;
  ring.shape = Torus{0.8, 0.2};
  ring.transform = Transform::translate({1.2, 1, 0});
  Light area = {{1.5, 5, -1}, {0.4, 0.6, 1}};
  area.area = LightArea{{0.5, 0, 0}, {0, 0, 0.5}, 4, 4, 1};
  project(area, ring);
  Object cut = box;
  cut.shape = std::make_shared<const Csg>(
      Csg{Csg::Operation::difference, {box, sphere_at({-0.9, 1, -0.8}, 0.4, 0, 0)}});
  Light parallel = {{0, 6, 0}, {0.3, 0.9, 0.3}};
  parallel.parallel = true;
  parallel.point_at = {0.2, 0, 0.1};
  project(parallel, cut);
  Object mesh = mesh_object(floor_mesh(0, 0.7f), 0, 0);
  mesh.transform = Transform::rotate({30, 20, 0}).then(Transform::translate({0.4, 1, 1}));
  Light shadowless = {{0, 4, 3}, {0.5, 0.2, 0.5}, true};
  project(shadowless, mesh);
  Object wall;
  wall.shape = Plane{{0, 1, 0}, 0.5};
  project({{3, 2, -3}, {0.3, 0.3, 0.3}}, wall);
  return scene;
}

/// Lights that fog dims, and others, through hollow things and others.
Scene dimmed_lights() {
  Scene scene = with_camera(camera_at({0, 1.5, -7}, {0, 0, 0}));
  add_floor(scene, -1, {0.5, 0.6, 0.5}, {0.8, 0.8, 0.8});
  for (Interior& interior : scene.interiors)
    interior.hollow = true;
  scene.lights[0].is_dimmed_by_fog = true;
  scene.lights[0].colour = Vec3(1.6);
  scene.lights.push_back({{1, 4, 2}, {0.6, 0.8, 1.4}});
  scene.lights.back().is_dimmed_by_fog = true;
  scene.lights.back().area = LightArea{{0.5, 0, 0}, {0, 0, 0.5}, 2, 2, 0};
  add_sphere(scene, {-1.5, 0.3, 0}, 1, glass({0.9, 0.95, 1}), 1.1);
  add_sphere(scene, {1.5, 0.3, 0}, 1, glass({1, 0.95, 0.9}), 1.1);
  scene.interiors.back().hollow = true;
  add_sphere(scene, {0, -0.5, -1.5}, 0.5, matte({0.9, 0.7, 0.4}));
  Fog fog;
  fog.distance = 12;
  fog.colour = {0.6, 0.5, 0.4};
  fog.filter = 0.5;
  scene.fogs.push_back(fog);
  fog.is_ground = true;
  fog.distance = 5;
  fog.offset = -0.8;
  fog.altitude = 0.6;
  fog.transmit = 0.2;
  scene.fogs.push_back(fog);
  return scene;
}

/// Thin things of every kind before lights that are in front and behind.
Scene lit_from_behind() {
  Scene scene = with_camera(camera_at({0, 1, -7}, {0, 0, 0}));
  scene.lights.push_back({{1, 5, 6}, {0.8, 0.7, 0.6}});
  scene.lights.back().area = LightArea{{1, 0, 0}, {0, 1, 0}, 3, 3, 1};
  scene.lights.push_back({{-3, 0.5, 3}, {0.3, 0.5, 0.6}, true});
  scene.lights.push_back({{0, -6, 2}, {0.4, 0.3, 0.3}});
  add_floor(scene, -1.4f, {0.5, 0.6, 0.5}, {0.8, 0.8, 0.8});
  scene.materials[0].finish.diffuse_behind = 0.5; // half of the floor
  for (int i = 0; i < 12; ++i) {
    Material m = matte({0.4 + 0.05 * i, 0.9 - 0.05 * i, 0.4});
    m.finish.diffuse_behind = i % 3 == 0 ? 0 : 0.2 * (i % 4);
    m.finish.brilliance = i % 5 == 2 ? 2 : 1;
    m.finish.phong = 0.5 * (i % 2);
    m.finish.specular = i % 4 == 1 ? 0.6 : 0;
    m.finish.irid = i == 8 ? 0.3 : 0;
    m.finish.irid_thickness = 0.5;
    if (i == 5) m.pigment.transmit = 0.3;
    if (i == 7)
      m.pigment.map =
          map_of<Pigment>({pattern::Gradient{{1, 0, 0}}}, {{0, {{1, 0, 0}}}, {1, {{0.9, 0.9, 1}}}});
    Object object;
    object.material = scene.add(m);
    object.interior = new_interior(scene);
    object.is_lit_through = i % 3 == 1;
    const Vec3 at = {1.1 * (i % 4) - 1.7, 1.0 * (i / 4) - 0.8, 0.3 * (i % 3)};
    object.shape = Disc{{0, 0, 0}, {0, 0.1 * i, 1}, 0.45, 0.1 * (i % 2)};
    if (i % 4 == 2) object = mesh_object(ball_mesh(4), object.material, object.interior);
    if (i % 4 == 2) object.transform = Transform::scale(Vec3(0.4));
    if (i % 4 == 3) object.shape = Box{{{-0.4, -0.4, 0}, {0.4, 0.4, 0.05}}};
    object.is_lit_through = i % 3 == 1;
    object.transform =
        object.transform.then(Transform::rotate({0, 23.0 * i, 0})).then(Transform::translate(at));
    scene.objects.push_back(object);
  }
  return scene;
}

/// A bow that ends where rays are at right angles to its direction, though it is wider than that.
Scene rainbow_aside() {
  Scene scene = with_camera(camera_at({0, 1, -7}, {0, 1, 0}));
  add_floor(scene, -1, {0.5, 0.6, 0.5}, {0.8, 0.8, 0.8});
  Rainbow bow;
  bow.direction = {1, 0.1, 0};
  bow.angle = 80;
  bow.width = 40;
  bow.distance = 15;
  bow.colours = {{0, {0.8, 0.4, 1}, 0.9, 0.2}, {1, {1, 0.2, 0.1}, 0.9, 0.5}};
  scene.rainbows.push_back(bow);
  return scene;
}

/// Two bows that share a part of the sky, one of them an arc that fades, behind thin fog and in a mirror.
Scene rainbows() {
  Scene scene = with_camera(camera_at({0, 1, -7}, {0, 1, 0}));
  add_floor(scene, -1, {0.5, 0.6, 0.5}, {0.8, 0.8, 0.8});
  Material steel = matte({0.3, 0.3, 0.3});
  steel.finish.reflection_min = steel.finish.reflection_max = Vec3(0.6);
  add_sphere(scene, {1.2, 0, 0}, 1, steel);
  add_sphere(scene, {-1.6, -0.3, 1}, 0.7, matte({0.9, 0.8, 0.3}));
  Material clear = glass({0.9, 0.9, 0.9});
  add_sphere(scene, {0, 0.4, -2.5}, 0.4, clear, 1.2);
  Rainbow bow;
  bow.direction = {-0.1, -0.2, 1};
  bow.angle = 22;
  bow.width = 8;
  bow.distance = 15;
  bow.colours = {{0, {0.8, 0.4, 1}, 0.9, 0.2},
                 {0.4, {0.2, 0.9, 1}, 0.8, 0.1},
                 {0.5, {0.9, 1, 0.1}, 0.8, 0.2},
                 {0.9, {1, 0.2, 0.1}, 0.9, 0.5}};
  scene.rainbows.push_back(bow);
  bow.angle = 25;
  bow.up = {0.5, 1, 0};
  bow.arc_angle = 200;
  bow.falloff_angle = 60;
  bow.colours[1].rgb = {1, 0.5, 0.2};
  scene.rainbows.push_back(bow);
  bow.direction = {0.2, -0.5, -1};
  bow.up = {0, 1, 0};
  bow.arc_angle = bow.falloff_angle = 180;
  scene.rainbows.push_back(bow);
  Fog fog;
  fog.distance = 60;
  fog.colour = {0.6, 0.7, 0.8};
  scene.fogs.push_back(fog);
  return scene;
}

/// So many groups that they take more than one word of bits, of spheres, a mesh and CSG.
Scene light_groups() {
  Scene scene = with_camera(camera_at({0, 4, -8}, {0, 0, 0}));
  add_floor(scene, -0.5, {0.5, 0.6, 0.5}, {0.8, 0.8, 0.8});
  const Index white = scene.add(matte({1, 1, 1}));
  for (int i = 0; i < 40; ++i) {
    const double angle = 0.3 * i;
    const Vec3 at = {0.09 * i * std::cos(angle), -0.2, 0.09 * i * std::sin(angle)};
    Light light;
    light.location = at + Vec3(0.5, 2, -1.5);
    light.colour = {0.3 + 0.3 * (i % 3), 0.3 + 0.2 * (i % 4), 0.3 + 0.1 * (i % 5)};
    light.is_global = i % 8 == 7;
    if (i % 3 == 1) light.area = LightArea{{0.3, 0, 0}, {0, 0, 0.3}, 2, 2, 1};
    light.shadowless = i % 5 == 4;
    scene.lights.push_back(light);
    LightGroup group;
    group.global_lights = i % 4 == 2;
    if (!light.is_global) group.lights.push_back(static_cast<Index>(scene.lights.size() - 1));
    if (i % 6 == 5) group.lights.push_back(2);
    scene.light_groups.push_back(group);
    Object object = sphere_at(at, 0.25, white, new_interior(scene));
    if (i % 7 == 3) object = mesh_object(ball_mesh(3), white, new_interior(scene));
    if (i % 7 == 3) object.transform = Transform::scale(Vec3(0.3)).then(Transform::translate(at));
    object.light_group = static_cast<Index>(i);
    if (i % 7 == 5) {
      Object box = object;
      box.shape = Box{{at - 0.2, at + 0.2}};
      object.light_group = static_cast<Index>(i - 1);
      auto csg = std::make_shared<const Csg>(Csg{Csg::Operation::intersection, {object, box}});
      object = Object{csg, {}, white, object.interior};
    }
    scene.objects.push_back(object);
  }
  return scene;
}

} // namespace

const std::vector<NamedScene>& scenes() {
  static const std::vector<NamedScene> all = {
      {"highlights", highlights},
      {"glass and mirrors", glass_and_mirrors},
      {"ellipsoids", ellipsoids},
      {"meshes", meshes},
      {"fog and insides", fog_and_insides},
      {"kinds of lights", kinds_of_lights},
      {"dome", dome},
      {"soft shadows", soft_shadows},
      {"legacy orthographic", legacy_orthographic},
      {"half mirrors", half_mirrors},
      {"inside glass", inside_glass},
      {"empty", empty},
      {"dark", dark},
      {"flat, gamma 2.2", flat_gamma},
      {"patterns", patterns},
      {"patterns of patterns", patterns_of_patterns},
      {"surfaces", surfaces},
      {"cut meshes", cut_meshes},
      {"light groups", light_groups},
      {"lit from behind", lit_from_behind},
      {"projected lights", projected_lights},
      {"dimmed lights", dimmed_lights},
      {"polygons", polygons},
      {"rainbows", rainbows},
      {"rainbow aside", rainbow_aside},
      {"textures", textures, "the reference has no noise, layers or normals"}};
  return all;
}

Scene overlapping_triangles() {
  Scene scene = with_camera(camera_at({0, 3, -9}, {0, 0, 0}));
  const std::vector<Vec3f> corners[2] = {{{-9, 0, -9}, {9, 0, -9}, {0, 0, 9}},
                                         {{-8, 0, -8}, {8, 0, -9}, {1, 0, 9}}};
  for (int i = 0; i < 2; ++i) {
    Mesh mesh;
    mesh.vertices = corners[i];
    mesh.triangles.resize(1);
    for (Index corner = 0; corner < 3; ++corner)
      mesh.triangles[0].vertex[corner] = corner;
    scene.objects.push_back(
        mesh_object(mesh, scene.add(matte({1.0 * (i == 0), 1.0 * (i == 1), 0})), new_interior(scene)));
  }
  return scene;
}

Scene ground(bool with_bowl) {
  Scene scene = with_camera(camera_at({0, 3, -9}, {0, 0, 0}));
  const auto object = [&scene](auto shape, Index material) {
    Object o;
    o.shape = std::move(shape);
    o.material = material;
    o.interior = new_interior(scene);
    return o;
  };
  const Plane plane{{0, 1, 0}, 0};
  const Index red = scene.add(matte({1, 0, 0})), green = scene.add(matte({0, 1, 0}));
  if (with_bowl) {
    std::vector<Object> parts = {object(plane, red), object(Sphere{{0, 0, 0}, 2}, red)};
    auto bowl = std::make_shared<const Csg>(Csg{Csg::Operation::intersection, std::move(parts)});
    scene.objects.push_back(object(std::move(bowl), red));
  }
  scene.objects.push_back(object(plane, green));
  return scene;
}

Scene scene_named(const std::string& name) {
  for (const NamedScene& scene : scenes())
    if (scene.name == name) return scene.make();
  throw std::out_of_range("no scene is named " + name);
}

} // namespace celltrace::test
