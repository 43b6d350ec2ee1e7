// Values that mean next to nothing: POV-Ray takes them, and so does this.
#include "parsing.hpp"

#include <vector>

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;

namespace {

Vec3 moved(const std::string& matrix, const Vec3& point) {
  return parse("sphere { 0, 1 matrix <" + matrix + "> }").objects.at(0).transform.point(point);
}

bool warns(const std::string& text, const std::string& of) {
  return output(text).find("warning: " + of) != std::string::npos;
}

} // namespace

TEST_CASE("a column of zeros in a matrix is a scale by 1") {
  CHECK(moved("1,0,0, 0,0,0, 0,0,1, -1,0,0", {0, 2, 3}) == Vec3(-1, 2, 3));
  CHECK(moved("0,0,0, 0,0,0, 0,0,0, 0,0,0", {1, 2, 3}) == Vec3(1, 2, 3));
  CHECK(moved("1,0,0, 1,0,0, 0,0,1, 0,0,0", {1, 2, 3}) == Vec3(3, 2, 3));
  CHECK(moved("1,0,0, 0,1e-11,0, 0,0,1, 0,0,0", {1, 2, 3}) == Vec3(1, 2, 3));
  CHECK(warns("sphere { 0, 1 matrix <1,0,0, 0,0,0, 0,0,1, 0,0,0> }", "a matrix with a column of zeros"));
  CHECK(output("sphere { 0, 1 matrix <1,0,0, 0,1,0, 0,0,1, 0,0,0> }").find("warning") == std::string::npos);
  CHECK(error_line("sphere { 0, 1 matrix <1,0,0, 0,0,0, 0,1,1, 0,0,0> }").find("is singular") !=
        std::string::npos);
}

TEST_CASE("a colour's keyword without a value is black") {
  for (const char* modifiers :
       {"pigment { color }", "pigment { colour }", "pigment { checker color color rgb x }"})
    CHECK_NOTHROW(material(modifiers));
  CHECK(material("pigment { rgb 1 } finish { ambient }").finish.ambient == Vec3(0));
  CHECK(material("finish { ambient color diffuse 0.5 }").finish.diffuse == 0.5);
  CHECK(material("finish { reflection { } }").finish.reflection_max == Vec3(0));
  CHECK(material("finish { reflection { fresnel } }").finish.reflection_fresnel);
  CHECK(parse("background { }").background == Vec3(0));
  CHECK(parse("background { color }").background == Vec3(0));
  CHECK(parse("light_source { y, color shadowless }").lights.at(0).colour == Vec3(0));
  CHECK(parse("fog { color distance 5 }").fogs.at(0).distance == 5);
}

TEST_CASE("comparisons behind a colour's keyword need no parentheses") {
  CHECK(material("pigment { rgb 1 = 1 ? x : y }").pigment.rgb == Vec3(1, 0, 0));
  CHECK(material("pigment { color 2 < 1 ? x : y }").pigment.rgb == Vec3(0, 1, 0));
  CHECK(material("pigment { rgb 2 > 1 }").pigment.rgb == Vec3(1));
}

TEST_CASE("commas that are there or not") {
  CHECK(output("#declare A = array[2][2] { {1, 2,}, {3, 4,}, }; #debug str(A[1][1], 0, 0)") == "4");
  CHECK(output("#debug concat(\"a\" \"b\" \"c\")") == "abc");
  CHECK(value("max(1 3 2)") == "3.000");
}

TEST_CASE("indices of refraction that are not above 0") {
  const auto ior = [](const std::string& interior) {
    const Scene scene = parse("sphere { 0, 1 " + interior + " }");
    return scene.interiors.at(scene.objects.at(0).interior).ior;
  };
  CHECK(ior("interior { ior 0 }") == 1);
  CHECK(ior("interior { ior -1.5 }") == -1.5);
  CHECK(ior("finish { ior 0 }") == 1);
  CHECK(ior("finish { ior -2 }") == 1);
}

TEST_CASE("finishes out of the ordinary") {
  CHECK(material("finish { roughness -1 }").finish.roughness > 1e6);
  CHECK(material("finish { crand -1 }").finish.crand == 0);
  CHECK(material("finish { reflection { 0.5 exponent 0 } }").finish.reflection_exponent == 1e-6);
  CHECK(warns("sphere { 0, 1 finish { roughness -1 } }", "with a negative roughness"));
}

