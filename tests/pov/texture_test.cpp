// Pigments, finishes, textures, interiors, materials.
#include <catch2/catch.hpp>

#include "pov/parsing.hpp"

using namespace celltrace;
using test::error_line;
using test::material;
using test::parse;

namespace {

Finish finish(const std::string& items) {
  return material("finish { " + items + " }").finish;
}

double ior(const std::string& modifiers) {
  const Scene scene = parse("sphere { 0, 1 " + modifiers + " }");
  return scene.interiors.at(scene.objects.at(0).interior).ior;
}

} // namespace

TEST_CASE("an object without a texture is black with the default finish") {
  const Material m = material("");
  CHECK(m.pigment.rgb == Vec3(0, 0, 0));
  CHECK(m.finish.ambient == Vec3(0.1, 0.1, 0.1));
  CHECK(m.finish.diffuse == 0.6);
}

TEST_CASE("pigments") {
  const Pigment p = material("pigment { color rgbft <1, 2, 3, 0.4, 0.5> quick_color rgb 1 scale 2 }").pigment;
  CHECK(p.rgb == Vec3(1, 2, 3));
  CHECK(p.filter == 0.4);
  CHECK(p.transmit == 0.5);
  const Pigment q = material("pigment { rgb <1, 0, 0> filter 0.25 transmit 0.5 }").pigment;
  CHECK(q.rgb == Vec3(1, 0, 0));
  CHECK(q.filter == 0.25);
  CHECK(q.transmit == 0.5);
  const Scene named =
      parse("#declare Red = rgb <1, 0, 0>; #declare P = pigment { Red } sphere { 0, 1 pigment { P } }"
            "sphere { 0, 1 pigment { color Red filter 0.5 } }");
  CHECK(named.materials.at(0).pigment.rgb == Vec3(1, 0, 0));
  CHECK(named.materials.at(1).pigment.filter == 0.5);
  // Colours may be whole expressions without brackets.
  CHECK(material("pigment { rgb 1 ? <1, 2, 3> : 0 transmit 0.5 }").pigment.rgb == Vec3(1, 2, 3));
  CHECK(material("pigment { color 0 ? 1 : (2 > 1) ? <4, 5, 6> : 0 }").pigment.rgb == Vec3(4, 5, 6));
  CHECK(material("finish { ambient 0 ? 1 : 0.5 }").finish.ambient == Vec3(0.5));
  CHECK(error_line("light_source { (1 > 0) ? x : y, 1 }").find("unexpected '?'") != std::string::npos);
}

TEST_CASE("colours in sRGB") {
  const auto colour = [](const std::string& gamma, const std::string& written) {
    return parse("global_settings { assumed_gamma " + gamma + " } sphere { 0, 1 pigment { " + written +
                 " } }")
        .materials.at(0)
        .pigment;
  };
  const Pigment linear = colour("1", "srgb <.5, .25, .75>");
  CHECK(linear.rgb.x == Approx(0.214041).epsilon(1e-5));
  CHECK(linear.rgb.y == Approx(0.050876).epsilon(1e-5));
  CHECK(linear.rgb.z == Approx(0.522522).epsilon(1e-5));
  CHECK(colour("2.2", "color srgb 0.5").rgb.x == Approx(0.496227).epsilon(1e-5));
  CHECK(colour("srgb", "srgb 0.5").rgb.x == 0.5);
  CHECK(colour("1", "srgb <-.5, 0, 0>").rgb.x == Approx(-0.0387).epsilon(1e-4));
  const Pigment both = colour("1", "srgbft <.5, .5, .5, .25, .75>");
  CHECK(both.filter == 0.25);
  CHECK(both.transmit == 0.75);
  CHECK(colour("1", "srgbt <.5, .5, .5, .25>").transmit == 0.25);
  CHECK(colour("1", "srgbf <.5, .5, .5, .25> transmit 0.5").filter == 0.25);
  CHECK(error_line("sphere { 0, 1 pigment { srgb 1 } }") ==
        "scene.pov:1:25: error: colours in sRGB need an 'assumed_gamma' in front of them");
}

