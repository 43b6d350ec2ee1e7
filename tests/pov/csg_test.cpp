// Union, intersection, difference, merge; inverse, clipped_by, bounded_by.
#include <catch2/catch.hpp>
#include <functional>

#include "pov/parsing.hpp"

using namespace celltrace;
using test::error_line;
using test::parse;

namespace {

const Csg& csg_of(const Object& object) {
  return *std::get<std::shared_ptr<const Csg>>(object.shape);
}

Object only(const Scene& scene) {
  REQUIRE(scene.objects.size() == 1);
  return scene.objects[0];
}

double red(const Scene& scene, const Object& object) {
  return scene.materials.at(object.material).pigment.rgb.x;
}

Csg::Operation operation(const std::string& keyword) {
  return csg_of(only(parse(keyword + " { sphere { 0, 1 } box { 0, 1 } }"))).operation;
}

} // namespace

TEST_CASE("intersection, difference and merge are one object") {
  CHECK(operation("intersection") == Csg::Operation::intersection);
  CHECK(operation("difference") == Csg::Operation::difference);
  CHECK(operation("merge") == Csg::Operation::merge);
  const Scene scene =
      parse("difference { box { -1, 1 translate x } sphere { 0, 1 } plane { y, 0 } rotate 90*y }");
  const Object object = only(scene);
  CHECK(object.transform.point({1, 0, 0}).z == Approx(-1));
  const Csg& csg = csg_of(object);
  REQUIRE(csg.parts.size() == 3);
  CHECK(csg.parts[0].transform.point({0, 0, 0}) == Vec3(1, 0, 0));
  CHECK(std::holds_alternative<Sphere>(csg.parts[1].shape));
  CHECK(std::holds_alternative<Plane>(csg.parts[2].shape));
  CHECK_NOTHROW(validate(scene));
}

TEST_CASE("CSG nests, each part in the space of its CSG") {
  const Object object =
      only(parse("intersection { union { box { 0, 1 translate x } merge { sphere { 0, 1 } torus { 1, 0.2 } } "
                 "translate y } plane { y, 0 inverse } translate z }"));
  CHECK(object.transform.point({0, 0, 0}) == Vec3(0, 0, 1));
  const Csg& csg = csg_of(object);
  REQUIRE(csg.parts.size() == 2);
  CHECK(csg.parts[1].inverse);
  CHECK(csg.parts[0].transform.point({0, 0, 0}) == Vec3(0, 1, 0));
  const Csg& inner = csg_of(csg.parts[0]);
  CHECK(inner.operation == Csg::Operation::union_);
  REQUIRE(inner.parts.size() == 2);
  CHECK(inner.parts[0].transform.point({0, 0, 0}) == Vec3(1, 0, 0));
  CHECK(csg_of(inner.parts[1]).operation == Csg::Operation::merge);
}

TEST_CASE("plain unions come apart, others do not") {
  const Scene scene =
      parse("union { difference { sphere { 0, 1 } box { 0, 1 } translate y } sphere { 0, 2 } "
            "union { sphere { 0, 3 } inverse } union { sphere { 0, 4 } clipped_by { box { 0, 1 } } } "
            "split_union off translate x }");
  REQUIRE(scene.objects.size() == 4);
  CHECK(csg_of(scene.objects[0]).operation == Csg::Operation::difference);
  CHECK(scene.objects[0].transform.point({0, 0, 0}) == Vec3(1, 1, 0));
  CHECK(std::holds_alternative<Sphere>(scene.objects[1].shape));
  CHECK(csg_of(scene.objects[2]).operation == Csg::Operation::union_);
  CHECK(scene.objects[2].inverse);
  CHECK(csg_of(scene.objects[3]).operation == Csg::Operation::union_);
  CHECK(scene.objects[3].clipped_by->size() == 1);
}