TEST_CASE("patterns without an extent") {
  const auto kind = [](const std::string& pigment) {
    return material("pigment { " + pigment + " }").pigment.map->pattern.kind;
  };
  const auto is_nothing = [](const pattern::Kind& made) {
    const auto* crackle = std::get_if<pattern::Crackle>(&made);
    return crackle != nullptr && crackle->form[0] == 0 && crackle->form[1] == 0 && crackle->form[2] == 0;
  };
  CHECK(is_nothing(kind("gradient 0")));
  CHECK(is_nothing(kind("crackle metric 0")));
  CHECK(std::get<pattern::Brick>(kind("brick rgb x rgb y brick_size 0")).mortar > 1e6);
  CHECK(std::get<pattern::Fractal>(kind("mandel 1e6")).iterations == 65535);
  for (const char* exponent : {"1", "40", "2"})
    CHECK(std::get<pattern::Fractal>(kind("mandel 9 exponent " + std::string(exponent))).exponent == 2);
  CHECK(material("pigment { bozo warp { black_hole 0, 0 } }").pigment.map->pattern.space.empty());
  const Pigment average = material("pigment { average pigment_map { [0 rgb x] [0 rgb y] } }").pigment;
  CHECK((!average.map && average.rgb == Vec3(0)));
}

TEST_CASE("shapes whose numbers are not finite are not there") {
  for (const char* shape : {"sphere { 0, 1/0 }", "sphere { <1/0, 0, 0>, 1 }", "plane { y, 1e400 }",
                            "cylinder { 0, <0, 1/0, 0>, 1 }", "box { 0, 1e400 - 1e400 }"}) {
    INFO(shape);
    CHECK(parse(shape).objects.empty());
    CHECK(warns(shape, "there is nothing to see of this object"));
    CHECK(parse("difference { box { 0, 1 } " + std::string(shape) + " }").objects.size() == 1);
  }
}

TEST_CASE("meshes whose triangles are all degenerate are not there") {
  const std::string vertices = "vertex_vectors { 3, -x, 0, y } ";
  for (const std::string& mesh : {"mesh2 { " + vertices + "face_indices { 1, <0, 1, 1> } }",
                                  std::string("mesh { triangle { 0, x, x } }")}) {
    INFO(mesh);
    CHECK(parse(mesh + " sphere { 0, 1 }").objects.size() == 1);
    CHECK(warns(mesh, "this mesh has no triangle with an area"));
  }
}

TEST_CASE("rainbows are far away unless they have a distance") {
  CHECK(parse("rainbow { direction z angle 20 width 5 color_map { [0 rgbt 1] [1 rgbt 1] } }")
            .rainbows.at(0)
            .distance == 1e7);
}

TEST_CASE("a scene without anything is black") {
  for (const char* text : {"", "  // nothing\n"}) {
    CHECK(parse(text).objects.empty());
    CHECK(output(text) == "scene.pov:1:1: warning: the scene is empty: its picture is black\n");
  }
}

TEST_CASE("the first assumed_gamma of a scene counts") {
  CHECK(parse("global_settings { assumed_gamma 1 assumed_gamma 2.2 }").assumed_gamma == 1);
  CHECK(parse("global_settings { assumed_gamma 2.2 } global_settings { assumed_gamma 1 }").assumed_gamma ==
        2.2);
}

TEST_CASE("what arrays and names do not have") {
  const std::string sizes = "#declare A = array[2][3]; #debug concat(";
  CHECK(output(sizes + "str(dimension_size(A, 2), 0, 0), str(dimension_size(A, 0), 0, 0), "
                       "str(dimension_size(A, 3), 0, 0))") == "300");
  CHECK(output("#ifdef (sphere) #debug \"yes\" #else #debug \"no\" #end") == "no");
}

TEST_CASE("strings at their limits") {
  CHECK(value("strlen(chr(0))") == "0.000");
  CHECK(value("asc(chr(300))") == "300.000");
  CHECK(value("asc(chr(8364))") == "8364.000");
  CHECK(value("asc(chr(200))") == "200.000");
  CHECK(value("asc(\"\\u0041\")") == "65.000");
  CHECK(value("strlen(\"a\\u0041b\")") == "3.000");
  CHECK(value("strlen(substr(\"abc\", 0, 2))") == "0.000");
  CHECK(value("val(\"0x10\")") == "16.000");
  CHECK(output("#debug str(1e300, 0, 0)") == "1e+300");
  CHECK(output("#debug vstr(9, <1, 2, 3>, \",\", 0, 0)") == "1,2,3,0,0");
  CHECK(output("#debug vstr(1, <1, 2, 3>, \",\", 0, 0)") == "1,2");
  CHECK(output("#debug vstr(3, 5, \",\", 0, 0)") == "5,0,0");
}

