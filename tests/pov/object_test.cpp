// Spheres, unions, lights, placement.
#include <catch2/catch.hpp>

#include "pov/parsing.hpp"

using namespace celltrace;
using test::error_line;
using test::output;
using test::parse;

TEST_CASE("spheres") {
  const Scene scene = parse("sphere { <1, 2, 3>, 4 } sphere { <1 2 3> 4 scale <2, 1, 1> }");
  REQUIRE(scene.objects.size() == 2);
  const auto& sphere = std::get<Sphere>(scene.objects[0].shape);
  CHECK(sphere.centre == Vec3(1, 2, 3));
  CHECK(sphere.radius == 4);
  CHECK(scene.objects[0].transform.is_identity());
  CHECK(scene.objects[1].transform.point({1, 2, 3}) == Vec3(2, 2, 3));
  CHECK(parse("sphere { 0, 0 } sphere { 0, -1 }").objects.empty());
}

TEST_CASE("declared objects are placed as often as they are named") {
  const Scene scene =
      parse("#declare S = sphere { 0, 1 translate x } object { S translate y } sphere { S scale 2 } S");
  REQUIRE(scene.objects.size() == 3);
  CHECK(scene.objects[0].transform.point({0, 0, 0}) == Vec3(1, 1, 0));
  CHECK(scene.objects[1].transform.point({0, 0, 0}) == Vec3(2, 0, 0));
  CHECK(scene.objects[2].transform.point({0, 0, 0}) == Vec3(1, 0, 0));
  CHECK(parse("#declare S = sphere { 0, 1 }").objects.empty());
}

TEST_CASE("unions come apart, inside out") {
  const Scene scene =
      parse("union { sphere { 0, 1 translate x } union { sphere { 0, 2 } rotate 90*y } translate y }");
  REQUIRE(scene.objects.size() == 2);
  CHECK(scene.objects[0].transform.point({0, 0, 0}) == Vec3(1, 1, 0));
  CHECK(scene.objects[1].transform.point({1, 0, 0}) == Vec3(0, 1, -1));
}

TEST_CASE("a loop can add to a union as often as it likes") {
  const Scene scene = parse("#declare U = sphere { 0, 1 pigment { rgb 1 } } "
                            "#for (I, 1, 3000) #declare U = union { object { U translate x } "
                            "sphere { 0, 2 pigment { rgb <0, I / 3000, 0> scale 2 } } } #end U");
  REQUIRE(scene.objects.size() == 3001);
  for (std::size_t i = 0; i < 3001; ++i) {
    CHECK(std::get<Sphere>(scene.objects[i].shape).radius == (i == 0 ? 1 : 2));
    CHECK(scene.objects[i].transform.point(Vec3(0)).x == (i == 0 ? 3000.0 : 3000.0 - static_cast<double>(i)));
  }
  CHECK(scene.materials.size() == 3001);
  CHECK(
      parse("#declare U = sphere { 0, 1 } #for (I, 1, 3000) #declare U = union { object { U } light_source { "
            "I, 1 } } #end union { U no_shadow }")
          .lights.size() == 3000);
}

TEST_CASE("parts inherit what they do not have") {
  const Scene scene = parse("union { sphere { 0, 1 } sphere { 0, 2 pigment { rgb 1 } no_shadow } "
                            "  pigment { rgb 0.5 } interior { ior 1.5 } }"
                            "union { sphere { 0, 3 } sphere { 0, 4 interior { ior 2 } } no_shadow }");
  REQUIRE(scene.objects.size() == 4);
  const auto red = [&](std::size_t i) { return scene.materials[scene.objects[i].material].pigment.rgb.x; };
  const auto ior = [&](std::size_t i) { return scene.interiors[scene.objects[i].interior].ior; };
  CHECK(red(0) == 0.5);
  CHECK(red(1) == 1);
  CHECK(red(2) == 0);
  CHECK(scene.objects[0].interior == scene.objects[1].interior);
  CHECK(ior(0) == 1.5);
  CHECK(scene.objects[2].interior != scene.objects[3].interior);
  CHECK(ior(3) == 2);
  CHECK_FALSE(scene.objects[0].no_shadow);
  CHECK(scene.objects[1].no_shadow);
  CHECK(scene.objects[2].no_shadow);
}

TEST_CASE("every object has its own interior") {
  const Scene scene =
      parse("sphere { 0, 1 } sphere { 0, 2 } #declare S = sphere { 0, 1 interior { ior 1.3 } } S S");
  CHECK(scene.interiors.size() == 4);
  CHECK(scene.objects[2].interior != scene.objects[3].interior);
  CHECK(scene.interiors[scene.objects[3].interior].ior == 1.3);
}