TEST_CASE("every item of a finish") {
  const Finish f =
      finish("ambient rgb <.1, .2, .3> emission 0.5 diffuse 0.7 brilliance 2 phong 0.8 phong_size 60 "
             "specular 0.4 roughness 0.01 metallic conserve_energy crand 0.2 irid { 0.3 thickness 1.5 "
             "turbulence 0.4 }");
  CHECK(f.ambient == Vec3(.1, .2, .3));
  CHECK(f.emission == Vec3(.5, .5, .5));
  CHECK(f.diffuse == 0.7);
  CHECK(f.brilliance == 2);
  CHECK(f.phong == 0.8);
  CHECK(f.phong_size == 60);
  CHECK(f.specular == 0.4);
  CHECK(f.roughness == 0.01);
  CHECK(f.metallic == 1);
  CHECK(f.conserve_energy);
  CHECK(f.crand == 0.2);
  CHECK(f.irid == 0.3);
  CHECK(f.irid_thickness == 1.5);
  CHECK(f.irid_turbulence == 0.4);
  CHECK(finish("metallic 0.3").metallic == 0.3);
  CHECK_FALSE(finish("conserve_energy off").conserve_energy);
}

TEST_CASE("light that falls on the other side, and albedos") {
  CHECK(finish("diffuse 0.5").diffuse_behind == 0);
  CHECK(finish("diffuse 0.5, 0.3").diffuse_behind == 0.3);
  CHECK(finish("diffuse 0.5, reflection 0.3").diffuse_behind == 0);
  CHECK(finish("diffuse 0.5 0.3 brilliance 2").diffuse_behind == 0.3);
  CHECK(finish("diffuse 0.5, 0.3 diffuse 0.4").diffuse_behind == 0);
  // In whatever order they are said.
  const Finish f =
      finish("diffuse albedo 0.5, 0.2 brilliance 3 phong albedo 0.01 phong_size 19 specular albedo 0.1 "
             "roughness 0.1");
  CHECK(f.diffuse == 1);
  CHECK(f.diffuse_behind == 0.4);
  CHECK(f.phong == Approx(0.1));
  CHECK(f.specular == Approx(0.1 * 12 / 7.875));
  CHECK(finish("roughness 1 specular albedo 0.01").specular == Approx(0.0058).epsilon(1e-3));
  CHECK(finish("brilliance 3 diffuse albedo 0.2 diffuse 0.5").diffuse == 1);
  // What has a name is settled.
  const Scene scene =
      parse("#declare F = finish { diffuse albedo 0.5 } sphere { 0, 1 finish { F brilliance 3 } }");
  CHECK(scene.materials.at(scene.objects.at(0).material).finish.diffuse == 0.5);
}

TEST_CASE("reflection, old and new form") {
  Finish f = finish("reflection 0.3 reflection_exponent 2");
  CHECK(f.reflection_min == Vec3(.3, .3, .3));
  CHECK(f.reflection_max == Vec3(.3, .3, .3));
  CHECK(f.reflection_exponent == 2);
  f = finish("reflection { rgb 0.1, rgb <1, .5, 0> falloff 3 exponent 0.5 metallic }");
  CHECK(f.reflection_min == Vec3(.1, .1, .1));
  CHECK(f.reflection_max == Vec3(1, .5, 0));
  CHECK(f.reflection_falloff == 3);
  CHECK(f.reflection_exponent == 0.5);
  CHECK(f.reflection_metallic == 1);
  CHECK(f.metallic == 0);
  f = finish("reflection { 0.4 }");
  CHECK(f.reflection_min == Vec3(.4, .4, .4));
  f = finish("reflection { 0.9 fresnel on }");
  CHECK(f.reflection_min == Vec3(0, 0, 0));
  CHECK(f.reflection_max == Vec3(.9, .9, .9));
  CHECK(f.reflection_fresnel);
  // A comma behind the first colour need not have a second one behind it.
  f = finish("reflection { 0.4, metallic }");
  CHECK(f.reflection_min == Vec3(.4, .4, .4));
  CHECK(f.reflection_metallic == 1);
  CHECK(finish("reflection { 0.4, fresnel on }").reflection_min == Vec3(0));
  CHECK(finish("reflection { 0.4, }").reflection_max == Vec3(0.4));
  CHECK_FALSE(error_line("sphere { 0, 1 finish { reflection { 0.4, 0.5, } } }").empty());
}