TEST_CASE("numbers whose exponents have no digits") {
  CHECK(value("2e") == "2.000");
  CHECK(value("1.e + 3E+ + .5e-") == "4.500");
  CHECK(value(3, "<1e, 2.e, .5e->") == "1.00 2.00 0.50");
  CHECK(output("#macro N() 3e #end #declare I = 0; #while (I < 2) #debug str(N(), 0, 0) #declare I = I + 1; "
               "#end") == "33");
  CHECK(error_line("#declare A = 1e.5;").find("more than one decimal point") != std::string::npos);
}

TEST_CASE("conditions of several parts behind a colour's keyword need no parentheses") {
  CHECK(material("pigment { rgb 1 & 0 }").pigment.rgb == Vec3(0));
  CHECK(material("pigment { color 1 < 2 & 3 > 1 }").pigment.rgb == Vec3(1));
  CHECK(material("pigment { rgb 2 > 1 & 3 > 4 | 5 > 4 ? x : y }").pigment.rgb == Vec3(1, 0, 0));
  CHECK(material("pigment { rgb 0 | <1, 2, 3> > 2 }").pigment.rgb == Vec3(0, 0, 1));
  CHECK(material("pigment { rgb 1 } finish { ambient 1 | 0 }").finish.ambient == Vec3(1));
  CHECK(value(3, "(<1, 0, 1> & <1, 1, 0>)") == "1.00 0.00 0.00");
}

TEST_CASE("bytes that are 0 are blanks") {
  using namespace std::string_literals;
  CHECK(parse("sphere {\0 0, 1 }\0"s).objects.size() == 1);
  CHECK(parse("sphere { 0, 1 } // \0\n/* \0 */ sphere { 0, 1 }"s).objects.size() == 2);
  CHECK(!error("sph\0ere { 0, 1 }"s).empty());
}

TEST_CASE("objects at no finite place are left out") {
  for (const char* transformation :
       {"translate 1/0", "scale 1e400", "scale 1e400 - 1e400", "rotate 1e400*y",
        "matrix <1e400, 0,0, 0,1,0, 0,0,1, 0,0,0>", "transform { translate 1/0 inverse }"}) {
    INFO(transformation);
    const std::string moved = "sphere { 0, 1 " + std::string(transformation) + " }";
    CHECK(parse(moved).objects.empty());
    CHECK(output(moved).find("this object is at no finite place") != std::string::npos);
    CHECK(parse("union { box { 0, 1 } " + moved + " }").objects.size() == 1);
    CHECK(parse("difference { box { 0, 1 } " + moved + " }").objects.size() == 1);
    CHECK(
        parse("union { box { 0, 1 } sphere { 0, 1 } " + std::string(transformation) + " }").objects.empty());
    CHECK(output("#debug str(inside(" + moved + ", 0), 0, 0)").back() == '0');
  }
}

TEST_CASE("patterns at no finite place are those of one point") {
  for (const char* move :
       {"translate 1/0", "scale 1e400", "warp { planar 0, 0 }", "warp { spherical orientation 0 }"}) {
    INFO(move);
    const Pigment pigment = material("pigment { gradient x " + std::string(move) + " }").pigment;
    REQUIRE(pigment.map);
    const auto& space = pigment.map->pattern.space;
    REQUIRE(space.size() == 1);
    const Vec3 at = std::get<Transform>(space.front()).inverse().point({3, -4, 5});
    for (int axis = 0; axis < 3; ++axis)
      CHECK(at[axis] == Approx(1e-4));
  }
}

TEST_CASE("lights with numbers that are not finite") {
  for (const char* light :
       {"light_source { <1e400, 0, 0>, rgb 1 }", "light_source { 0, rgb 1 translate 1e400 }",
        "light_source { 0, rgb 1 spotlight point_at 1e400 }"}) {
    INFO(light);
    CHECK(parse(light).lights.empty());
    CHECK(warns(light, "this light is not at a finite place"));
  }
  CHECK(parse("light_source { 0, rgb 1e400 - 1e400 }").lights.at(0).colour == Vec3(0));
  CHECK(parse("light_source { 0, rgb 1 fade_distance 1e400 fade_power 2 }").lights.at(0).fade_distance == 0);
  CHECK(parse("fog { distance 1e400 }").fogs.at(0).distance == 0);
}

