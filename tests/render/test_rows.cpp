// Pictures that are rendered part by part are those that are rendered as a whole.
#include "celltrace/error.hpp"
#include "render/backends.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace celltrace;
using namespace celltrace::test;

namespace {

// Packets, bundles and blocks that are not all whole.
constexpr int kWidth = 75;
constexpr int kHeight = 105;

struct Rows {
  int top, bottom;
};

template <class Picture> bool same_rows(const Picture& a, const Picture& b, const Rows& rows) {
  const auto size = static_cast<std::size_t>(4 * a.width * (rows.bottom - rows.top));
  return std::equal(a.pixel(0, rows.top), a.pixel(0, rows.top) + size, b.pixel(0, rows.top));
}

void check_rows(const RenderOptions& options) {
  const Scene scene = scene_named("glass and mirrors");
  const RenderResult whole = render(scene, options);
  Renderer renderer(options);
  REQUIRE(renderer.prepare(scene));
  // One after the other, backwards, with gaps, and again.
  const Rows parts[] = {{0, 32}, {32, 64},  {64, 105}, {96, 105}, {64, 96},
                        {0, 64}, {32, 105}, {0, 105},  {0, 32}};
  for (const Rows& rows : parts) {
    CAPTURE(rows.top, rows.bottom);
    const RenderResult part = renderer.render_rows(rows.top, rows.bottom);
    CHECK(part.complete);
    CHECK(part.statistics.height == rows.bottom - rows.top);
    CHECK(same_rows(part.image, whole.image, rows));
    if (options.colours) CHECK(same_rows(part.colours, whole.colours, rows));
    // What is not asked for is black.
    const int outside = rows.top > 0 ? 0 : kHeight - 1;
    if (rows.bottom - rows.top < kHeight) CHECK(part.image.pixel(3, outside)[1] == 0);
  }
  CHECK(renderer.render(scene.camera).image == whole.image);
}

} // namespace

TEST_CASE("Rows are those of the whole picture, antialiased or not") {
  for (const TestBackend& backend : backends())
    for (const unsigned spes : {1u, 3u})
      for (const bool colours : {false, true})
        for (int method = 0; method < 3; ++method) {
          INFO(backend.spu() << " with " << spes << ", method " << method);
          RenderOptions options = backend.options(kWidth, kHeight, spes);
          options.colours = colours;
          if (method > 0) {
            Antialiasing& antialiasing = options.antialiasing.emplace();
            antialiasing.method = method == 1 ? Antialiasing::Method::fixed : Antialiasing::Method::adaptive;
            antialiasing.threshold = 0.1;
            antialiasing.jitter = 0.7;
          }
          check_rows(options);
        }
}

TEST_CASE("Statistics of rows add up to those of the picture") {
  RenderOptions options;
  options.width = kWidth;
  options.height = kHeight;
  options.spes = 2;
  const Scene scene = scene_named("glass and mirrors");
  const RenderStatistics whole = render(scene, options).statistics;
  Renderer renderer(options);
  REQUIRE(renderer.prepare(scene));
  RenderStatistics sum = renderer.render_rows(0, 64).statistics;
  CHECK(sum.prepare_seconds > 0);
  add_rows(sum, renderer.render_rows(64, kHeight).statistics);
  CHECK(sum.height == kHeight);
  CHECK(sum.primary_rays == whole.primary_rays);
  CHECK(sum.shadow_rays == whole.shadow_rays);
  CHECK(sum.reflection_rays == whole.reflection_rays);
  CHECK(sum.refraction_rays == whole.refraction_rays);
  CHECK(sum.spes.size() == 2);
  CHECK(sum.spes[0].rays + sum.spes[1].rays == whole.total_rays());
}

TEST_CASE("Rows that make no sense are refused") {
  RenderOptions options;
  options.width = kWidth;
  options.height = kHeight;
  options.spes = 1;
  Renderer renderer(options);
  CHECK_THROWS_AS(renderer.render_rows(0, kHeight), InputError); // nothing is prepared
  REQUIRE(renderer.prepare(scene_named("glass and mirrors")));
  const Rows wrong[] = {{-32, 32}, {0, 0}, {64, 32}, {0, 40}, {16, 64}, {0, kHeight + 1}};
  for (const Rows& rows : wrong)
    CHECK_THROWS_AS(renderer.render_rows(rows.top, rows.bottom), InputError);
  CHECK(renderer.render_rows(96, kHeight).complete);
}
