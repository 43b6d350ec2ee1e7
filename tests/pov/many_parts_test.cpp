// Prisms, lathes, sors, blobs, polynomials, texts, height fields and pictures as they are written.
#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>

#include "celltrace/image.hpp"
#include "pov/parsing.hpp"

using namespace celltrace;
using test::error_line;
using test::output;
using test::parse;

namespace {

template <class Shape> Shape only(const Scene& scene) {
  REQUIRE(scene.objects.size() == 1);
  return *std::get<std::shared_ptr<const Shape>>(scene.objects[0].shape);
}

/// A picture of one row: black, red and half clear green.
std::string png() {
  Image image(3, 1);
  const std::uint8_t pixels[] = {0, 0, 0, 255, 255, 0, 0, 255, 0, 255, 0, 128};
  image.rgba.assign(std::begin(pixels), std::end(pixels));
  const std::vector<std::uint8_t> bytes = encode_image(image, ImageFormat::png);
  return {bytes.begin(), bytes.end()};
}

ParseOptions with_picture() {
  ParseOptions options;
  options.file = [](const std::string& name) -> std::optional<std::string> {
    if (name == "a.png") return png();
    if (name == "cut.png") return png().substr(0, 60);
    if (name == "no.png") return "this is text";
    return std::nullopt;
  };
  return options;
}

const char* const kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

} // namespace

TEST_CASE("prisms have loops, and heights in any order") {
  const Prism prism = only<Prism>(parse("prism { linear_sweep linear_spline 2, -1, 10, <0,0>, <4,0>, <4,4>, <0,4>, <0,0>, "
                                        "<1,1>, <2,1>, <2,2>, <1,2>, <1,1> open }"));
  CHECK(prism.bottom == -1);
  CHECK(prism.top == 2);
  CHECK(prism.open);
  CHECK_FALSE(prism.is_conic);
  CHECK(prism.outline.size() == 8);
  CHECK(only<Prism>(parse("prism { conic_sweep 0, 1, 4, <0,0>, <1,0>, <1,1>, <0,0> }")).is_conic);
  // A line is added to a linear prism that is not closed; others show nothing.
  CHECK(only<Prism>(parse("prism { 0, 1, 3, <0,0>, <1,0>, <1,1> }")).outline.size() == 3);
  CHECK(parse("prism { cubic_spline 0, 1, 6, <0,0>, <1,0>, <1,1>, <2,2>, <3,2>, <3,0> }").objects.empty());
  CHECK(error_line("prism { 0, 1, 5, <0,0>, <1,0>, <1,1>, <0,0> }") ==
        "scene.pov:1:1: error: this prism does not have as many points as it says");
  CHECK(error_line("prism { cubic_spline 0, 1, 5, <0,0>, <1,0>, <1,1>, <0,0>, <0,0> }") ==
        "scene.pov:1:1: error: a prism with a cubic_spline has at least 6 points");
  CHECK(error_line("prism { b_spline 0, 1, 4, <0,0>, <1,0>, <1,1>, <0,0> }") ==
        "scene.pov:1:1: error: a prism has no b_spline");
  CHECK(error_line("sphere { linear_spline 0, 1 }") ==
        "scene.pov:1:1: error: a sphere does not begin with a kind of curve or sweep");
}

TEST_CASE("lathes and sors are right of their axis") {
  CHECK(only<Lathe>(parse("lathe { 3, <0,0>, <1,1>, <0,2> }")).curve.size() == 2);
  CHECK(only<Lathe>(parse("lathe { cubic_spline 4, <0,0>, <1,1>, <1,2>, <0,3> sturm }")).curve.size() == 1);
  CHECK(error_line("lathe { 3, <0,0>, <-1,1>, <0,2> }") ==
        "scene.pov:1:1: error: the points of a lathe are not left of its axis: their first component is not below 0");
  CHECK(error_line("lathe { bezier_spline 3, <0,0>, <1,1>, <0,2> }") ==
        "scene.pov:1:1: error: a lathe with a bezier_spline has four points for each of its curves");
  CHECK(only<SurfaceOfRevolution>(parse("sor { 4, <0,0>, <1,1>, <1,2>, <0,3> open }")).open);
  CHECK(error_line("sor { 3, <0,0>, <1,1>, <1,2> }") == "scene.pov:1:1: error: a sor has at least four points");
  CHECK(error_line("sor { 4, <0,0>, <1,2>, <1,1>, <0,3> }") ==
        "scene.pov:1:1: error: the points of a sor, but for the first and the last, go upward");
}

TEST_CASE("blobs have components of two forms") {
  const Blob blob = only<Blob>(parse("blob { threshold 0.5 sphere { x, 2, 3 translate y } component 4, 5, <6, 7, 8>\n"
                                     "cylinder { x, y, 0.5, strength -2 } sphere { 0, 1 } hierarchy off }"));
  CHECK(blob.threshold == 0.5);
  REQUIRE(blob.components.size() == 4);
  CHECK(blob.components[0].strength == 3);
  CHECK(blob.components[0].transform.rows[3] == Vec3(0, 1, 0));
  CHECK(blob.components[1].strength == 4);
  CHECK(blob.components[1].radius == 5);
  CHECK(blob.components[1].a == Vec3(6, 7, 8));
  CHECK(blob.components[2].strength == -2);
  CHECK(blob.components[2].b == Vec3(0, 1, 0));
  CHECK(blob.components[3].strength == 1);
  CHECK(error_line("blob { threshold 1 }") == "scene.pov:1:1: error: a blob has at least one component");
  CHECK(error_line("blob { box { 0, 1 } }") ==
        "scene.pov:1:8: error: a component of a blob is a sphere or a cylinder");
  CHECK(error_line("blob { sphere { 0, 1 pigment { rgb 1 } } }") ==
        "scene.pov:1:8: error: a texture of a blob's component is not supported yet");
  CHECK(error_line("sphere { 0, 1 strength 2 }") ==
        "scene.pov:1:15: error: only a component of a blob has 'strength'");
}

