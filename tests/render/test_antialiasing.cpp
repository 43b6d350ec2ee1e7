// Antialiasing against both methods written plainly, in double precision; regions of pictures; levels of
// quality.
#include "celltrace/image.hpp"
#include "reference/camera.hpp"
#include "reference/tracer.hpp"
#include "render/backends.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

using namespace celltrace;
using namespace celltrace::test;

namespace {

// Blocks of 32 pixels that are not all whole.
constexpr int kWidth = 75;
constexpr int kHeight = 45;

/// Colours by the point of the picture, in pixels; the middle of the first pixel is (0, 0).
class Picture {
public:
  explicit Picture(const Scene& scene) : scene_(scene), tracer_(scene) {}

  Vec3 at(double x, double y) {
    const auto [known, is_new] = known_.try_emplace({x, y});
    if (is_new)
      if (const auto ray = reference::camera_ray(scene_.camera, (x + 0.5) / kWidth, (y + 0.5) / kHeight))
        known->second = tracer_.see(*ray);
    return known->second;
  }

private:
  const Scene& scene_;
  reference::Tracer tracer_;
  std::map<std::pair<double, double>, Vec3> known_;
};

bool differ(const Vec3& a, const Vec3& b, const Antialiasing& antialiasing) {
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    sum += std::abs(std::pow(std::max(a[i], 0.0), 1 / antialiasing.gamma) -
                    std::pow(std::max(b[i], 0.0), 1 / antialiasing.gamma));
  return sum >= antialiasing.threshold;
}

using Colours = std::map<std::pair<int, int>, Vec3>;

/// A block of pixels, one after the other.
void sample_block(Picture& picture, const Antialiasing& antialiasing, int left, int top, Colours& all) {
  const int n = antialiasing.depth;
  Colours block;
  std::map<std::pair<int, int>, bool> sampled;
  const auto sample = [&](int x, int y) {
    if (x < left || y < top || std::exchange(sampled[{x, y}], true)) return;
    Vec3 sum = picture.at(x, y);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        sum += picture.at(x + (i + 0.5) / n - 0.5, y + (j + 0.5) / n - 0.5);
    block[{x, y}] = sum / (n * n + 1.0);
  };
  const int right = std::min(left + 32, kWidth), bottom = std::min(top + 32, kHeight);
  for (int x = left; x < right; ++x)
    block[{x, top - 1}] = picture.at(x, top - 1);
  for (int y = top; y < bottom; ++y) {
    block[{left - 1, y}] = picture.at(left - 1, y);
    for (int x = left; x < right; ++x) {
      const Vec3 own = block[{x, y}] = picture.at(x, y);
      const bool from_left = differ(own, block[{x - 1, y}], antialiasing);
      const bool from_above = differ(own, block[{x, y - 1}], antialiasing);
      if (from_left) sample(x - 1, y);
      if (from_above) sample(x, y - 1);
      if (from_left || from_above) sample(x, y);
    }
  }
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x)
      all[{x, y}] = block[{x, y}];
}

Vec3 sample_square(Picture& picture, const Antialiasing& antialiasing, double x, double y, double size,
                   int level) {
  const std::array<Vec3, 4> corners = {picture.at(x, y), picture.at(x + size, y), picture.at(x, y + size),
                                       picture.at(x + size, y + size)};
  bool divided = false;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j)
      divided = divided || differ(corners[i], corners[j], antialiasing);
  Vec3 sum(0);
  for (int i = 0; i < 4; ++i)
    sum += divided && level < antialiasing.depth ? sample_square(picture, antialiasing, x + i % 2 * size / 2,
                                                                 y + i / 2 * size / 2, size / 2, level + 1)
                                                 : corners[static_cast<std::size_t>(i)];
  return sum / 4.0;
}

Image expected_picture(const Scene& scene, Antialiasing antialiasing) {
  Picture picture(scene);
  if (scene.gamma_mode == GammaMode::assumed)
    antialiasing.gamma /= scene.assumed_gamma; // linear, then compared
  Colours colours;
  if (antialiasing.method == Antialiasing::Method::fixed) {
    for (int y = 0; y < kHeight; y += 32)
      for (int x = 0; x < kWidth; x += 32)
        sample_block(picture, antialiasing, x, y, colours);
  } else {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        colours[{x, y}] = sample_square(picture, antialiasing, x - 0.5, y - 0.5, 1, 1);
  }
  Image image(kWidth, kHeight);
  for (const auto& [place, colour] : colours)
    for (int i = 0; i < 3; ++i)
      image.pixel(place.first, place.second)[i] =
          reference::encode(colour[i], scene.gamma_mode, scene.assumed_gamma);
  return image;
}

