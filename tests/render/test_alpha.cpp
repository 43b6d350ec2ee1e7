// Pictures with alpha: how clear pixels are, by POV-Ray's rules, on every backend.
#include "render/all_machines.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace celltrace;
using namespace celltrace::test;

namespace {

Material sheet(const Vec3& rgb, double filter, double transmit) {
  Material m = matte(rgb);
  m.pigment.filter = filter;
  m.pigment.transmit = transmit;
  m.finish.ambient = Vec3(1);
  m.finish.diffuse = 0;
  return m;
}

/// Three spheres beside each other before nothing; rays go through two surfaces of each.
Scene three_spheres() {
  Scene scene;
  scene.camera = orthographic_camera({0, 0, -10}, {0, 0, 0}, 8);
  scene.adc_bailout = 0;
  const Material materials[] = {sheet({1, 0.5, 0.25}, 0, 0.5), sheet({0, 0, 0}, 0, 0),
                                sheet({1, 0.5, 0}, 0.5, 0)};
  for (int i = 0; i < 3; ++i)
    scene.objects.push_back(
        sphere_at({2.5 * (i - 1), 0, 0}, 1, scene.add(materials[i]), scene.add(Interior{})));
  return scene;
}

RenderOptions with_alpha(const TestBackend& backend, unsigned spes = 2) {
  RenderOptions options = backend.options(45, 33, spes);
  options.alpha = true;
  options.colours = true;
  return options;
}

/// At the middles of the three spheres, and beside them.
std::vector<double> alphas(const ColourImage& colours) {
  const int row = colours.height / 2;
  std::vector<double> found;
  for (const double x : {-2.5, 0.0, 2.5, -3.9})
    found.push_back(
        static_cast<double>(colours.pixel(static_cast<int>((x / 8 + 0.5) * colours.width), row)[3]));
  return found;
}
void check_alphas(const ColourImage& colours, const std::vector<double>& expected) {
  const std::vector<double> found = alphas(colours);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(i);
    CHECK(found[i] == Approx(expected[i]).margin(1e-5));
  }
}

double grey(double r, double g, double b) {
  return 0.297 * r + 0.589 * g + 0.114 * b;
}
const double kFiltered = 0.5 * grey(1, 0.5, 0);

} // namespace

TEST_CASE("Pixels are clear as far as what is behind the scene comes through") {
  for (const TestBackend& backend : all_machines()) {
    INFO(backend.spu());
    const RenderResult result = render(three_spheres(), with_alpha(backend));
    check_alphas(result.colours, {1 - 0.25, 1, 1 - kFiltered * kFiltered, 0});
    // What is added to what is behind.
    CHECK(result.colours.pixel(5, 16)[0] == Approx(0.75).margin(1e-5));
    CHECK(result.image == to_image(result.colours));
    CHECK(result.image.pixel(0, 0)[3] == 0);
  }
}

TEST_CASE("Backgrounds and skies are as clear as the language says") {
  const TestBackend backend = backends().front();
  Scene scene = three_spheres();
  scene.background = Vec3(0.5, 0.25, 1);
  scene.background_transparency = 0;
  check_alphas(render(scene, with_alpha(backend)).colours, {1, 1, 1, 1});
  scene.background_transparency = 0.5;
  check_alphas(render(scene, with_alpha(backend)).colours,
               {1 - 0.125, 1, 1 - 0.5 * kFiltered * kFiltered, 0.5});
  scene.background_transparency = 1;
  scene.background = Vec3(0);
  Pigment sky;
  sky.rgb = Vec3(0.5, 0.25, 1);
  sky.transmit = 0.5;
  scene.sky_sphere = {sky};
  check_alphas(render(scene, with_alpha(backend)).colours,
               {1 - 0.125, 1, 1 - 0.5 * kFiltered * kFiltered, 0.5});
  // Before version 3.7 they are not there.
  scene.version = 3.6;
  scene.background = Vec3(1);
  scene.background_transparency = 0;
  const RenderResult old = render(scene, with_alpha(backend));
  CHECK(old.colours.pixel(0, 0)[0] == 0);
  CHECK(alphas(old.colours)[3] == 0);
  CHECK(alphas(old.colours)[0] == Approx(0.75));
}

TEST_CASE("Fog takes from how clear pixels are, also before nothing") {
  Scene scene = three_spheres();
  Fog fog;
  fog.colour = Vec3(0.5, 0.25, 1);
  fog.distance = 20;
  fog.transmit = 0.2;
  fog.filter = 0.25;
  scene.fogs.push_back(fog);
  const double tint = 0.75 + 0.25 * grey(0.5, 0.25, 1);
  for (const TestBackend& backend : all_machines()) {
    INFO(backend.spu());
    CHECK(alphas(render(scene, with_alpha(backend)).colours)[3] == Approx(1 - 0.2 * tint).margin(1e-5));
  }
}