TEST_CASE("equal textures make one material") {
  const Scene scene = parse(
      "#declare T = texture { pigment { rgb 1 } } #for (I, 1, 10) sphere { 0, I texture { T scale I } } "
      "#end sphere { 0, 1 } sphere { 0, 2 }");
  CHECK(scene.materials.size() == 2);
}

TEST_CASE("light sources") {
  const Scene scene = parse(
      "light_source { <1, 2, 3> color rgb 2 } light_source { 0, 1 translate 3 shadowless }"
      "#declare L = light_source { x rgb <1, 0, 0> } union { sphere { 0, 1 } light_source { L } rotate 90*y }"
      "light_source { 0 rgb 1 media_interaction off photons { reflection on } }");
  REQUIRE(scene.lights.size() == 4);
  CHECK(scene.lights[0].location == Vec3(1, 2, 3));
  CHECK(scene.lights[0].colour == Vec3(2, 2, 2));
  CHECK_FALSE(scene.lights[0].shadowless);
  CHECK(scene.lights[1].location == Vec3(3, 3, 3));
  CHECK(scene.lights[1].shadowless);
  CHECK(scene.lights[2].location == Vec3(0, 0, -1));
  CHECK(scene.lights[2].colour == Vec3(1, 0, 0));
  CHECK(error_line("#declare S = sphere { 0, 1 } light_source { S shadowless }") ==
        "scene.pov:1:45: error: this is not a light source");
}

TEST_CASE("hints and flags that change no picture are accepted") {
  const Scene scene =
      parse("sphere { 0, 1 hollow inverse sturm hierarchy off bounded_by { ovus { threshold 1 } } "
            "photons { target reflection on } no_radiosity uv_mapping pigment { rgb 1 } }");
  CHECK(scene.objects.size() == 1);
}

TEST_CASE("words of early versions") {
  CHECK(parse("max_trace_level 3 sphere { 0, 1 }").max_trace_level == 3);
  CHECK(parse("global_settings { max_trace_level 4 } #version 1.0; max_trace_level 3").max_trace_level == 3);
  CHECK(parse("max_trace_level 300").max_trace_level == 256);
  CHECK(
      parse("max_intersections 64 sphere { 0, 1 } global_settings { max_intersections 3 }").objects.size() ==
      1);
  CHECK(error_line("max_intersections x").ends_with("expected a float, found a vector"));
  CHECK(error_line("mm_per_unit 1").find("unexpected 'mm_per_unit'") != std::string::npos);
  const Scene composite =
      parse("#declare C = composite { sphere { 0, 1 } composite { sphere { x, 1 } } translate y } "
            "composite { C } union { composite { C pigment { rgb 1 } } sphere { y, 1 } }");
  CHECK(composite.objects.size() == 5);
  const Scene glass = parse("sphere { 0, 1 interior { refraction 0.5 ior 1.3 } }");
  CHECK(glass.interiors.at(0).ior == 1.3);
}

TEST_CASE("a colour of an object is ignored") {
  const auto pigment = [](const std::string& modifiers) {
    const Scene scene = parse("sphere { 0, 1 " + modifiers + " }");
    return scene.materials.at(scene.objects.at(0).material).pigment;
  };
  for (const char* colour :
       {"colour red 0 green 1", "rgb <1, 2, 3>", "red 1 filter 1", "color 3", "color rgbt 1"}) {
    INFO(colour);
    CHECK(pigment(std::string("pigment { rgb <3, 4, 5> } ") + colour).rgb == Vec3(3, 4, 5));
    CHECK(pigment(std::string(colour) + " scale 2 pigment { rgb <3, 4, 5> }").rgb == Vec3(3, 4, 5));
    CHECK(pigment(std::string("pigment { rgb <3, 4, 5> } ") + colour).transmit == 0);
  }
  CHECK(output("#for (I, 1, 3) sphere { 0, 1 colour red I } #end\nsphere { 0, 1 rgb 1 }") ==
        "scene.pov:1:30: warning: this colour is ignored: what gives an object one is its 'pigment'\n"
        "scene.pov:2:15: warning: this colour is ignored: what gives an object one is its 'pigment'\n");
  // By its name it is one as well, where the shape has all its arguments.
  const std::string name = "#declare Red = rgb <1, 0, 0>; ";
  CHECK(output(name +
               "sphere { 0, 1 Red } cylinder { -x, x, 1 Red open } torus { 1, 0.5 Red pigment { Red } }\n"
               "plane { y, 1\nRed scale 2 } cone { 0, 1, y, 0 Red }") ==
        "scene.pov:1:45: warning: this colour is ignored: what gives an object one is its 'pigment'\n"
        "scene.pov:1:71: warning: this colour is ignored: what gives an object one is its 'pigment'\n"
        "scene.pov:1:97: warning: this colour is ignored: what gives an object one is its 'pigment'\n"
        "scene.pov:3:1: warning: this colour is ignored: what gives an object one is its 'pigment'\n"
        "scene.pov:3:33: warning: this colour is ignored: what gives an object one is its 'pigment'\n");
  const Scene named = parse(name + "#declare Ball = sphere { 0, 1 pigment { rgb <3, 4, 5> } } "
                                   "object { Ball Red no_shadow Red }");
  CHECK(named.materials.at(named.objects.at(0).material).pigment.rgb == Vec3(3, 4, 5));
  CHECK(error_line("sphere { 0, 1 no_shadow 2 }") == "scene.pov:1:25: error: unexpected number");
  CHECK(error_line(name + "sphere { 0 Red }").find("found a colour as radius") != std::string::npos);
  CHECK(error_line("light_source { 0, 1 rgb 1 }").find("unexpected 'rgb'") != std::string::npos);
}