TEST_CASE("parts of CSG inherit textures and flags, cutting ones too") {
  const Scene scene =
      parse("#declare T = texture { pigment { rgb 0.5 } } #default { pigment { rgb 0.25 } } "
            "difference { sphere { 0, 1 } box { 0, 1 } box { 0, 2 pigment { rgb 1 } } texture { T } "
            "no_shadow } merge { sphere { 0, 1 } union { box { 0, 1 } pigment { rgb 2 } } }");
  REQUIRE(scene.objects.size() == 2);
  const Csg& difference = csg_of(scene.objects[0]);
  CHECK(red(scene, difference.parts.at(0)) == 0.5);
  CHECK(red(scene, difference.parts.at(1)) == 0.5);
  CHECK(red(scene, difference.parts.at(2)) == 1);
  CHECK(difference.parts[2].no_shadow);
  const Csg& merge = csg_of(scene.objects[1]);
  CHECK(red(scene, merge.parts.at(0)) == 0.25);
  CHECK(red(scene, csg_of(merge.parts.at(1)).parts.at(0)) == 2);
  CHECK_FALSE(merge.parts[0].no_shadow);
}

TEST_CASE("CSG is one solid: its parts share an interior") {
  const Scene scene =
      parse("merge { sphere { 0, 1 } union { sphere { 0, 2 } sphere { 0, 3 interior { ior 1.3 } } } }"
            "merge { sphere { 0, 1 } sphere { 0, 2 } interior { ior 1.5 } } merge { sphere { 0, 1 } }");
  REQUIRE(scene.objects.size() == 3);
  const Csg& first = csg_of(scene.objects[0]);
  const Csg& inner = csg_of(first.parts[1]);
  CHECK(first.parts[0].interior == inner.parts[0].interior);
  CHECK(scene.interiors[first.parts[0].interior].ior == 1);
  CHECK(scene.interiors[inner.parts[1].interior].ior == 1.3);
  const Csg& second = csg_of(scene.objects[1]);
  CHECK(second.parts[0].interior == second.parts[1].interior);
  CHECK(scene.interiors[second.parts[0].interior].ior == 1.5);
  CHECK(csg_of(scene.objects[2]).parts[0].interior != first.parts[0].interior);
  const Scene old = parse("merge { sphere { 0, 1 finish { ior 1.2 } } sphere { 0, 2 } }");
  const Csg& parts = csg_of(only(old));
  CHECK(old.interiors[parts.parts[0].interior].ior == 1.2);
  CHECK(old.interiors[parts.parts[1].interior].ior == 1);
}

TEST_CASE("inverse turns every time") {
  const auto is_inverse = [](const char* text) { return only(parse(text)).inverse; };
  CHECK(is_inverse("sphere { 0, 1 inverse }"));
  CHECK_FALSE(is_inverse("sphere { 0, 1 inverse inverse }"));
  CHECK(is_inverse("merge { sphere { 0, 1 } box { 0, 1 } inverse }"));
  CHECK_FALSE(is_inverse("triangle { 0, x, y inverse }"));
  CHECK_FALSE(is_inverse("mesh { triangle { 0, x, y } inverse }"));
}

TEST_CASE("a name alone is the whole CSG") {
  const Scene scene =
      parse("#declare S = sphere { 0, 1 pigment { rgb 1 } } difference { S pigment { rgb 0.5 } "
            "translate x }");
  CHECK(std::holds_alternative<Sphere>(only(scene).shape));
  CHECK(red(scene, only(scene)) == 0.5);
  CHECK(scene.objects[0].transform.point({0, 0, 0}) == Vec3(1, 0, 0));
  CHECK(error_line("#declare S = sphere { 0, 1 } union { S S }") == "scene.pov:1:40: error: unexpected 'S'");
}

TEST_CASE("what clips is placed as the object is") {
  const Scene scene =
      parse("union { sphere { 0, 1 translate x clipped_by { box { 0, 1 } plane { y, 0 translate z } "
            "translate 2*x } clipped_by { sphere { 0, 3 inverse } } rotate 90*y } translate y }");
  const Object object = only(scene);
  CHECK(std::holds_alternative<Sphere>(object.shape));
  REQUIRE(object.clipped_by);
  const std::vector<Object>& clips = *object.clipped_by;
  REQUIRE(clips.size() == 3);
  CHECK(std::holds_alternative<Box>(clips[0].shape));
  CHECK(clips[0].transform.point({0, 0, 0}).y == Approx(1));
  CHECK(clips[0].transform.point({0, 0, 0}).z == Approx(-2));
  CHECK(clips[1].transform.point({0, 0, 0}).x == Approx(1));
  CHECK(clips[1].transform.point({0, 0, 0}).z == Approx(-2));
  CHECK(clips[2].transform.point({0, 0, 0}) == Vec3(0, 1, 0));
  CHECK(clips[2].inverse);
  CHECK(scene.materials.size() == 1);
  CHECK(scene.interiors.size() == 1);
  CHECK_NOTHROW(validate(scene));
}