TEST_CASE("a reflection keeps what it does not say") {
  const std::string before =
      "#default { finish { reflection { 0, 1 falloff 3 exponent 0.5 metallic fresnel } } } ";
  const auto finish_of = [&](const std::string& reflection) {
    return parse(before + "sphere { 0, 1 finish { reflection { " + reflection + " } } }").materials[0].finish;
  };
  const Finish kept = finish_of("0.2, 0.5");
  CHECK(kept.reflection_min == Vec3(0.2));
  CHECK(kept.reflection_falloff == 3);
  CHECK(kept.reflection_exponent == 0.5);
  CHECK(kept.reflection_metallic == 1);
  CHECK(kept.reflection_fresnel);
  CHECK(finish_of("0.5").reflection_min == Vec3(0.5));
  const Finish replaced = finish_of("0.5 falloff 1 metallic 0 fresnel off");
  CHECK(replaced.reflection_falloff == 1);
  CHECK(replaced.reflection_metallic == 0);
  CHECK_FALSE(replaced.reflection_fresnel);
}

TEST_CASE("textures build on one another") {
  const Scene scene =
      parse("#declare F = finish { phong 1 } #declare T = texture { pigment { rgb 0.5 } finish { F } }"
            "#declare U = texture { T finish { F ambient 0 } } sphere { 0, 1 texture { T } }"
            "sphere { 0, 1 texture { U } } object { sphere { 0, 1 texture { U } } pigment { rgb 1 } }");
  REQUIRE(scene.materials.size() == 3);
  CHECK(scene.materials[0].finish.phong == 1);
  CHECK(scene.materials[0].finish.ambient.x == 0.1);
  CHECK(scene.materials[1].finish.ambient.x == 0);
  CHECK(scene.materials[1].pigment.rgb.x == 0.5);
  CHECK(scene.materials[2].pigment.rgb.x == 1);
  CHECK(scene.materials[2].finish.phong == 1);
}

TEST_CASE("a pigment or finish changes what the object already has") {
  const Material m =
      material("finish { phong 1 } pigment { rgb 0.5 } finish { ambient 1 } pigment { quick_color rgb 1 }");
  CHECK(m.finish.phong == 1);
  CHECK(m.finish.ambient.x == 1);
  CHECK(m.pigment.rgb.x == 0.5);
  const Scene scene = parse("#declare T = texture { pigment { rgb 0.5 } finish { phong 1 } } "
                            "sphere { 0, 1 texture { T finish { ambient 1 } } }");
  CHECK(scene.materials.at(0).finish.phong == 1);
  CHECK(scene.materials.at(0).finish.ambient.x == 1);
}

TEST_CASE("a pigment that a plain one has been moved for is moved") {
  const auto space = [](const std::string& scene) {
    const Scene parsed = parse(scene);
    return parsed.materials.at(parsed.objects.at(0).material).pigment.map->pattern.space;
  };
  const std::string declared = "#declare T = texture { pigment { rgb 1 } scale 2 } "
                               "#declare S = sphere { 0, 1 pigment { rgb 1 } scale 2 } "
                               "#declare U = union { sphere { 0, 1 } pigment { rgb 1 } scale 2 } "
                               "#declare M = material { texture { pigment { rgb 1 } } scale 2 } ";
  for (const std::string object :
       {"sphere { 0, 1 pigment { rgb 1 } scale 2 pigment { checker } scale 3 }",
        "sphere { 0, 1 scale 7 pigment { rgb 1 } scale 2 pigment { rgb 0 } pigment { checker } scale 3 }",
        "sphere { 0, 1 texture { pigment { rgb 1 } scale 2 pigment { checker } } scale 3 }",
        "sphere { 0, 1 texture { T } pigment { checker } scale 3 }",
        "sphere { 0, 1 texture { T pigment { checker } scale 3 } }",
        "object { S pigment { checker } scale 3 }", "object { U pigment { checker } scale 3 }",
        "sphere { 0, 1 material { M } pigment { checker } scale 3 }"}) {
    INFO(object);
    const auto steps = space(declared + object);
    REQUIRE(steps.size() == 1);
    CHECK(std::get<Transform>(steps[0]).point({1, 1, 1}) == Vec3(6));
  }
  CHECK(
      space("#default { texture { pigment { rgb 1 } scale 2 } } sphere { 0, 1 scale 3 pigment { checker } }")
          .size() == 1);
  // Without a pigment of its own it has not been moved, and surface coordinates do not move.
  CHECK(space("sphere { 0, 1 scale 2 pigment { checker } }").empty());
  CHECK(space("sphere { 0, 1 uv_mapping pigment { rgb 1 } scale 2 pigment { checker } }").empty());
}

