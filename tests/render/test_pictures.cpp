// The pictures: the same from every backend with any number of SPEs, and close to those of the reference
// tracer.
#include "celltrace/image.hpp"
#include "kernel/cameras/list.hpp"
#include "reference/tracer.hpp"
#include "render/backends.hpp"
#include "render/scenes.hpp"
#include "scene_image/scene_image.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace celltrace;
using namespace celltrace::test;

namespace {

constexpr int kWidth = pixels(160);
constexpr int kHeight = pixels(120);

Image render_on(const TestBackend& backend, unsigned spes, const Scene& scene) {
  const RenderResult result = render(scene, backend.options(kWidth, kHeight, spes));
  REQUIRE(result.complete);
  REQUIRE(result.statistics.spu == backend.spu());
  REQUIRE(result.statistics.spes.size() == spes);
  REQUIRE(result.statistics.dropped_rays == 0);
  return result.image;
}

} // namespace

TEST_CASE("Pictures come close to the reference tracer's") {
  const TestBackend backend = backends().front();
  for (const NamedScene& named : scenes()) {
    INFO(named.name);
    if (!named.not_in_reference.empty()) {
      WARN(named.name << ": not compared, as " << named.not_in_reference);
      continue;
    }
    const Scene scene = named.make();
    const Image expected = reference::Tracer(scene).render(kWidth, kHeight);
    const Image picture = render_on(backend, 2, scene);
    const Comparison comparison = compare_images(expected, picture);
    INFO(to_text(comparison));
    CHECK(comparison.psnr >= 60);
  }
}

TEST_CASE("Surfaces look the same whether rays may go on from there or not") {
  // At level 1 none does, so that a mirror changes nothing but how its surface is shaded.
  for (const char* name : {"patterns", "surfaces", "textures", "lit from behind", "soft shadows"}) {
    Scene scene = scene_named(name);
    scene.max_trace_level = 1;
    Scene mirrors = scene;
    for (Material& material : mirrors.materials)
      material.finish.reflection_max += Vec3(1e-3);
    for (const TestBackend& backend : backends()) {
      INFO(name << " on " << backend.spu());
      CHECK(render_on(backend, 2, mirrors) == render_on(backend, 2, scene));
    }
  }
}

TEST_CASE("Few objects look the same among others that nobody sees") {
  for (int count = 0; count <= 3; ++count) {
    Scene few;
    few.camera = camera_at({0, 2, -6}, {0, 0.5, 0});
    few.lights = {{{4, 6, -5}, {1, 1, 0.8}}, {{-5, 3, -4}, {0.2, 0.3, 0.4}}};
    Material mirror = matte({0.3, 0.4, 0.6});
    mirror.finish.reflection_min = mirror.finish.reflection_max = Vec3(0.4);
    const Index interior = few.add(Interior{});
    Object floor;
    floor.shape = Plane{};
    floor.material = few.add(matte({0.8, 0.7, 0.6}));
    floor.interior = interior;
    few.objects = {floor};
    for (int i = 0; i < count; ++i)
      few.objects.push_back(sphere_at({1.5 * i - 1, 0.8, 0.5 * i}, 0.9, few.add(mirror), interior));
    Scene many = few;
    for (int i = 0; i < 9; ++i) {
      Object hidden = sphere_at({0.5 * i - 2, 1, -1}, 0.4, floor.material, interior);
      hidden.no_shadow = hidden.no_image = hidden.no_reflection = true;
      many.objects.push_back(hidden);
    }
    for (const TestBackend& backend : backends()) {
      INFO(count << " on " << backend.spu());
      CHECK(render_on(backend, 2, many) == render_on(backend, 2, few));
    }
  }
}

TEST_CASE("crand takes a random part of diffuse light, the same on every backend") {
  Scene scene;
  scene.gamma_mode = GammaMode::none;
  scene.camera = orthographic_camera({0, 5, 0.01}, {0, 0, 0}, 4);
  Light light;
  light.location = {0, 10, 0};
  light.point_at = {0, 0, 0};
  light.parallel = true;
  scene.lights = {light};
  Material material = matte(Vec3(0.5));
  material.finish.ambient = Vec3(0);
  material.finish.diffuse = 0.6;
  material.finish.crand = 0.3;
  scene.objects = {mesh_object(floor_mesh(0, 10), scene.add(material), scene.add(Interior{}))};
  // 0.5 (0.6 - [0, 0.3))
  const Image picture = render_on(backends().front(), 1, scene);
  double sum = 0, squares = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double value = picture.pixel(x, y)[0] / 255.0;
      REQUIRE(value >= 0.15 - 0.003);
      REQUIRE(value <= 0.3 + 0.003);
      sum += value;
      squares += value * value;
    }
  const double count = double{kWidth} * kHeight, mean = sum / count;
  const double error = 5 * 0.0433 / std::sqrt(count); // five standard errors of the mean
  CHECK(mean == Approx(0.225).margin(error + 0.001));
  CHECK(std::sqrt(squares / count - mean * mean) == Approx(0.15 / std::sqrt(12)).epsilon(0.15));
  for (const TestBackend& backend : backends())
    CHECK(render_on(backend, 3, scene) == picture);
}