TEST_CASE("cameras without a direction see nothing but the background") {
  for (const char* camera :
       {"location 1e400", "look_at <0, 1e400 - 1e400, 0>", "translate 1e400", "direction 0 angle 40",
        "orthographic direction 0", "spherical direction 0", "right 0 up 0 direction 0"}) {
    INFO(camera);
    const std::string scene =
        "camera { " + std::string(camera) + " } sphere { 0, 1 } sky_sphere { pigment { rgb 1 } }";
    CHECK(parse(scene).objects.empty());
    CHECK(parse(scene).sky_sphere.empty());
    CHECK(warns(scene, "this camera's rays have no direction"));
  }
  const Camera flat = parse("camera { direction 0 }").camera;
  CHECK(flat.direction.x == 0);
  CHECK(flat.direction.z > 0);
  CHECK(flat.direction.z < 1e-5);
  CHECK(parse("camera { angle 1e400 }").camera.direction == Vec3(0, 0, 1));
}

TEST_CASE("triangles with numbers that are not finite") {
  for (const char* triangle : {"triangle { -x, x, 1e400*y }", "triangle { -x, x, y*(1e400 - 1e400) }",
                               "smooth_triangle { -x, -z, x, -z, y, 1e400 }"}) {
    INFO(triangle);
    CHECK(parse(triangle).objects.empty());
    CHECK(warns(triangle, "this triangle is left out"));
  }
  const auto mesh = [](const std::string& text) {
    return *std::get<std::shared_ptr<const Mesh>>(parse(text).objects.at(0).shape);
  };
  CHECK(mesh("mesh { triangle { -x, x, 1e400*y } triangle { -x, x, y } }").triangles.size() == 1);
  CHECK(mesh("mesh { smooth_triangle { -x, -z, x, x, y, 1e400 } }").triangles.at(0).normal[0] == kNoIndex);
  const std::string vertices = "vertex_vectors { 4, -x, x, y, 1e400*x } ";
  CHECK(mesh("mesh2 { " + vertices + "face_indices { 2, <0, 1, 2>, <0, 1, 3> } }").triangles.size() == 1);
  CHECK(mesh("mesh2 { " + vertices + "normal_vectors { 4, -z, x, 1e400, y } face_indices { 1, <0, 1, 2> } }")
            .triangles.at(0)
            .normal[0] == kNoIndex);
  CHECK(mesh("mesh { triangle { -x, x, y } inside_vector 1e400 }").inside_vector == Vec3(0));
}

TEST_CASE("cones with a radius below 0") {
  const auto cones = [](const std::string& text) {
    std::vector<Cone> all;
    for (const Object& object : parse(text).objects)
      all.push_back(std::get<Cone>(object.shape));
    return all;
  };
  const auto two = cones("cone { 0, 1, 3*y, -0.5 open }");
  REQUIRE(two.size() == 2);
  CHECK(two[0].base_radius == 1);
  CHECK(two[0].cap == Vec3(0, 2, 0));
  CHECK(two[0].cap_radius == 0);
  CHECK(two[1].base == Vec3(0, 2, 0));
  CHECK(two[1].cap_radius == 0.5);
  CHECK((two[0].open && two[1].open));
  const auto one = cones("cone { 0, -1, y, -0.5 }");
  REQUIRE(one.size() == 1);
  CHECK(one[0].base_radius == 1);
  CHECK(one[0].cap_radius == 0.5);
  CHECK(warns("cone { 0, -1, y, 0.5 }", "POV-Ray shows a part of this cone only"));
  CHECK(parse("superellipsoid { <1, -1> }").objects.empty());
}