TEST_CASE("polynomials have all their coefficients") {
  const std::string ten = "<1, 0, 0, 0, 1, 0, 0, 1, 0, -1>";
  CHECK(only<Polynomial>(parse("poly { 2, " + ten + " }")).coefficients.size() == 10);
  CHECK(only<Polynomial>(parse("cubic { <0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1> }")).degree == 3);
  CHECK(error_line("poly { 3, " + ten + " }") ==
        "scene.pov:1:1: error: a polynomial of degree 3 has 20 coefficients, found 10");
  CHECK(error_line("poly { 36, " + ten + " }") == "scene.pov:1:1: error: the degree of a poly is 2 to 35");
  CHECK(error_line("quartic { " + ten + " }") ==
        "scene.pov:1:1: error: a polynomial of degree 4 has 35 coefficients, found 10");
}

TEST_CASE("a text is a row of glyphs") {
  if (!std::filesystem::exists(kFont)) {
    WARN("skipped: DejaVu Sans is not installed");
    return;
  }
  ParseOptions options;
  options.readable_folders = {std::filesystem::path(kFont).parent_path()};
  const auto text = [&](const std::string& string) {
    return std::string("text { ttf \"") + kFont + "\" \"" + string + "\" 0.5, 0 }";
  };
  const Scene scene = parse(text("a bab"), options);
  REQUIRE(scene.objects.size() == 4); // a space has no surface
  const auto prism = [&](std::size_t i) { return std::get<std::shared_ptr<const Prism>>(scene.objects[i].shape); };
  CHECK(prism(0) == prism(2)); // glyphs are shared
  CHECK(prism(1) == prism(3));
  CHECK(prism(0)->top == 0.5);
  CHECK(scene.objects[0].transform.rows[3].x < scene.objects[1].transform.rows[3].x);
  CHECK(error_line("text { ttf \"nowhere.ttf\" \"a\" 1, 0 }") ==
        "scene.pov:1:1: error: cannot find the font 'nowhere.ttf'");
  ParseOptions wrong;
  wrong.file = [](const std::string&) { return std::optional<std::string>("this is text"); };
  CHECK(error_line("text { ttf \"a.ttf\" \"a\" 1, 0 }", wrong) ==
        "scene.pov:1:1: error: font 'a.ttf': this is no font with outlines");
}

TEST_CASE("height fields are meshes in the unit cube") {
  const std::string field = "height_field { function 3, 4 { x/2 } ";
  const Mesh mesh = only<Mesh>(parse(field + "}"));
  CHECK(mesh.vertices.size() == 12);
  CHECK(mesh.triangles.size() == 12);
  CHECK(mesh.has_inside());
  CHECK(only<Mesh>(parse(field + "smooth }")).normals.size() == 12);
  CHECK(only<Mesh>(parse(field + "water_level 0.3 }")).triangles.size() < 12);
  CHECK(error_line("height_field { function 1, 4 { x } }") ==
        "scene.pov:1:16: error: a height_field has 2 to 65535 columns and rows, and at most 16,777,216 points");
  CHECK(error_line("height_field { function 9000, 9000 { x } }") ==
        "scene.pov:1:16: error: a height_field has 2 to 65535 columns and rows, and at most 16,777,216 points");
  CHECK(error_line("height_field { png \"none.png\" }") ==
        "scene.pov:1:20: error: cannot find the picture 'none.png'");
}

TEST_CASE("pictures are pigments and patterns") {
  const auto pigment = [](const std::string& text) {
    const Scene scene = parse("sphere { 0, 1 pigment { " + text + " } }", with_picture());
    return scene.materials.at(scene.objects.at(0).material).pigment;
  };
  const Pigment map = pigment("image_map { png \"a.png\" map_type 1 interpolate 2 once transmit all 0.25 }");
  REQUIRE(map.map);
  const auto& image = std::get<pattern::ImageMap>(map.map->pattern.kind).map;
  CHECK(image.mapping == 1);
  CHECK(image.interpolation == 2);
  CHECK(image.once);
  CHECK(image.transmit == 0.25);
  REQUIRE(image.picture->texels.size() == 3);
  CHECK(image.picture->texels[1][0] == 65535);
  CHECK(image.picture->texels[1][3] == 0);
  CHECK(image.picture->texels[2][3] == Approx(65535 * (1 - 128 / 255.0)).margin(1));
  const Pigment grey = pigment("image_pattern { \"a.png\" use_alpha } color_map { [0 rgb 0] [1 rgb 1] }");
  CHECK(std::get<pattern::ImageGrey>(grey.map->pattern.kind).is_transmittance);
  const auto refused = [](const std::string& options) {
    return error_line("sphere { 0, 1 pigment { image_map { " + options + " } } }", with_picture());
  };
  CHECK(refused("png \"no.png\"").ends_with("picture 'no.png' is in no picture format that celltrace reads") ==
        refused("png \"no.png\"").ends_with("reads"));
  CHECK_FALSE(refused("png \"cut.png\"").empty());
  CHECK(refused("map_type 2") == "scene.pov:1:25: error: a picture needs the name of its file");
  CHECK(refused("png \"a.png\" map_type 3") == "scene.pov:1:49: error: the map_type of a picture is 0, 1, 2 or 5");
  CHECK(refused("png \"a.png\" transmit 3, 0.5") ==
        "scene.pov:1:41: error: picture 'a.png' has no palette with a colour 3");
}