TEST_CASE("a plain texture that is moved stays one material") {
  const std::string declared = "#declare P = texture { pigment { rgb 1 } finish { phong 1 } } ";
  CHECK(parse(declared +
              "sphere { 0, 1 texture { P } scale 2 } sphere { 0, 1 texture { P } translate x } "
              "sphere { 0, 1 texture { P scale 3 } } sphere { 0, 1 texture { P scale 3 rotate x } } "
              "union { sphere { 0, 1 uv_mapping texture { P scale 5 } } scale 4 } "
              "union { sphere { 0, 1 texture { P scale 6 } } scale 4 }")
            .materials.size() == 2);
  // Changed after it has been moved, it is another one.
  const Scene changed = parse(declared + "sphere { 0, 1 texture { P scale 2 } } "
                                         "sphere { 0, 1 texture { P scale 2 finish { phong 0.5 } } }");
  REQUIRE(changed.materials.size() == 2);
  CHECK(changed.materials[1].finish.phong == 0.5);
}

TEST_CASE("ior in a finish changes the interior, as in POV-Ray 3.1") {
  CHECK(ior("interior { ior 1.1 } finish { ior 1.5 }") == 1.5);
  const Scene scene =
      parse("union { sphere { 0, 1 } sphere { 0, 2 interior { ior 1.1 } } sphere { 0, 3 finish { ior 1.2 } } "
            "finish { ior 1.5 } }");
  REQUIRE(scene.objects.size() == 3);
  CHECK(scene.objects[0].interior == scene.objects[2].interior);
  CHECK(scene.interiors[scene.objects[0].interior].ior == 1.2);
  CHECK(scene.interiors[scene.objects[1].interior].ior == 1.5);
}

TEST_CASE("refraction in a finish becomes the interior's") {
  const auto refraction = [](const std::string& text, std::size_t object = 0) {
    const Scene scene = parse(text);
    return scene.interiors.at(scene.objects.at(object).interior).refraction;
  };
  const auto of = [&](const std::string& modifiers) {
    return refraction("sphere { 0, 1 " + modifiers + " }");
  };
  const std::string half = "finish { refraction 0.5 } ", clear = "pigment { rgbf 1 } ";
  CHECK(of("") == 1);
  CHECK(of(half) == 0.5);
  CHECK(of("finish { refraction 1.5 ior 1.2 }") == 1.5);
  CHECK(of("finish { refraction off }") == 0);
  CHECK(of("finish { refraction 0.5 refraction on }") == 1);
  CHECK(of(half + "interior { ior 1.5 }") == 0.5);
  CHECK(of("interior { ior 1.5 } " + half) == 0.5);
  CHECK(of("material { texture { " + clear + half + "} interior { ior 1.5 } }") == 0.5);
  // Of layers, the top one's.
  CHECK(of("texture { " + clear + "} texture { " + clear + half + "}") == 0.5);
  CHECK(of("texture { " + clear + half + "} texture { " + clear + "}") == 1);
  CHECK(of("texture { gradient x texture_map { [0 " + clear + half + "] [1 " + clear + half + "] } }") == 1);
  CHECK(of("texture { " + clear + "} interior_texture { " + clear + half + "}") == 1);
  CHECK(refraction("#default { " + half + "} sphere { 0, 1 texture { " + clear + "} }") == 0.5);
  CHECK(refraction("#default { " + half + "} sphere { 0, 1 texture { gradient x texture_map { [0 " + clear +
                   "] [1 " + clear + "] } } }") == 1);
  CHECK(refraction("#declare F = " + half + "#declare S = sphere { 0, 1 finish { F } } object { S " + clear +
                   "}") == 0.5);
  // Parts of a union have its texture, or say it anew; of those that share an interior, the last one counts.
  CHECK(refraction("union { sphere { 0, 1 } " + half + "}") == 0.5);
  CHECK(refraction("union { sphere { 0, 1 " + clear + "} " + half + "}") == 1);
  CHECK(refraction("union { sphere { 0, 1 finish { refraction 0.8 } } " + half + "}") == 0.8);
  CHECK(refraction("union { sphere { 0, 1 " + clear + "} sphere { 0, 1 " + half +
                   "} interior { ior 1.5 } }") == 0.5);
  CHECK(refraction("union { sphere { 0, 1 " + half + "} sphere { 0, 1 " + clear +
                   "} interior { ior 1.5 } }") == 1);
}