TEST_CASE("fractals without iterations") {
  CHECK(std::get<pattern::Fractal>(material("pigment { mandel 0 }").pigment.map->pattern.kind).iterations ==
        0);
  CHECK(std::get<pattern::Fractal>(material("pigment { julia <0, 1>, 0.5 }").pigment.map->pattern.kind)
            .iterations == 0);
  const Pattern constant = material("pigment { magnet 1 mandel -3 exponent 3 }").pigment.map->pattern;
  CHECK(std::get<pattern::Fractal>(constant.kind).iterations == 0);
  CHECK(std::get<pattern::Fractal>(constant.kind).interior_factor == 0.55);
  const Pattern modulo = material("pigment { mandel 20 exterior 8, 2.5 }").pigment.map->pattern;
  CHECK(std::get<pattern::Fractal>(modulo.kind).exterior == 8);
}

TEST_CASE("normals that are undefined make surfaces black") {
  for (const char* normal : {"wood 1 accuracy 0", "average normal_map { [0 bumps 1] [0 wood 1] }"}) {
    INFO(normal);
    const Material black =
        material("pigment { rgb 1 } finish { specular 1 } normal { " + std::string(normal) + " }");
    CHECK(black.pigment.rgb == Vec3(0));
    CHECK(black.finish.specular == 0);
    CHECK(!black.normal);
  }
  for (const char* normal : {"bumps 1 accuracy 0", "bozo normal_map { [0 bumps 1] [1 wood 1] } accuracy 0"})
    CHECK(material("pigment { rgb 1 } normal { " + std::string(normal) + " }").normal);
  CHECK(material("texture { average texture_map { [0 pigment { rgb 1 }] } }").pigment.rgb == Vec3(0));
  const auto facets = [](const std::string& text) {
    return std::get<pattern::Facets>(material("normal { facets " + text + " }").normal->pattern.kind);
  };
  CHECK(facets("coords 0.3 size 0.2").size == 0);
  CHECK(facets("size 0.2 coords 0.3").coords == 0.3);
}

TEST_CASE("ground fogs that divide by zero are black") {
  const auto fog = [](const std::string& text) {
    return parse("fog { fog_type 2 distance 3 rgb 1 " + text + " }").fogs.at(0);
  };
  const Fog low = fog("");
  CHECK(low.is_ground);
  CHECK(low.colour == Vec3(0));
  CHECK(low.altitude > 0);
  CHECK(low.distance < 1);
  CHECK(!fog("fog_alt 1 up 0").is_ground);
  CHECK(fog("fog_alt 1 up 0").colour == Vec3(0));
  CHECK(fog("fog_alt 1").colour == Vec3(1));
  CHECK(parse("fog { distance 3 rgb 1 up 0 }").fogs.at(0).colour == Vec3(1));
}

TEST_CASE("objects that reach out of what bounds them") {
  const auto is_warned_of = [](const std::string& text) {
    return output(text).find("reaches out of its 'bounded_by'") != std::string::npos;
  };
  for (const char* object :
       {"sphere { 0, 1 bounded_by { box { -0.5, 0.5 } } }",
        "sphere { 0, 1 bounded_by { sphere { 9*y, 1 } } }", "plane { y, 0 bounded_by { box { -1, 1 } } }",
        "union { sphere { 0, 1 } box { 2, 3 } bounded_by { sphere { 0, 1.1 } } rotate 9 }",
        "difference { box { -1, 1 } sphere { 0, 1.2 bounded_by { sphere { 0, 0.5 } } } }"}) {
    INFO(object);
    CHECK(is_warned_of(object));
  }
  for (const char* object :
       {"sphere { 0, 1 bounded_by { box { -1, 1 } } }",
        "box { -1, 1 bounded_by { box { -1, 1 } } rotate 20 }",
        "plane { y, 0 clipped_by { box { -1, 1 } } bounded_by { clipped_by } }",
        "union { sphere { 0, 1 } box { 2, 3 } bounded_by { box { -1, 3 } } }",
        "sphere { 0, 1 bounded_by { plane { y, 0 } } }",
        "sphere { 0, 1 bounded_by { sphere { 0, 0.5 inverse } } }",
        "mesh { triangle { 0, x, y } bounded_by { box { 5, 6 } } }",
        "#declare S = sphere { 0, 1 bounded_by { box { -0.5, 0.5 } } }", "sphere { 0, 1 }"}) {
    INFO(object);
    CHECK(!is_warned_of(object));
  }
}

TEST_CASE("an adc_bailout above 1 makes the picture black") {
  const Scene scene = parse("global_settings { adc_bailout 1.5 } background { rgb 1 } sphere { 0, 1 }");
  CHECK(scene.objects.empty());
  CHECK(scene.background == Vec3(0));
}