namespace {

/// A box of glass that rays meet from inside beyond the critical angle, with a floor and a light.
Scene box_of_glass(const Finish& finish, const Interior& glass) {
  Scene scene;
  scene.camera = camera_at({0.5, 1.2, -5}, {0, 0.4, 0});
  scene.background = {0.5, 0.6, 0.9};
  scene.lights = {{{4, 6, -5}, {1, 1, 0.8}}};
  scene.max_trace_level = 8;
  Object floor;
  floor.shape = Plane{{0, 1, 0}, -1.1};
  floor.material = scene.add(matte({0.8, 0.7, 0.6}));
  floor.interior = scene.add(Interior{});
  Material clear = matte({0.9, 0.95, 0.8});
  clear.finish = finish;
  clear.pigment.filter = 0.9;
  Object box;
  box.shape = Box{{{-1, -1, -1}, {1, 1.5, 1}}};
  box.transform = Transform::rotate({0, 30, 0});
  box.material = scene.add(clear);
  box.interior = scene.add(glass);
  scene.objects = {floor, box};
  return scene;
}

} // namespace

TEST_CASE("Films change what is totally reflected, but nothing else of a mirror does") {
  Finish finish;
  finish.diffuse = 0; // which films do not need
  const Scene without = box_of_glass(finish, {1.5});
  finish.irid = 0.6;
  finish.irid_thickness = 0.8;
  const Scene film = box_of_glass(finish, {1.5});
  finish.reflection_max = Vec3(0.4);
  finish.reflection_metallic = 0.8;
  finish.reflection_exponent = 0.7;
  const Scene mirror = box_of_glass(finish, {1.5});
  const TestBackend backend = backends().front();
  for (const Scene& scene : {film, mirror}) {
    const Comparison c =
        compare_images(reference::Tracer(scene).render(kWidth, kHeight), render_on(backend, 2, scene));
    INFO(to_text(c));
    CHECK(c.psnr >= 50);
  }
  CHECK(compare_images(render_on(backend, 2, without), render_on(backend, 2, film)).psnr < 30);
}

TEST_CASE("Refraction of interiors dims transmitted light at each of their surfaces, but no shadows") {
  Finish finish;
  finish.diffuse = 0.2;
  finish.reflection_max = Vec3(0.1);
  for (const double refraction : {0.0, 0.5, 1.3}) {
    for (const double fade_distance : {0.0, 0.8}) {
      Interior glass{1.4, fade_distance, 2, {0.2, 0.5, 0.8}};
      glass.refraction = refraction;
      glass.hollow = refraction == 0.5;
      const Scene scene = box_of_glass(finish, glass);
      const Image expected = reference::Tracer(scene).render(kWidth, kHeight);
      for (const TestBackend& backend : backends()) {
        const Comparison c = compare_images(expected, render_on(backend, 2, scene));
        INFO(backend.spu() << ", " << refraction << ", " << fade_distance << ": " << to_text(c));
        CHECK(c.psnr >= 50);
      }
    }
  }
}

TEST_CASE("Parts of a merge hide nothing from rays that do not see them") {
  Material mirror = matte(Vec3(0.2));
  mirror.finish.reflection_min = mirror.finish.reflection_max = Vec3(0.6);
  for (const bool only_mirrored : {false, true}) {
    Scene scene;
    scene.camera = camera_at({0, 3, -5}, {0, 0, 0});
    scene.lights = {{{4, 6, -5}, {0.9, 0.9, 0.8}, true}}; // shadowless: all parts occlude
    scene.objects = {mesh_object(floor_mesh(-1.2f, 8), scene.add(mirror), scene.add(Interior{}))};
    Object inner = sphere_at({0, 0, 0}, 0.5, scene.add(matte({0.9, 0.2, 0.1})), scene.add(Interior{}));
    Object outer = sphere_at({0, 0, 0}, 0.9, scene.add(matte({0.1, 0.3, 0.9})), inner.interior);
    (only_mirrored ? outer.no_image : outer.no_reflection) = true;
    Scene apart = scene;
    apart.objects.insert(apart.objects.end(), {inner, outer});
    Object merge;
    merge.shape = std::make_shared<const Csg>(Csg{Csg::Operation::merge, {inner, outer}});
    merge.interior = inner.interior;
    scene.objects.push_back(merge);
    for (const TestBackend& backend : {backends().front(), backends().back()}) {
      const Comparison comparison =
          compare_images(render_on(backend, 2, apart), render_on(backend, 2, scene));
      INFO(backend.spu() << (only_mirrored ? ", no_image: " : ", no_reflection: ") << to_text(comparison));
      CHECK(comparison.psnr >= 60);
    }
  }
}