TEST_CASE("an opaque layer hides those below") {
  CHECK(material("texture { pigment { rgb 1 } } texture { pigment { rgb 0.5 } }").pigment.rgb.x == 0.5);
}

namespace {

/// Of an object with the textures, read by the version.
Material layered(const std::string& version, const std::string& textures) {
  const Scene scene = parse("#version " + version + "; sphere { 0, 1 " + textures + " }");
  return scene.materials.at(scene.objects.at(0).material);
}

bool transmits(const Pigment& pigment) {
  return pigment.filter == 0 && pigment.transmit == Approx(0.75);
}

const std::string kBase = "texture { pigment { rgb 0.5 } } ";
const std::string kFiltering = "rgbft <0.8, 0.4, 0.2, 0.5, 0.25> ";
const std::string kFilteringLayer = "texture { pigment { " + kFiltering + "} } ";

} // namespace

TEST_CASE("up to version 3.1 layers on others transmit what they filter") {
  const std::string both = kBase + kFilteringLayer;
  for (const char* version : {"3.0", "3.1", "3.104"})
    CHECK(transmits(layered(version, both).pigment));
  for (const char* version : {"3.106", "3.5", "3.6", "3.7"})
    CHECK(layered(version, both).pigment.filter == 0.5);
  const Material three = layered("3.1", kFilteringLayer + kFilteringLayer + kFilteringLayer);
  CHECK(transmits(three.pigment));
  CHECK(transmits(three.below->pigment));
  CHECK(three.below->below->pigment.filter == 0.5);
  CHECK(layered("3.1", kFilteringLayer).pigment.filter == 0.5);
  CHECK(transmits(layered("3.1", "material { " + both + "}").pigment));
  const Scene inside =
      parse("#version 3.1; sphere { 0, 1 " + kBase + "interior_texture { pigment { rgb 1 } } " +
            "interior_texture { pigment { " + kFiltering + "} } }");
  CHECK(transmits(inside.materials.at(inside.objects.at(0).material).inside->pigment));
}

TEST_CASE("up to version 3.1 all colours of patterns in layers transmit what they filter") {
  const std::string map = "color_map { [0 rgb 1] [1 " + kFiltering + "] }";
  const auto pigment = [](const std::string& items) {
    return layered("3.1", kBase + "texture { pigment { " + items + " } }").pigment.map->entries;
  };
  CHECK(transmits(pigment("gradient x " + map).at(1).value));
  CHECK(pigment("gradient x " + map).at(0).value.transmit == 0);
  CHECK(transmits(pigment("checker rgb 1 " + kFiltering).at(1).value));
  CHECK(transmits(pigment("average pigment_map { [1 " + kFiltering + "] }").at(0).value));
  const auto nested =
      pigment("gradient x pigment_map { [0 gradient y " + map + "] [1 gradient z " + map + "] }");
  CHECK(transmits(nested.at(0).value.map->entries.at(1).value));
  CHECK(transmits(nested.at(1).value.map->entries.at(1).value));
}