TEST_CASE("parts and CSG can be clipped, by CSG too") {
  const Scene scene =
      parse("#declare C = intersection { box { -1, 1 } plane { x, 0 } clipped_by { sphere { 0, 9 } } } "
            "merge { sphere { 0, 1 translate x clipped_by { C } translate y } sphere { 0, 2 } "
            "clipped_by { object { C translate z } } translate <1, 2, 3> }");
  const Object object = only(scene);
  REQUIRE(object.clipped_by->size() == 1);
  const Object& outer = object.clipped_by->front();
  CHECK(outer.transform.point({0, 0, 0}) == Vec3(1, 2, 4));
  CHECK(csg_of(outer).parts.size() == 2);
  REQUIRE(outer.clipped_by);
  CHECK(outer.clipped_by->front().transform.point({0, 0, 0}) == Vec3(1, 2, 4));
  const Object& part = csg_of(object).parts.at(0);
  CHECK(part.transform.point({0, 0, 0}) == Vec3(1, 1, 0));
  CHECK(part.clipped_by->front().transform.point({0, 0, 0}) == Vec3(0, 1, 0));
  CHECK_NOTHROW(validate(scene));
}

TEST_CASE("bounded_by does nothing but lend its objects to clipped_by") {
  CHECK_FALSE(only(parse("sphere { 0, 1 bounded_by { box { 0, 1 } } }")).clipped_by);
  CHECK_FALSE(only(parse("sphere { 0, 1 bounded_by { ovus { 0, 1 } scale 2 } }")).clipped_by);
  const Object linked =
      only(parse("sphere { 0, 1 bounded_by { box { 0, 1 } } translate x clipped_by { bounded_by } }"));
  CHECK(linked.clipped_by->at(0).transform.point({0, 0, 0}) == Vec3(1, 0, 0));
  CHECK(only(parse("sphere { 0, 1 clipped_by { box { 0, 1 } } bounded_by { clipped_by } }"))
            .clipped_by->size() == 1);
  CHECK_FALSE(only(parse("sphere { 0, 1 clipped_by { bounded_by } }")).clipped_by);
}

TEST_CASE("light sources in CSG shine and cut nothing") {
  const Scene scene = parse("difference { union { sphere { 0, 1 } light_source { x, 1 } translate y } "
                            "light_source { 0, 2 } box { 0, 1 } scale 2 }");
  REQUIRE(scene.lights.size() == 2);
  CHECK(scene.lights[0].location == Vec3(2, 2, 0));
  const Csg& csg = csg_of(only(scene));
  CHECK(csg.parts.size() == 2);
  CHECK(csg_of(csg.parts[0]).parts.size() == 1);
  CHECK(error_line("difference { light_source { x, 1 } sphere { 0, 1 } }") ==
        "scene.pov:1:14: error: a light source that others are taken from is not supported yet");
  CHECK(error_line("sphere { 0, 1 clipped_by { light_source { x, 1 } } }") ==
        "scene.pov:1:28: error: a light source has no inside");
}

TEST_CASE("empty CSG is nothing") {
  CHECK(parse("union { } intersection { } difference { union { } merge { } }").objects.empty());
  const Object cut = only(parse("intersection { sphere { 0, 1 } union { } }"));
  CHECK(csg_of(cut).parts.size() == 2);
  CHECK(csg_of(only(parse("difference { box { 0, 1 } sphere { 0, 0 } }"))).parts.size() == 2);
}

