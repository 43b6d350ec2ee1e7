// Pictures that are rendered part by part are those that are rendered as a whole.
#include "celltrace/error.hpp"
#include "render/backends.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

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

/// Memory has room for 32 rows, then for 64, of a picture and of a part of it.
void check_rows_at_once(const RenderOptions& options, const Scene& scene) {
  const RenderResult whole = render(scene, options);
  const PictureRegion region = options.region.value_or(PictureRegion{0, options.width, 0, options.height});
  const int width = region.right - region.left, height = region.bottom - region.top;
  for (const int at_once : {32, 64}) {
    RenderOptions partly = options;
    partly.rows_at_once = at_once;
    Renderer renderer(partly);
    REQUIRE(renderer.prepare(scene));
    // From the top to the bottom, as programs will do it; then with gaps, backwards, and again.
    std::vector<Rows> parts;
    for (int top = 0; top < height; top += at_once)
      parts.push_back({top, std::min(top + at_once, height)});
    for (const Rows& rows : {Rows{64, height}, Rows{0, 32}, Rows{0, 32}, Rows{32, 64}})
      parts.push_back(rows);
    for (const Rows& rows : parts) {
      CAPTURE(at_once, rows.top, rows.bottom);
      if (rows.bottom - rows.top > at_once) continue;
      const RenderResult part = renderer.render_rows(rows.top, rows.bottom);
      REQUIRE(part.image.width == width);
      REQUIRE(part.image.height == rows.bottom - rows.top);
      bool same = true, same_colours = true, same_hits = true;
      for (int y = 0; y < part.image.height; ++y)
        for (int x = 0; x < width; ++x) {
          const int in_x = region.left + x, in_y = region.top + rows.top + y;
          same = same && std::equal(part.image.pixel(x, y), part.image.pixel(x, y) + 4,
                                    whole.image.pixel(in_x, in_y));
          if (options.colours)
            same_colours = same_colours && std::equal(part.colours.pixel(x, y), part.colours.pixel(x, y) + 4,
                                                      whole.colours.pixel(in_x, in_y));
          if (!options.first_hits) continue;
          const auto at = static_cast<std::size_t>(y * width + x);
          const auto in_whole = static_cast<std::size_t>(in_y * options.width + in_x);
          same_hits = same_hits && part.first_hits.depth[at] == whole.first_hits.depth[in_whole] &&
                      part.first_hits.normal[3 * at] == whole.first_hits.normal[3 * in_whole] &&
                      part.first_hits.object[at] == whole.first_hits.object[in_whole];
        }
      CHECK(same);
      CHECK(same_colours);
      CHECK(same_hits);
    }
  }
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

TEST_CASE("Pictures that are not in memory whole are the same") {
  Scene scene = scene_named("glass and mirrors");
  for (const TestBackend& backend : backends())
    for (int method = 0; method < 3; ++method)
      for (const bool has_more : {false, true}) {
        INFO(backend.spu() << ", method " << method << (has_more ? ", colours and first hits" : ""));
        RenderOptions options = backend.options(kWidth, kHeight, 2);
        options.colours = options.alpha = options.first_hits = has_more;
        scene.camera.kind = has_more ? Camera::Kind::fisheye : Camera::Kind::perspective;
        if (has_more) options.region = PictureRegion{7, 69, 5, kHeight};
        if (method > 0) {
          Antialiasing& antialiasing = options.antialiasing.emplace();
          antialiasing.method = method == 1 ? Antialiasing::Method::fixed : Antialiasing::Method::adaptive;
          antialiasing.threshold = 0.1;
          antialiasing.jitter = 0.7;
        }
        check_rows_at_once(options, scene);
      }
}

TEST_CASE("The last rows of the largest picture are what they are as a region") {
  RenderOptions options;
  options.width = options.height = kMaxImageSide;
  options.spes = 2;
  options.rows_at_once = 32;
  constexpr int kLeft = kMaxImageSide - 40, kTop = kMaxImageSide / 32 * 32;
  Scene scene = scene_named("glass and mirrors");
  // There has to be something in the corner.
  scene.background = Vec3(0.2, 0.5, 0.9);
  const auto last_rows = [&](const PictureRegion& region, int top, int bottom) {
    options.region = region;
    Renderer renderer(options);
    REQUIRE(renderer.prepare(scene));
    return renderer.render_rows(top, bottom).image;
  };
  const Image part = last_rows({kLeft, kMaxImageSide, kTop, kMaxImageSide}, 0, kMaxImageSide - kTop);
  CHECK(part.pixel(39, 30)[3] == 255);
  CHECK(part.pixel(39, 30)[0] + part.pixel(39, 30)[2] > 0);
  CHECK(last_rows({kLeft, kMaxImageSide, 0, kMaxImageSide}, kTop, kMaxImageSide) == part);
}

TEST_CASE("A picture that is too large for memory is rendered by rows only") {
  RenderOptions options;
  options.width = 14043;
  options.height = 9933;
  CHECK_THROWS_WITH(Renderer(options), Catch::Matchers::Contains("14043x9933") &&
                                           Catch::Matchers::Contains("134217728") &&
                                           Catch::Matchers::Contains("rows_at_once"));
  options.rows_at_once = 64;
  Renderer renderer(options);
  const Scene scene = scene_named("glass and mirrors");
  CHECK_THROWS_AS(renderer.render(scene), InputError);
  REQUIRE(renderer.prepare(scene));
  CHECK_THROWS_AS(renderer.render_rows(0, 96), InputError);
  CHECK(renderer.render_rows(9920, 9933).image.height == 13);
  for (const int rows : {-32, 33, 9920}) {
    options.rows_at_once = rows;
    CHECK_THROWS_AS(Renderer(options), InputError);
  }
  options.rows_at_once = 32;
  options.blocks = true;
  CHECK_THROWS_AS(Renderer(options), InputError);
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