TEST_CASE(
    "up to version 3.1 layers transmit what they filter where they are declared and where they are used") {
  const auto used = [](const std::string& before, const std::string& after, const std::string& text) {
    return parse("#version " + before + "; #declare T = " + kBase + kFilteringLayer + "#version " + after +
                 "; sphere { 0, 1 " + text + " }");
  };
  const auto first = [](const Scene& scene) { return scene.materials.at(scene.objects.at(0).material); };
  CHECK(transmits(first(used("3.1", "3.6", "texture { T }")).pigment));
  CHECK(transmits(first(used("3.6", "3.1", "texture { T }")).pigment));
  CHECK(transmits(first(used("3.6", "3.1", "texture { T finish { ambient 1 } }")).pigment));
  CHECK(transmits(first(used("3.6", "3.1", "texture { tiles { texture { T } tile2 texture { T } } }"))
                      .map->entries.at(0)
                      .value.pigment));
  // Entries of maps and lists are no layers where they are used.
  CHECK(first(used("3.6", "3.1", "texture { checker texture { T } texture { T } }"))
            .map->entries.at(0)
            .value.pigment.filter == 0.5);
  CHECK(first(used("3.6", "3.1", "texture { gradient x texture_map { [0 T] [1 T] } }"))
            .map->entries.at(0)
            .value.pigment.filter == 0.5);
}

TEST_CASE("interiors and materials") {
  CHECK(ior("") == 1);
  CHECK(ior("interior { ior 1.5 caustics 0 }") == 1.5);
  CHECK(ior("material { texture { pigment { rgbt 1 } } interior { ior 1.3 } }") == 1.3);
  CHECK(ior("finish { refraction 1 ior 1.7 }") == 1.7);
  CHECK(ior("interior { fade_distance 0 fade_power 2 dispersion 1 ior 1.2 }") == 1.2);
  const Scene named = parse("#declare I = interior { ior 2 } #declare M = material { interior { I } } "
                            "sphere { 0, 1 material { M } }");
  CHECK(named.interiors.at(0).ior == 2);
  const Scene fading =
      parse("sphere { 0, 1 interior { fade_distance 3 fade_power 2 fade_color rgb <.1, .2, .3> "
            "caustics 0.5 } finish { fade_power 1 } }");
  CHECK(fading.interiors.at(0).fade_distance == 3);
  CHECK(fading.interiors.at(0).fade_power == 1); // POV-Ray 3.1's finish changes it
  CHECK(fading.interiors.at(0).fade_colour == Vec3(.1, .2, .3));
  CHECK(fading.interiors.at(0).caustics == 0.5);
  CHECK(error_line("sphere { 0, 1 interior { ior 1.5 media { scattering { 1, 1 } } } }") ==
        "scene.pov:1:34: error: 'media' is not supported yet");
  CHECK(error_line("sphere { 0, 1 interior { dispersion 1.02 } }") ==
        "scene.pov:1:26: error: 'dispersion' is not supported yet");
}