TEST_CASE("the environment") {
  const Scene scene =
      parse("background { rgb <.1, .2, .3> } global_settings { max_trace_level 9 adc_bailout 0.01 "
            "ambient_light rgb <1, 2, 3> number_of_waves 3 noise_generator 2 charset utf8 hf_gray_16 on "
            "mm_per_unit 10 max_intersections 64 irid_wavelength rgb 1 }");
  CHECK(scene.background == Vec3(.1, .2, .3));
  CHECK(scene.max_trace_level == 9);
  CHECK(scene.adc_bailout == 0.01);
  CHECK(scene.ambient_light == Vec3(1, 2, 3));
  CHECK(scene.name == "scene.pov");
  CHECK(error_line("global_settings { radiosity { count 10 } }") ==
        "scene.pov:1:19: error: 'radiosity' is not supported yet");
  const std::string photons = "global_settings { photons { count 10 } } sphere { 0, 1 photons { ";
  CHECK(error_line(photons + "reflection on target } }") ==
        "scene.pov:1:19: error: 'photons' is not supported yet");
  CHECK(error_line(photons + "reflection on target off pass_through } }").empty());
  CHECK(error_line("sphere { 0, 1 photons { target refraction on collect off } }").empty());
  CHECK(parse("global_settings { max_trace_level 0 }").max_trace_level == 1);
  CHECK(parse("global_settings { max_trace_level -1e20 }").max_trace_level == 1);
  CHECK(parse("global_settings { max_trace_level 1.9 }").max_trace_level == 1);
  CHECK(parse("global_settings { max_trace_level 256 }").max_trace_level == 256);
  CHECK(output("global_settings { max_trace_level 1e20 }") ==
        "scene.pov:1:35: warning: max_trace_level is 256, which is the most there is\n");
  CHECK(scene.irid_wavelength == Vec3(1));
  CHECK(parse("sphere { 0, 1 }").irid_wavelength == Vec3(0.7, 0.52, 0.48));
}

TEST_CASE("what POV-Ray does not render at a low quality is no matter") {
  const std::string scene =
      "global_settings { radiosity { count 10 } photons { count 10 } } media { emission 1 } "
      "sphere { 0, 1 photons { target } interior { media { emission 1 } } }";
  ParseOptions options;
  options.quality = 8;
  CHECK(parse_string(scene, options).objects.size() == 1);
  for (const char* const word : {"radiosity", "photons", "media"})
    CHECK_THAT(test::error(scene), Catch::Contains('\'' + std::string(word) + "' is not supported yet"));
}

TEST_CASE("objects that light shines through") {
  const Scene scene =
      parse("sphere { 0, 1 double_illuminate } sphere { 0, 1 double_illuminate off } "
            "union { sphere { 0, 1 } intersection { sphere { 0, 1 } box { 0, 1 } } double_illuminate }");
  REQUIRE(scene.objects.size() == 4);
  CHECK(scene.objects[0].is_lit_through);
  CHECK_FALSE(scene.objects[1].is_lit_through);
  CHECK(scene.objects[2].is_lit_through);
  CHECK(std::get<std::shared_ptr<const Csg>>(scene.objects[3].shape)->parts.at(1).is_lit_through);
}

TEST_CASE("what objects say of radiosity matters only if there is any") {
  CHECK(error_line("#default { radiosity { importance 2 } } sphere { 0, 1 radiosity { importance 0.5 } }")
            .empty());
}

TEST_CASE("a transparent background is one over black, from version 3.7 on") {
  const char* const background = "background { rgbft <.2, .4, .6, .3, .5> }";
  CHECK(parse(background).background == Vec3(.2, .4, .6));
  CHECK(parse(std::string("#version 3.6; ") + background).background == Vec3(.2, .4, .6));
  CHECK(parse(std::string("#version 3.7; ") + background).background == Vec3(.1, .2, .3));
}
