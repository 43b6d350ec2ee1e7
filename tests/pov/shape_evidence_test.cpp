// Shapes of many parts against POV-Ray 3.7: where its trace() finds their surfaces, the normals there, and what
// its inside() says of points. tests/evidence/shapes.json has the numbers, with seven digits.
#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include <nlohmann/json.hpp>

#include "celltrace/image.hpp"
#include "pov/parsing.hpp"

using namespace celltrace;
using test::output;

namespace {

using nlohmann::json;

/// Shapes that are not supported yet.
const char* const kMissing[] = {"ss_", "iso_", "julia_", "param_"};

bool is_missing(const std::string& name) {
  return std::any_of(std::begin(kMissing), std::end(kMissing),
                     [&](const char* start) { return name.rfind(start, 0) == 0; });
}

std::string vector(const json& numbers, std::size_t first) {
  std::ostringstream out;
  out.precision(17);
  out << '<' << numbers[first] << ", " << numbers[first + 1] << ", " << numbers[first + 2] << '>';
  return out.str();
}

/// Returns the pictures of height fields: grey of 16 bits, or the same in red and green.
std::string picture(const json& image, bool is_colour) {
  DeepImage deep(image["w"], image["h"]);
  Image flat(deep.width, deep.height);
  const std::size_t pixels = deep.rgba.size() / 4, width = image["w"];
  for (std::size_t i = 0; i < pixels; ++i) {
    const unsigned height = image["rows_top_to_bottom_16bit"][i / width][i % width];
    for (std::size_t channel = 0; channel < 3; ++channel)
      deep.rgba[4 * i + channel] = static_cast<std::uint16_t>(height);
    flat.rgba[4 * i] = static_cast<std::uint8_t>(height >> 8);
    flat.rgba[4 * i + 1] = static_cast<std::uint8_t>(height);
  }
  FileOptions grey;
  grey.grey = true;
  const std::vector<std::uint8_t> bytes =
      is_colour ? encode_image(flat, ImageFormat::png) : encode_image(deep, ImageFormat::png, grey);
  return {bytes.begin(), bytes.end()};
}

} // namespace

TEST_CASE("trace() and inside() find POV-Ray's numbers for shapes of many parts") {
  std::ifstream file(CELLTRACE_SOURCE_DIR "/tests/evidence/shapes.json");
  const json shapes = json::parse(file);
  ParseOptions options;
  options.file = [&](const std::string& name) -> std::optional<std::string> {
    return picture(shapes["hf_image"], name == "hfrgb.png");
  };
  int compared = 0;
  for (const auto& [name, shape] : shapes.items()) {
    if (is_missing(name) || !shape.contains("rays")) continue;
    INFO(name);
    std::string scene = "#version 3.7; #declare O = object { " + shape["sdl"].get<std::string>() +
                        " } #declare N = <0, 0, 0>;\n";
    for (const json& ray : shape["rays"])
      scene += "#declare N = <0, 0, 0>; #declare P = trace(O, " + vector(ray, 0) + ", " + vector(ray, 3) +
               ", N); #debug concat(vstr(3, P, \" \", 0, 9), \" \", vstr(3, N, \" \", 0, 9), \" \")\n";
    const bool has_points = shape.contains("pts");
    if (has_points)
      for (const json& point : shape["pts"])
        scene += "#debug concat(str(inside(O, " + vector(point, 0) + "), 0, 0), \" \")\n";
    std::istringstream said(output(scene, options));
    for (const json& hit : shape["hit"]) {
      double found[6] = {};
      for (double& number : found)
        said >> number;
      if (hit.is_number()) {
        CHECK((found[3] == 0 && found[4] == 0 && found[5] == 0));
        continue;
      }
      // POV-Ray's polynomials are solved to 1e-7 relative to coordinates of about 5. Normals of smooth height
      // fields are blended over a triangle here, and over four points there.
      const bool is_smooth = name == "hf_smooth";
      for (std::size_t i = 0; i < 6; ++i)
        CHECK(found[i] == Approx(hit[i].get<double>()).margin(is_smooth && i >= 3 ? 0.2 : 1e-6));
      ++compared;
    }
    if (has_points)
      for (const json& is_inside : shape["in"]) {
        int found = -1;
        said >> found;
        CHECK(found == is_inside.get<int>());
      }
  }
  CHECK(compared > 80);
}
