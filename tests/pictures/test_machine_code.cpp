// The tracer as the real SPU's compiler makes it, on simulated SPUs, beside native.
#include "picture_files.hpp"

#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

using namespace celltrace;
using celltrace::test::scenes_in;

namespace {

RenderOptions simulated(unsigned spes, int width = 160) {
  RenderOptions options;
  options.width = width;
  options.height = width * 3 / 4;
  options.backend = Backend::cell_sim;
  options.spes = spes;
  options.emulation.schedule = Schedule::lockstep;
  return options;
}

Image native_picture(const Scene& scene, int width) {
  RenderOptions options = simulated(0, width);
  options.backend = Backend::native;
  options.emulation = {};
  return render(scene, options).image;
}

using Sizes = std::vector<std::pair<unsigned, int>>; // SPEs and pixels a row

// Smaller where there are few: simulating takes the time of a core whatever their number.
const Sizes kSmall{{1, 24}, {2, 32}, {8, 48}}, kLarge{{1, 72}, {2, 72}, {8, 160}};

void check_scene(const std::filesystem::path& path, const Sizes& sizes) {
  INFO(path.filename().string());
  const Scene scene = parse_file(path);
  for (const auto& [spes, width] : sizes) {
    INFO(spes << " SPEs");
    const Image expected = native_picture(scene, width);
    const RenderResult result = render(scene, simulated(spes, width));
    REQUIRE(result.complete);
    CHECK(result.statistics.backend == Backend::cell_sim);
    CHECK(result.statistics.spes.size() == spes);
    CHECK(result.statistics.diagnostics.empty());
    const Comparison comparison = compare_images(result.image, expected);
    INFO(to_text(comparison));
    CHECK(comparison.psnr >= 50);
  }
}

/// False, and a word about it, where this build has no machine code.
bool has_machine_code() {
  try {
    render(parse_file(std::filesystem::path(OWN_SCENES) / "orthographic.pov"), simulated(1));
    return true;
  } catch (const SpeError& error) {
    if (std::string_view(error.what()).find("no machine code") == std::string_view::npos) throw;
    WARN("skipped: " << error.what());
    return false;
  }
}

} // namespace

TEST_CASE("The SPU's machine code renders the project's scenes") {
  if (!has_machine_code()) return;
  for (const auto& path : scenes_in(OWN_SCENES))
    check_scene(path, kSmall);
}

TEST_CASE("The SPU's machine code renders the project's scenes in large", "[.all]") {
  if (!has_machine_code()) return;
  for (const auto& path : scenes_in(OWN_SCENES))
    check_scene(path, kLarge);
}

TEST_CASE("The frame that takes the most local store renders by machine code") {
  if (!has_machine_code()) return;
  // Lights with an area, shadow rays that are walked, patterns that ask for the surface, and samples.
  const Scene scene = parse_string(R"(
    #version 3.7;
    global_settings { assumed_gamma 1 }
    camera { location <0, 1, -5> look_at 0 }
    light_source { <5, 8, -5> rgb 1 area_light <1, 0, 0>, <0, 1, 0>, 4, 4 adaptive 1 }
    plane { y, -1 pigment { slope { y } color_map { [0 rgb 1] [1 rgb 0.2] } } }
    sphere {
      0, 1
      pigment { rgbf <1, 0.8, 0.8, 0.9> } finish { reflection 0.1 } normal { bumps 0.3 }
      interior { ior 1.5 fade_distance 1 fade_power 1001 fade_color <0.9, 0.2, 0.2> }
    })");
  RenderOptions options = simulated(1, 32);
  options.antialiasing.emplace();
  const RenderResult result = render(scene, options);
  REQUIRE(result.complete);
  CHECK(result.statistics.diagnostics.empty());
  options.backend = Backend::native;
  options.emulation = {};
  const Comparison comparison = compare_images(result.image, render(scene, options).image);
  INFO(to_text(comparison));
  CHECK(comparison.psnr >= 50);
}

TEST_CASE("The SPU's machine code renders published scenes") {
  if (!has_machine_code()) return;
  const std::filesystem::path folder = PUBLISHED_SCENES;
  if (scenes_in(folder).empty()) {
    WARN("skipped: no scenes beside the checkout");
    return;
  }
  for (const char* scene : {"crystal.pov", "jncraton_dish.pov", "forste_egg.pov"})
    check_scene(folder / scene, kSmall);
}

TEST_CASE("The SPU's machine code renders all published scenes", "[.all]") {
  const auto scenes = scenes_in(PUBLISHED_SCENES);
  REQUIRE(scenes.size() == 10);
  for (const auto& path : scenes)
    check_scene(path, kLarge);
}

// One of the exceptions in docs/differences-between-backends.md.
TEST_CASE("The SPU's rounding picks one or the other of two surfaces in one place") {
  if (!has_machine_code()) return;
  const Scene scene = parse_string(R"(
    camera { location <0, 3, -9> look_at 0 angle 48 }
    #default { finish { ambient 1 diffuse 0 } }
    triangle { <-9, 0, -9>, <9, 0, -9>, <0, 0, 9> pigment { color rgb x } }
    triangle { <-8, 0, -8>, <8, 0, -9>, <1, 0, 9> pigment { color rgb y } })");
  const Image expected = native_picture(scene, 160), picture = render(scene, simulated(2)).image;
  const auto pixel = [](const Image& image, std::size_t i) {
    return std::array{image.rgba[4 * i], image.rgba[4 * i + 1], image.rgba[4 * i + 2]};
  };
  std::set<std::array<std::uint8_t, 3>> colours;
  const std::size_t pixels = picture.rgba.size() / 4;
  for (std::size_t i = 0; i < pixels; ++i)
    colours.insert(pixel(expected, i));
  REQUIRE(colours.size() == 3); // of both triangles and the background
  std::size_t others = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    CHECK(colours.count(pixel(picture, i)) == 1);
    others += pixel(picture, i) != pixel(expected, i);
  }
  CHECK(others > pixels / 20);
  CHECK(others < pixels / 3);
}

TEST_CASE("Runs of machine code repeat to the last cycle") {
  if (!has_machine_code()) return;
  const Scene scene = parse_file(std::filesystem::path(OWN_SCENES) / "finishes.pov");
  const auto run = [&] {
    std::ostringstream trace;
    RenderOptions options = simulated(3);
    options.width = 64;
    options.height = 48;
    options.emulation.trace = &trace;
    const RenderResult result = render(scene, options);
    return std::tuple(result.statistics.render_cycles, result.image.rgba, trace.str());
  };
  const auto first = run();
  CHECK(std::get<0>(first) > 1000000);
  CHECK((first == run()));
}