TEST_CASE("Light from the camera comes to all that primary rays see, but for unseen objects in its way") {
  for (const char* kind :
       {"all are seen", "one is not", "a part is not", "parallel", "mirrors", "inside of glass"}) {
    const std::string variant = kind;
    Scene scene;
    scene.camera = camera_at({0.5, 2, -5}, {0, 0, 0});
    scene.lights = {{scene.camera.location, {0.9, 0.9, 0.8}}};
    Material floor = matte({0.6, 0.7, 0.5});
    if (variant == "mirrors") floor.finish.reflection_min = floor.finish.reflection_max = Vec3(0.4);
    scene.objects = {mesh_object(floor_mesh(-1.2f, 8), scene.add(floor), scene.add(Interior{}))};
    Object ball = sphere_at({0, 0, 0}, 0.8, scene.add(matte({0.9, 0.2, 0.1})), scene.add(Interior{}));
    Object before = sphere_at({0.4, 0.9, -2.5}, 0.3, scene.add(matte({0.1, 0.3, 0.9})), ball.interior);
    before.no_image = variant == "one is not" || variant == "a part is not";
    if (variant == "a part is not") {
      Object both;
      both.shape = std::make_shared<const Csg>(Csg{Csg::Operation::union_, {ball, before}});
      scene.objects.push_back(both);
    } else {
      scene.objects.push_back(ball);
      scene.objects.push_back(before);
    }
    if (variant == "parallel") {
      scene.lights.front().parallel = true;
      scene.lights.front().point_at = {0, -3, 0};
    }
    if (variant == "inside of glass") {
      Material clear = matte({1, 1, 1});
      clear.pigment.transmit = 1;
      Interior fading;
      fading.fade_distance = 3;
      fading.fade_power = 1;
      scene.objects.push_back(sphere_at(scene.camera.location, 2, scene.add(clear), scene.add(fading)));
    }
    const Image expected = reference::Tracer(scene).render(kWidth, kHeight);
    for (const TestBackend& backend : backends()) {
      const Comparison comparison = compare_images(expected, render_on(backend, 2, scene));
      INFO(backend.spu() << ", " << variant << ": " << to_text(comparison));
      CHECK(comparison.psnr >= 55);
    }
  }
}

TEST_CASE("Every kind of camera") {
  Scene scene = scene_named("glass and mirrors");
  const Camera perspective = scene.camera;
  for (std::uint32_t kind = 0; kind < kernel::Cameras::kCount; ++kind) {
    INFO(kernel::Cameras::kNames[kind]);
    scene.camera = perspective;
    scene.camera.kind = static_cast<Camera::Kind>(kind);
    scene.camera.angle = 150;
    scene.camera.vertical_angle = 120;
    if (scene.camera.kind == Camera::Kind::orthographic) scene.camera.right *= 4, scene.camera.up *= 4;
    const Image expected = reference::Tracer(scene).render(kWidth, kHeight);
    for (const TestBackend& backend : {backends().front(), backends().back()}) {
      const Comparison comparison = compare_images(expected, render_on(backend, 2, scene));
      INFO(backend.spu() << ": " << to_text(comparison));
      CHECK(comparison.psnr >= 55);
    }
  }
}

TEST_CASE("More lights than a bundle of packets searches for, some of them shadowless") {
  Scene scene = scene_named("glass and mirrors");
  for (int i = 0; i < 6; ++i) {
    Light light = scene.lights.front();
    light.location += Vec3(2 * i - 5, 1, i % 3);
    light.colour *= 0.1;
    light.shadowless = i % 4 == 1;
    scene.lights.push_back(light);
  }
  const Image expected = reference::Tracer(scene).render(kWidth, kHeight);
  for (const TestBackend& backend : {backends().front(), backends().back()}) {
    const Comparison comparison = compare_images(expected, render_on(backend, 2, scene));
    INFO(backend.spu() << ": " << to_text(comparison));
    CHECK(comparison.psnr >= 60);
  }
}