Antialiasing method(Antialiasing::Method method, int depth = 3, double threshold = 0.3) {
  Antialiasing antialiasing;
  antialiasing.method = method;
  antialiasing.depth = depth;
  antialiasing.threshold = threshold;
  return antialiasing;
}
const Antialiasing kFixed = method(Antialiasing::Method::fixed);
const Antialiasing kAdaptive = method(Antialiasing::Method::adaptive);

RenderResult sampled(const TestBackend& backend, unsigned spes, const Scene& scene,
                     const Antialiasing& antialiasing, std::optional<PictureRegion> region = {}) {
  RenderOptions options = backend.options(kWidth, kHeight, spes);
  options.antialiasing = antialiasing;
  options.region = region;
  RenderResult result = render(scene, options);
  REQUIRE(result.complete);
  REQUIRE(result.statistics.spu == backend.spu());
  REQUIRE(result.statistics.diagnostics.empty());
  return result;
}

/// Different in few pixels, where a comparison came out otherwise by rounding.
void check_close(const Image& picture, const Image& expected) {
  const Comparison comparison = compare_images(picture, expected);
  INFO(to_text(comparison));
  CHECK(comparison.psnr >= 50);
}

} // namespace

TEST_CASE("Antialiased pictures are those of the methods written plainly") {
  const Scene scene = scene_named("glass and mirrors");
  const TestBackend backend = backends().front();
  for (const Antialiasing& antialiasing :
       {kFixed, kAdaptive, method(Antialiasing::Method::fixed, 1),
        method(Antialiasing::Method::fixed, 4, 0.05), method(Antialiasing::Method::fixed, 2, 0),
        method(Antialiasing::Method::adaptive, 1), method(Antialiasing::Method::adaptive, 2, 0),
        method(Antialiasing::Method::adaptive, 5, 0.1)}) {
    INFO("method " << static_cast<int>(antialiasing.method) << ", depth " << antialiasing.depth
                   << ", threshold " << antialiasing.threshold);
    check_close(sampled(backend, 2, scene, antialiasing).image, expected_picture(scene, antialiasing));
  }
}

TEST_CASE("Colours are linear where antialiasing compares them") {
  Scene scene = scene_named("glass and mirrors");
  scene.gamma_mode = GammaMode::assumed;
  for (const double gamma : {0.6, 2.2, 3.0}) {
    scene.assumed_gamma = gamma;
    for (const Antialiasing& antialiasing : {kFixed, kAdaptive}) {
      INFO("gamma " << gamma << ", method " << static_cast<int>(antialiasing.method));
      check_close(sampled(backends().front(), 2, scene, antialiasing).image,
                  expected_picture(scene, antialiasing));
    }
  }
}

TEST_CASE("Antialiased pictures are the same from every backend with any number of SPEs") {
  const Scene scene = scene_named("glass and mirrors");
  for (Antialiasing antialiasing : {kFixed, kAdaptive}) {
    for (const double jitter : {0.0, 1.0}) {
      antialiasing.jitter = jitter;
      const Image expected = sampled(backends().front(), 1, scene, antialiasing).image;
      CHECK(compare_images(expected, sampled(backends().front(), 1, scene, antialiasing).image).psnr > 90);
      for (const TestBackend& backend : backends())
        for (const unsigned spes : {1u, 3u, 8u}) {
          INFO(backend.spu() << " with " << spes);
          check_close(sampled(backend, spes, scene, antialiasing).image, expected);
        }
    }
  }
}

TEST_CASE("Antialiasing costs more rays where colours differ, and all are counted") {
  const Scene scene = scene_named("glass and mirrors");
  const TestBackend backend = backends().back();
  const auto rays = [&](const Antialiasing& antialiasing) {
    return sampled(backend, 2, scene, antialiasing).statistics.primary_rays;
  };
  const std::uint64_t grid = (kWidth + 1) * (kHeight + 1);
  CHECK(rays(method(Antialiasing::Method::fixed, 3, 3)) == grid);
  CHECK(rays(method(Antialiasing::Method::fixed, 3, 0)) == grid + 9 * kWidth * kHeight);
  CHECK(rays(method(Antialiasing::Method::adaptive, 1, 0)) == grid);
  CHECK(rays(method(Antialiasing::Method::adaptive, 2, 0)) == grid + 5 * kWidth * kHeight);
  CHECK(rays(kFixed) > grid);
  CHECK(rays(kFixed) < grid + 9 * kWidth * kHeight);
}

