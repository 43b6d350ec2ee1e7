// What is said of a picture's progress while it is rendered.
#include "celltrace/pov.hpp"
#include "cli/band_height.hpp"
#include "cli/partial_picture.hpp"
#include "cli/row_costs.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::cli;

namespace {

/// Nothing but sky in its upper half, and mirrors in each other below.
const char* const kHalfSky = R"(
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 10 }
background { rgb <0.3, 0.5, 0.8> }
camera { location <0, 1, 0> direction z up y right 4/3*x }
light_source { <-10, 20, -10> rgb 1 area_light 4*x, 4*z, 5, 5 }
plane { y, 0 pigment { marble turbulence 1 } finish { reflection 0.5 } }
#for (I, -6, 6) #for (J, 1, 12)
  sphere { <I, 0.3, J>, 0.45 pigment { marble turbulence 1 } finish { reflection 0.7 } }
#end #end
)";

/// The machine that tests run on may have much else to do.
constexpr std::chrono::seconds kPatient(600);

RenderOptions options_of(int width, int height) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.spes = 2;
  return options;
}

} // namespace

TEST_CASE("rows take their parts' share") {
  const RowCosts alike(100);
  CHECK(!alike.are_measured());
  CHECK(alike.above(0) == 0);
  CHECK(alike.above(25) == Approx(0.25));
  CHECK(alike.above(100) == 1);
  CHECK(alike.rows_with(0.5, 30) == Approx(50));
  CHECK(alike.rows_with(0.9, 30) == Approx(70));

  const RowCosts costs(100, {0, 1, 3, 0});
  CHECK(costs.are_measured());
  CHECK(costs.above(25) == Approx(0).margin(0.001));
  CHECK(costs.above(50) == Approx(0.25).margin(0.001));
  CHECK(costs.of(50, 75) == Approx(0.75).margin(0.001));
  CHECK(costs.above(75) < costs.above(100));
  CHECK(costs.above(100) == 1);
  CHECK(costs.rows_with(0.25, 0) == Approx(50).margin(0.2));
  CHECK(costs.rows_with(0.375, 50) == Approx(12.5).margin(0.2));
  CHECK(costs.rows_with(1, 50) == 50);

  const RowCosts nothing(10, {0, 0});
  CHECK(nothing.above(5) == Approx(0.5));
}

TEST_CASE("a small picture says what rows of the large one take") {
  const Scene scene = parse_string(kHalfSky);
  for (const bool antialiased : {false, true}) {
    CAPTURE(antialiased);
    RenderOptions options = options_of(1600, 1200);
    if (antialiased) options.antialiasing.emplace();
    Renderer renderer(options);
    REQUIRE(renderer.prepare(scene));
    std::optional<RenderStatistics> preparation;
    const RowCosts costs = measured_costs(renderer, options, {}, preparation, kPatient);
    REQUIRE(costs.are_measured());
    REQUIRE(preparation);
    CHECK(preparation->preparation == RenderStatistics::Preparation::built);
    // By rows half of the picture would be done.
    CHECK(costs.above(500) < 0.1);
    CHECK(costs.above(1100) > 0.7);
  }
}

TEST_CASE("measuring leaves the picture and a region as they are") {
  const Scene scene = parse_string(kHalfSky);
  RenderOptions options = options_of(640, 480);
  options.region = PictureRegion{100, 500, 200, 480};
  Renderer renderer(options), other(options);
  REQUIRE(renderer.prepare(scene));
  std::optional<RenderStatistics> preparation;
  CHECK(!measured_costs(renderer, options, {}, preparation, kPatient).are_measured()); // it is too small
  options.region = PictureRegion{100, 500, 0, 400};
  options.width = 1000;
  options.height = 1000;
  renderer.set_picture(options);
  CHECK(!measured_costs(renderer, options, {}, preparation, kPatient).are_measured()); // narrow as well
  options.region = PictureRegion{100, 900, 100, 1000};
  renderer.set_picture(options);
  other.set_picture(options);
  const RowCosts costs = measured_costs(renderer, options, {}, preparation, kPatient);
  REQUIRE(costs.are_measured());
  CHECK(costs.above(350) < 0.1);
  REQUIRE(other.prepare(scene));
  const Image a = renderer.render_rows(0, 900).image, b = other.render_rows(0, 900).image;
  CHECK(a.rgba == b.rgba);
}

TEST_CASE("what is broken off is not measured") {
  const Scene scene = parse_string(kHalfSky);
  const RenderOptions options = options_of(1600, 1200);
  Renderer renderer(options);
  REQUIRE(renderer.prepare(scene));
  std::optional<RenderStatistics> preparation;
  CHECK(!measured_costs(
             renderer, options, [](double) { return false; }, preparation)
             .are_measured());
  CHECK(!measured_costs(renderer, options, {}, preparation, std::chrono::seconds(0)).are_measured());
  RenderOptions emulated = options;
  emulated.backend = Backend::cell_emu;
  CHECK(!measured_costs(renderer, emulated, {}, preparation).are_measured());
}

TEST_CASE("bands take some seconds by what is known of their rows") {
  RenderOptions options = options_of(1600, 1200);
  const RowCosts costs(1200, {0, 0, 1, 1});
  BandHeight bands(options, costs);
  CHECK(bands.of(0, 1200) == 704); // an eighth of the cost is at 675
  bands.learn(0, 704, 1);
  CHECK(bands.of(704, 496) == 496);
  bands.learn(0, 704, 100); // of some 600 s
  CHECK(bands.of(704, 496) == Renderer::kRowStep);

  options.antialiasing.emplace();
  BandHeight antialiased(options, costs);
  antialiased.learn(0, 704, 1); // some 6 s in all: an eighth is lost at most
  CHECK(antialiased.of(704, 496) == 96);
  antialiased.learn(0, 704, 0.01);
  CHECK(antialiased.of(704, 496) == 496);
  BandHeight unknown(options, RowCosts(1200));
  CHECK(unknown.of(0, 1200) == 160);
  unknown.learn(0, 160, 1);
  CHECK(unknown.of(160, 1040) == 1040);
}

TEST_CASE("an interrupted picture has what was said to be done, but for a band") {
  const Scene scene = parse_string(kHalfSky);
  RenderOptions options = options_of(1600, 1200);
  options.antialiasing.emplace();
  options.antialiasing->threshold = 0.05;
  options.antialiasing->depth = 4;
  Renderer renderer(options);
  REQUIRE(renderer.prepare(scene));
  std::optional<RenderStatistics> preparation;
  const RowCosts costs = measured_costs(renderer, options, {}, preparation, kPatient);
  PartialPicture picture(options);
  double last = 0;
  const auto until = [&](double end) {
    return [&last, end](double fraction) {
      CHECK(fraction >= last);
      last = fraction;
      return fraction < end;
    };
  };
  CHECK(!render_remaining(renderer, options, picture, costs, until(0.64), [] {}).complete);
  const double kept = picture.finished_share(costs);
  CHECK(kept > last - 0.2);
  CHECK(kept <= last);
  // It goes on from there.
  last = kept - 1e-9;
  CHECK(render_remaining(renderer, options, picture, costs, until(2), [] {}).complete);
  CHECK(picture.finished_share(costs) == Approx(1));
}