TEST_CASE("what is not supported is an error where it is used") {
  const std::string declarations =
      "#declare T = texture { pigment { tiling 9 color_map { [0 rgb 1] [1 rgb 0] } turbulence 1 } normal { "
      "bumps 1 } }\n"
      "#declare N = normal { bumps 0.3 } #declare M = color_map { [0 rgb 1][1 rgb 0] }\n"
      "#declare F = function (x, y) { x + y } #declare B = ovus { threshold 1 } #declare D = difference { "
      "sphere "
      "{ 0, 1 } object { B } }\n"
      "#declare S = sphere { 0, 1 pigment { density_file df3 \"d\" } }\n"
      "#declare I = interior { dispersion 1.1 } #declare C = interior { media { intervals 1 } }\n";
  CHECK(error_line(declarations).empty());
  CHECK(error_line(declarations + "sphere { 0, 1 texture { T } }") ==
        "scene.pov:1:34: error: 'tiling' is not supported yet");
  CHECK(error_line(declarations + "object { D }") == "scene.pov:3:53: error: 'ovus' is not supported yet");
  CHECK(error_line(declarations + "union { sphere { 0, 1 } object { B } }") ==
        "scene.pov:3:53: error: 'ovus' is not supported yet");
  CHECK(error_line(declarations + "object { S pigment { rgb 1 } }").empty());
  CHECK(error_line(declarations + "S") == "scene.pov:4:38: error: 'density_file' is not supported yet");
  CHECK(error_line(declarations + "sphere { 0, 1 interior { I } }") ==
        "scene.pov:5:25: error: 'dispersion' is not supported yet");
  CHECK(error_line(declarations + "sphere { 0, 1 interior { C } }") ==
        "scene.pov:5:66: error: 'media' is not supported yet");
  CHECK(test::error(declarations + "S") ==
        "scene.pov:4:38: error: 'density_file' is not supported yet\n    used at scene.pov:6:1");
  CHECK(error_line("parametric { 0, x, 1 }") == "scene.pov:1:1: error: 'parametric' is not supported yet");
  CHECK(error_line("sphere { 0, 1 clipped_by { ovus { 0, 1 } } }") ==
        "scene.pov:1:28: error: 'ovus' is not supported yet");
  CHECK(error_line("sphere { 0, 1 autostop }") == "scene.pov:1:15: error: 'autostop' is not supported yet");
}

TEST_CASE("all that is not supported is reported at once, each feature once") {
  const std::string scene = "sphere { 0, 1 pigment { density_file df3 \"d\" scale 2 } autostop }\n"
                            "isosurface { function { x } }\n"
                            "union { sphere { 0, 1 autostop finish { phong 0.5 subsurface { "
                            "translucency 1 } diffuse 0.2 } } ovus { threshold 1 } }\n";
  CHECK(test::error(scene) == "scene.pov:1:56: error: 'autostop' is not supported yet\n"
                              "    used at scene.pov:1:1\n"
                              "scene.pov:1:25: error: 'density_file' is not supported yet\n"
                              "    used at scene.pov:1:1\n"
                              "scene.pov:2:1: error: 'isosurface' is not supported yet\n"
                              "scene.pov:3:51: error: 'subsurface' is not supported yet\n"
                              "    used at scene.pov:3:1\n"
                              "scene.pov:3:97: error: 'ovus' is not supported yet\n"
                              "    used at scene.pov:3:1");
  CHECK(test::error(scene + "sphere { }")
            .ends_with("'ovus' is not supported yet\n    used at scene.pov:3:1\n"
                       "scene.pov:4:10: error: unexpected '}', expected a number"));

  ParseOptions lenient;
  lenient.lenient = true;
  std::string said;
  lenient.message = [&said](std::string_view message) { said += message; };
  const Scene read = test::parse(scene, lenient);
  CHECK(said == "scene.pov:1:56: warning: 'autostop' is not supported yet and left out\n"
                "scene.pov:1:25: warning: 'density_file' is not supported yet and left out\n"
                "scene.pov:2:1: warning: 'isosurface' is not supported yet and left out\n"
                "scene.pov:3:51: warning: 'subsurface' is not supported yet and left out\n"
                "scene.pov:3:97: warning: 'ovus' is not supported yet and left out\n");
  REQUIRE(read.objects.size() == 2);
  const Material& material = read.materials[read.objects[1].material];
  CHECK(material.finish.phong == 0.5);
  CHECK(material.finish.diffuse == 0.2);
}

TEST_CASE("what is left out of CSG and patterns") {
  ParseOptions lenient;
  lenient.lenient = true;
  lenient.message = [](std::string_view) {};
  CHECK(test::parse("difference { ovus { threshold 1 } sphere { 0, 1 } }", lenient).objects.empty());
  CHECK(test::parse("difference { sphere { 0, 1 } ovus { threshold 1 } }", lenient).objects.size() == 1);
  const Scene scene = test::parse(
      "sphere { 0, 1 pigment { density_file df3 \"d\" turbulence 1 color_map { [0 rgb 0.25] [1 rgb 1] } } }",
      lenient);
  CHECK(scene.materials.at(scene.objects.at(0).material).pigment.rgb == Vec3(0.25));
}