TEST_CASE("An antialiased frame can be cancelled anywhere, and the next one is as usual") {
  const Scene scene = scene_named("glass and mirrors");
  for (const TestBackend& backend : {backends().front(), backends().back()})
    for (const Antialiasing& antialiasing : {kFixed, kAdaptive}) {
      const Image expected = sampled(backend, 2, scene, antialiasing).image;
      RenderOptions options = backend.options(kWidth, kHeight, 2);
      options.antialiasing = antialiasing;
      Renderer renderer(options);
      for (const double limit : {0.0, 0.3, 0.5, 0.7}) {
        INFO(backend.spu() << " at " << limit);
        double last = -1;
        const RenderResult result = renderer.render(scene, [&](double fraction) {
          CHECK(fraction >= last);
          last = fraction;
          return fraction < limit;
        });
        CHECK_FALSE(result.complete);
        CHECK(result.image.width == kWidth);
        check_close(renderer.render(scene).image, expected);
        check_close(renderer.render(scene.camera).image, expected);
      }
      std::vector<double> fractions;
      renderer.render(scene, [&](double fraction) {
        fractions.push_back(fraction);
        return true;
      });
      check_completed(fractions);
    }
}

TEST_CASE("Regions are parts of the whole picture, the rest is black") {
  const Scene scene = scene_named("glass and mirrors");
  for (const TestBackend& backend : {backends().front(), backends().back()}) {
    RenderOptions options = backend.options(kWidth, kHeight, 2);
    const Image whole = render(scene, options).image;
    for (const PictureRegion& region :
         {PictureRegion{0, kWidth, 0, kHeight}, PictureRegion{13, 14, 7, 8}, PictureRegion{5, 70, 11, 45}}) {
      options.region = region;
      const Image part = render(scene, options).image;
      Image expected(kWidth, kHeight);
      for (int y = region.top; y < region.bottom; ++y)
        std::copy_n(whole.pixel(region.left, y), 4 * (region.right - region.left),
                    expected.pixel(region.left, y));
      check_close(part, expected);
    }
  }
}

TEST_CASE("An antialiased region has blocks of its own, and looks at the pixels around it") {
  const Scene scene = scene_named("glass and mirrors");
  const TestBackend backend = backends().front();
  // Where blocks are the same ones, so are the pixels.
  const PictureRegion region{32, 75, 32, 45};
  for (const Antialiasing& antialiasing : {kFixed, kAdaptive}) {
    const Image whole = sampled(backend, 1, scene, antialiasing).image;
    const Image part = sampled(backend, 1, scene, antialiasing, region).image;
    Image expected(kWidth, kHeight);
    for (int y = region.top; y < region.bottom; ++y)
      std::copy_n(whole.pixel(region.left, y), 4 * (region.right - region.left),
                  expected.pixel(region.left, y));
    check_close(part, expected);
  }
}

TEST_CASE("Levels of quality leave out what they say") {
  const Scene scene = scene_named("glass and mirrors");
  const auto at = [&](int quality) {
    RenderOptions options = backends().front().options(kWidth, kHeight, 2);
    options.quality = quality;
    return render(scene, options);
  };
  const RenderResult all = at(9);
  for (const int same : {8, 10, 11})
    CHECK(at(same).image == all.image);
  for (const int pair : {0, 2, 6})
    CHECK(at(pair).image == at(pair + 1).image);
  CHECK(all.statistics.reflection_rays > 0);
  CHECK(all.statistics.refraction_rays > 0);
  CHECK(at(7).statistics.refraction_rays > 0);
  CHECK(at(5).statistics.refraction_rays == 0);
  CHECK(at(5).statistics.shadow_rays > 0);
  CHECK(at(1).statistics.shadow_rays == 0);
  CHECK(at(1).statistics.total_rays() == kWidth * kHeight);
}

TEST_CASE("Options of pictures that are out of range are errors") {
  const auto refused = [](const std::function<void(RenderOptions&)>& change) {
    RenderOptions options;
    options.antialiasing.emplace();
    change(options);
    CHECK_THROWS_AS(Renderer(options), InputError);
  };
  refused([](RenderOptions& o) { o.antialiasing->depth = 0; });
  refused([](RenderOptions& o) { o.antialiasing->depth = 10; });
  refused([](RenderOptions& o) { o.antialiasing->threshold = -1; });
  refused([](RenderOptions& o) { o.antialiasing->threshold = std::nan(""); });
  refused([](RenderOptions& o) { o.antialiasing->jitter = 1.5; });
  refused([](RenderOptions& o) { o.antialiasing->gamma = 0; });
  refused([](RenderOptions& o) { o.model = Model::offload; });
  refused([](RenderOptions& o) { o.quality = 12; });
  refused([](RenderOptions& o) { o.region = PictureRegion{10, 10, 0, 5}; });
  refused([](RenderOptions& o) { o.region = PictureRegion{-1, 10, 0, 5}; });
  refused([](RenderOptions& o) { o.region = PictureRegion{0, 641, 0, 5}; });
}