TEST_CASE("meshes with an inside are parts of CSG, and clip") {
  const std::string mesh =
      "#declare M = mesh { triangle { 0, x, y } triangle { 0, y, z } inside_vector <0, 0, 2> }\n";
  const Scene scene =
      parse(mesh + "intersection { box { 0, 1 } object { M inverse translate x } translate y } "
                   "sphere { 0, 1 clipped_by { object { M scale 2 } } } "
                   "object { M clipped_by { sphere { 0, 1 } } }");
  REQUIRE(scene.objects.size() == 3);
  const Object& part = csg_of(scene.objects[0]).parts.at(1);
  const auto mesh_of = [](const Object& object) {
    return std::get<std::shared_ptr<const Mesh>>(object.shape);
  };
  CHECK(mesh_of(part)->inside_vector == Vec3(0, 0, 2));
  CHECK(part.inverse);
  CHECK(part.transform.point({0, 0, 0}) == Vec3(1, 0, 0));
  const Object& clip = scene.objects[1].clipped_by->at(0);
  CHECK(mesh_of(clip) == mesh_of(part));
  CHECK(clip.transform.point({0, 0, 1}) == Vec3(0, 0, 2));
  CHECK(mesh_of(scene.objects[2]) == mesh_of(part));
  CHECK(scene.objects[2].clipped_by->size() == 1);
  CHECK_NOTHROW(validate(scene));
}

TEST_CASE("triangles in CSG lie where they do without it") {
  const Scene scene =
      parse("difference { smooth_triangle { 0, z, x, z, y, z scale 2 translate x } box { 2, 3 } "
            "scale <1, 2, 3> rotate 90*y } triangle { 0, x, y clipped_by { plane { x, 0 } } }");
  REQUIRE(scene.objects.size() == 2);
  const Object& part = csg_of(scene.objects[0]).parts.at(0);
  const auto& mesh = *std::get<std::shared_ptr<const Mesh>>(part.shape);
  CHECK_FALSE(mesh.has_inside());
  const Vec3 corner = part.transform.then(scene.objects[0].transform).point(Vec3(mesh.vertices.at(2)));
  CHECK(corner.x == Approx(0).margin(1e-6));
  CHECK(corner.y == Approx(4));
  CHECK(corner.z == Approx(-1));
  CHECK(scene.objects[1].clipped_by->size() == 1);
}

TEST_CASE("meshes without an inside are parts of CSG, but clip nothing") {
  const std::string mesh =
      "#declare M = mesh { triangle { 0, x, y } triangle { 0, y, z } inside_vector 0 }\n";
  const auto refused = [&](const std::string& scene) { return error_line(mesh + scene); };
  for (const char* scene :
       {"intersection { box { 0, 1 } object { M } }",
        "merge { union { sphere { 0, 1 } object { M } } box { 0, 1 } }",
        "union { sphere { 0, 1 } M inverse }", "union { object { M } clipped_by { box { 0, 1 } } }",
        "difference { object { M } box { 0, 1 } }", "object { M clipped_by { box { 0, 1 } } }"})
    CHECK(refused(scene).empty());
  const Object part =
      csg_of(parse(mesh + "intersection { box { 0, 1 } object { M inverse } }").objects[0]).parts.at(1);
  CHECK_FALSE(part.inverse);
  CHECK_FALSE(std::get<std::shared_ptr<const Mesh>>(part.shape)->has_inside());
  CHECK(refused("sphere { 0, 1 clipped_by { object { M } } }") ==
        "scene.pov:2:28: error: a mesh without 'inside_vector' in 'clipped_by' is not supported yet");
  CHECK(error_line("sphere { 0, 1 clipped_by { triangle { 0, x, y } } }") ==
        "scene.pov:1:28: error: a triangle in 'clipped_by' is not supported yet");
  CHECK(test::error(mesh + "#declare A = sphere { 0, 1 clipped_by { object { M } } }\nA") ==
        "scene.pov:2:41: error: a mesh without 'inside_vector' in 'clipped_by' is not supported yet\n"
        "    used at scene.pov:3:1");
  const Scene scene =
      parse(mesh + "union { M } union { object { M } difference { sphere { 0, 1 } box { 0, 1 } } }");
  REQUIRE(scene.objects.size() == 3);
  CHECK(std::get<std::shared_ptr<const Mesh>>(scene.objects[0].shape) ==
        std::get<std::shared_ptr<const Mesh>>(scene.objects[1].shape));
}

TEST_CASE("the project's own scenes are sound") {
  for (const char* name : {"shapes.pov", "csg.pov", "mesh-csg.pov"}) {
    const Scene scene = parse_file(std::string(CELLTRACE_SOURCE_DIR "/tests/scenes/") + name);
    CHECK(scene.objects.size() >= 10);
    CHECK_NOTHROW(validate(scene));
  }
}