TEST_CASE("Jittered lights are the same each time and on every backend") {
  Scene scene = scene_named("soft shadows");
  const Image still = render_on(backends().front(), 1, scene);
  for (Light& light : scene.lights)
    if (light.area) light.area->jitter = true;
  const Image expected = render_on(backends().front(), 1, scene);
  CHECK_FALSE(expected == still);
  CHECK(compare_images(expected, still).psnr > 25);
  for (const TestBackend& backend : backends())
    for (unsigned spes : {1u, 3u}) {
      INFO(backend.spu() << " with " << spes);
      CHECK(render_on(backend, spes, scene) == expected);
    }
}

TEST_CASE("Every backend with any number of SPEs renders the same picture") {
  for (const NamedScene& named : scenes()) {
    INFO(named.name);
    const Scene scene = named.make();
    const Image expected = render_on(backends().front(), 1, scene);
    for (const TestBackend& backend : backends())
      for (unsigned spes : {1u, 2u, 3u, 8u, 16u}) {
        INFO(backend.spu() << " with " << spes);
        CHECK(render_on(backend, spes, scene) == expected);
      }
  }
}

TEST_CASE("Triangles of one plane that overlap look the same everywhere") {
  const Scene scene = overlapping_triangles();
  const Image expected = render_on(backends().front(), 1, scene);
  for (const Accelerator accelerator : {Accelerator::bvh, Accelerator::grid})
    for (const TestBackend& backend : backends()) {
      INFO(backend.spu());
      RenderOptions options = backend.options(kWidth, kHeight, 2);
      options.accelerator = accelerator;
      CHECK(render(scene, options).image == expected);
    }
}

TEST_CASE("What has no bounds is seen where something else is at the same distance") {
  for (const TestBackend& backend : backends()) {
    INFO(backend.spu());
    CHECK(render_on(backend, 1, ground(true)) == render_on(backend, 1, ground(false)));
  }
}

// Another exception in docs/differences-between-backends.md; tests of machine code have that of the SPU's
// rounding.
TEST_CASE("Bundled shadow rays see what single ones do, but for the sides of triangles") {
  Scene scene = scene_named("meshes");
  const Object ball = mesh_object(ball_mesh(40), 0, 0);
  for (int i = 0; i < 12; ++i) {
    scene.objects.push_back(ball);
    scene.objects.back().transform =
        Transform::scale({0.5, 0.5, 0.5})
            .then(Transform::rotate({37.0 * i, 11.0 * i, 5.0 * i}))
            .then(Transform::translate({0.8 * (i % 4) - 1.2, 0.7 * (i / 4) - 0.6, -1 + 0.1 * i}));
  }
  const std::vector<TestBackend> all = backends();
  const auto packets = std::find_if(all.begin(), all.end(), [](const TestBackend& backend) {
    return backend.backend == Backend::cell_emu;
  });
  REQUIRE(packets != all.end());
  const Image expected = render_on(*packets, 2, scene);
  for (const TestBackend& backend : all) {
    INFO(backend.spu());
    const Image picture = render_on(backend, 2, scene);
    std::size_t others = 0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
      others += !std::equal(picture.rgba.begin() + static_cast<std::ptrdiff_t>(i),
                            picture.rgba.begin() + static_cast<std::ptrdiff_t>(i + 4),
                            expected.rgba.begin() + static_cast<std::ptrdiff_t>(i));
    CHECK(others <= 2);
  }
}

namespace {

/// Balls of one mesh, in one another.
Scene instances() {
  Scene scene = scene_named("meshes");
  const Object ball = mesh_object(ball_mesh(6), 0, 0);
  for (int i = 0; i < 45; ++i) {
    scene.objects.push_back(ball);
    scene.objects.back().material = static_cast<Index>(i) % 4;
    scene.objects.back().transform =
        Transform::scale({0.3, 0.2 + 0.02 * (i % 11), 0.3})
            .then(Transform::rotate({37.0 * i, 11.0 * i, 5.0 * i}))
            .then(Transform::translate({0.4 * (i % 9) - 1.6, 0.35 * (i / 9) - 0.9, -1 + 0.17 * (i % 4)}));
  }
  return scene;
}

} // namespace

TEST_CASE("Instances of a mesh look as meshes of their own do") {
  const Scene scene = instances();
  Scene apart = scene;
  for (Object& object : apart.objects)
    if (auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape))
      *mesh = std::make_shared<const Mesh>(**mesh);
  REQUIRE(SceneImage(scene).header().prototype_count != 0);
  REQUIRE(SceneImage(apart).header().prototype_count == 0);
  const Image expected = render_on(backends().front(), 1, apart);
  for (const TestBackend& backend : backends())
    for (unsigned spes : {1u, 3u, 8u}) {
      INFO(backend.spu() << " with " << spes);
      CHECK(render_on(backend, spes, scene) == expected);
    }
}