TEST_CASE("Mirrors show what is behind the scene, and make no pixel clear") {
  Scene scene = three_spheres();
  for (Material& material : scene.materials)
    material.finish.reflection_min = material.finish.reflection_max = Vec3(0.5);
  scene.background = Vec3(0, 0, 0.5);
  const RenderResult result = render(scene, with_alpha(backends().front()));
  check_alphas(result.colours, {1 - 0.25, 1, 1 - kFiltered * kFiltered, 0});
}

TEST_CASE("Mirrors see all of a background that is clear, and other rays what is left of it") {
  Scene scene;
  scene.camera = orthographic_camera({0, 0, -10}, {0, 0, 0}, 8);
  scene.background = Vec3(0.25, 0.5, 0);
  scene.background_transparency = 0.5;
  scene.mirrored_background = Vec3(0.5, 1, 0);
  const Index mirror = scene.add(matte({0, 0, 0}));
  scene.materials[mirror].finish.reflection_min = scene.materials[mirror].finish.reflection_max = Vec3(0.5);
  scene.objects.push_back(sphere_at({0, 0, 0}, 1, mirror, scene.add(Interior{})));
  for (const TestBackend& backend : all_machines()) {
    INFO(backend.spu());
    const RenderResult result = render(scene, with_alpha(backend));
    const int middle = result.colours.width / 2, row = result.colours.height / 2;
    CHECK(result.colours.pixel(middle, row)[0] == Approx(0.25).margin(1e-4));
    CHECK(result.colours.pixel(middle, row)[1] == Approx(0.5).margin(1e-4));
    CHECK(result.colours.pixel(middle, row)[3] == Approx(1));
    CHECK(result.colours.pixel(0, 0)[1] == Approx(0.5).margin(1e-4));
    CHECK(result.colours.pixel(0, 0)[3] == Approx(0.5).margin(1e-4));
  }
}

TEST_CASE("Edges are as clear as they are antialiased, the same on every backend") {
  for (const auto method : {Antialiasing::Method::fixed, Antialiasing::Method::adaptive}) {
    std::optional<RenderResult> first;
    for (const TestBackend& backend : backends()) {
      INFO(backend.spu());
      RenderOptions options = with_alpha(backend, 3);
      options.antialiasing.emplace().method = method;
      const RenderResult result = render(three_spheres(), options);
      check_alphas(result.colours, {1 - 0.25, 1, 1 - kFiltered * kFiltered, 0});
      // The black sphere differs from what is around by alpha alone.
      int between = 0;
      for (int y = 0; y < 33; ++y)
        for (int x = 16; x < 29; ++x) {
          const float alpha = result.colours.pixel(x, y)[3];
          between += alpha > 0.01f && alpha < 0.99f;
        }
      CHECK(between > 10);
      if (!first) first = result;
      // Squares are divided in another order where more of them fit, and sums round otherwise.
      float worst = 0;
      for (std::size_t i = 0; i < result.colours.rgba.size(); ++i)
        worst = std::max(worst, std::fabs(result.colours.rgba[i] - first->colours.rgba[i]));
      CHECK(worst <= (method == Antialiasing::Method::fixed ? 0 : 1e-6f));
    }
  }
}

TEST_CASE("A region's surroundings are clear, and opaque pixels are those of other pictures") {
  const TestBackend backend = backends().front();
  Scene scene = scene_named("glass and mirrors");
  scene.background_transparency = 0;
  RenderOptions options = with_alpha(backend);
  const Image opaque = render(scene, options).image;
  RenderOptions plain = options;
  plain.alpha = plain.colours = false;
  CHECK(compare_images(opaque, render(scene, plain).image).max_difference <= 1);
  options.region = PictureRegion{10, 20, 5, 9};
  const Image part = render(scene, options).image;
  CHECK(part.pixel(9, 5)[3] == 0);
  CHECK(part.pixel(10, 5)[3] == 255);
  CHECK(std::equal(part.pixel(10, 8), part.pixel(20, 8), opaque.pixel(10, 8)));
}

TEST_CASE("Where a camera has no ray the picture is clear") {
  Scene scene = three_spheres();
  scene.camera.kind = Camera::Kind::fisheye;
  scene.camera.angle = 90;
  scene.background_transparency = 0;
  const RenderResult result = render(scene, with_alpha(backends().front()));
  CHECK(result.colours.pixel(0, 0)[3] == 0);
  CHECK(result.colours.pixel(22, 16)[3] == 1);
}

TEST_CASE("Alpha is for one model") {
  RenderOptions options = with_alpha(backends().front(), 4);
  options.model = Model::offload;
  CHECK_THROWS_AS(Renderer(options), InputError);
}