TEST_CASE("parts without a texture look like what they cut") {
  const std::string red = " texture { pigment { rgb x } } ", green = " texture { pigment { rgb y } } ";
  // Of the part with this index; null: it depends on where.
  const auto colour = [](const std::string& text, std::size_t part) {
    const Scene scene = parse(text);
    const Object& object = std::get<std::shared_ptr<const Csg>>(scene.objects[0].shape)->parts[part];
    const Material& material = scene.materials[object.material];
    return material.map ? std::nullopt : std::optional(material.pigment.rgb);
  };
  const auto box = [&](const std::string& first, const std::string& behind) {
    return colour("difference { " + first + " box { 0, 2 } cutaway_textures " + behind + " }", 1);
  };
  const std::string ball = "sphere { 0, 1" + red + "}";
  CHECK(box(ball, "") == Vec3(1, 0, 0));
  CHECK(box(ball, green) == Vec3(0, 1, 0));
  CHECK(box("sphere { 0, 1 }", "") == Vec3(0));
  CHECK(box("intersection { " + ball + "plane { x, 0 } }", "") == Vec3(1, 0, 0));
  CHECK(box("union { " + ball + "sphere { x, 1" + red + "} }", "") == std::nullopt); // two definitions
  CHECK(box("union { sphere { 0, 1 } sphere { x, 1 }" + red + "}", "") == Vec3(1, 0, 0));
  CHECK(box("merge { " + ball + "sphere { x, 1" + green + "} }", "") == std::nullopt);
  CHECK(colour("intersection { " + ball + "plane { x, 0 } cutaway_textures }", 1) == Vec3(1, 0, 0));
  CHECK(colour("difference { " + ball + "box { 0, 2 } cutaway_textures off }", 1) == Vec3(0));
  const Scene black = parse("difference { sphere { 0, 1 } box { 0, 2" + red + "} cutaway_textures }");
  const auto& parts = std::get<std::shared_ptr<const Csg>>(black.objects[0].shape)->parts;
  CHECK(black.materials[parts[0].material].finish.diffuse == 0);

  // Where a point is in both spheres, each texture counts half: maps by place lead to their average.
  const std::function<const PatternMap<Material>*(const Material&)> average_in =
      [&](const Material& material) -> const PatternMap<Material>* {
    if (!material.map || material.map->is_average) return material.map.get();
    for (const auto& entry : material.map->entries)
      if (const PatternMap<Material>* found = average_in(entry.value)) return found;
    return nullptr;
  };
  const Scene two =
      parse("difference { union { " + ball + "sphere { x, 1" + green + "} } box { 0, 2 } cutaway_textures }");
  const Object& cut = std::get<std::shared_ptr<const Csg>>(two.objects[0].shape)->parts[1];
  const PatternMap<Material>* const average = average_in(two.materials[cut.material]);
  REQUIRE(average != nullptr);
  REQUIRE(average->entries.size() == 2);
  CHECK(average->entries[0].position == average->entries[1].position);
  CHECK(average->entries[0].value.pigment.rgb == Vec3(1, 0, 0));
  CHECK(average->entries[1].value.pigment.rgb == Vec3(0, 1, 0));

  CHECK(error_line("union { sphere { 0, 1 } sphere { x, 1 } cutaway_textures }") ==
        "scene.pov:1:41: error: 'cutaway_textures' is for intersections and differences alone");
  const auto many = [](int count) {
    std::string text = "difference { union { ";
    for (int i = 0; i < count; ++i)
      text += "sphere { " + std::to_string(i) + ", 1 pigment { rgb " + std::to_string(i) + " } }";
    return text + "} plane { y, 0 } cutaway_textures }";
  };
  CHECK(error_line(many(64)).empty());
  CHECK(error_line(many(65)).ends_with(
      "error: 'cutaway_textures' of more than 64 textures is not supported yet"));
}

TEST_CASE("what CSG lacks is an error") {
  CHECK(error_line("difference { sphere { 0, 1 } parametric { x, y, z, 1 } }") ==
        "scene.pov:1:30: error: 'parametric' is not supported yet");
  CHECK(error_line("merge { sphere { 0, 1 } box { 0, 1 scale 1e-200 } }") ==
        "scene.pov:1:1: error: this object's transformation is singular: it has no inverse");
  CHECK(error_line("sphere { 0, 1 clipped_by { } }") == "scene.pov:1:28: error: unexpected '}'");
}
