// triangle, smooth_triangle, mesh and mesh2.
#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "pov/parsing.hpp"

using namespace celltrace;
using test::error_line;
using test::parse;

namespace {

const Mesh& mesh_of(const Scene& scene, std::size_t object = 0) {
  return *std::get<std::shared_ptr<const Mesh>>(scene.objects.at(object).shape);
}

const std::string kSquare = "mesh2 { vertex_vectors { 4, 0, x, x+y, y } ";

} // namespace

TEST_CASE("triangles alone") {
  const Scene scene = parse("triangle { 0, x, y translate z pigment { rgb 1 } } "
                            "smooth_triangle { 0, -z, x, <0, 1, -1>, y, <0, 0, -2> }");
  REQUIRE(scene.objects.size() == 2);
  CHECK(mesh_of(scene, 0).triangles.at(0).normal[0] == kNoIndex);
  CHECK(mesh_of(scene, 0).triangles.at(0).material[0] == kNoIndex);
  CHECK(mesh_of(scene, 0).vertices.at(1) == Vec3f(1, 0, 1)); // moved itself, as in POV-Ray
  CHECK(scene.objects[0].transform.is_identity());
  REQUIRE(mesh_of(scene, 1).normals.size() == 3);
  CHECK(mesh_of(scene, 1).normals[2] == Vec3f(0, 0, -1));
  CHECK(mesh_of(scene, 1).normals[1].y == Approx(0.70710678));
  CHECK(parse("triangle { 0, x, 2*x }").objects.empty());
}

TEST_CASE("a mesh keeps its triangles' own textures") {
  const Scene scene =
      parse("#declare T = texture { pigment { rgb 1 } } mesh { triangle { 0, x, y texture { T } } "
            "triangle { 0, x, z } triangle { 0, x, x } smooth_triangle { 0, y, x, y, z, y } "
            "triangle { 0, x, y uv_vectors <0, 0>, <1, 0>, <0, 1> texture { T } } pigment { rgb 0.5 } }");
  const Mesh& mesh = mesh_of(scene);
  REQUIRE(mesh.triangles.size() == 4);
  CHECK(scene.materials[mesh.triangles[0].material[0]].pigment.rgb.x == 1);
  CHECK(mesh.triangles[1].material[0] == kNoIndex);
  CHECK(mesh.triangles[2].normal[0] == kNoIndex); // three equal normals
  CHECK(mesh.triangles[3].material[2] == mesh.triangles[0].material[0]);
  CHECK(scene.materials[scene.objects[0].material].pigment.rgb.x == 0.5);
}

TEST_CASE("a mesh's triangles with a texture at each corner") {
  const std::string named =
      "#declare A = texture { pigment { rgb x } } #declare B = texture { pigment { rgb y } } "
      "#declare C = texture { pigment { rgb z } } mesh { ";
  const Scene scene =
      parse(named + "triangle { 0, x, y texture_list { A, B, C } } "
                    "smooth_triangle { 0, y, x, x, y, z texture { A } texture_list { C B A } } "
                    "triangle { 0, x, y uv_vectors 0, x, y texture_list { A A B } } }");
  const Mesh& mesh = mesh_of(scene);
  REQUIRE(mesh.triangles.size() == 3);
  const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(scene.materials[mesh.triangles[0].material[i]].pigment.rgb == axes[i]);
    CHECK(scene.materials[mesh.triangles[1].material[i]].pigment.rgb == axes[2 - i]);
    CHECK(scene.materials[mesh.triangles[2].material[i]].pigment.rgb == axes[i / 2]);
  }
  CHECK(error_line("#declare A = texture { } mesh { triangle { 0, x, y texture_list { A, A } } }") ==
        "scene.pov:1:52: error: the texture_list of a triangle has three textures, one for each corner");
  CHECK(error_line(named + "triangle { 0, x, y texture_list { A, B, C } texture { A } } }")
            .find("unexpected") != std::string::npos);
}

TEST_CASE("surface coordinates of triangles") {
  const Scene scene =
      parse("mesh { triangle { 0, x, y } triangle { 0, x, x uv_vectors <9, 9>, <9, 9>, <9, 9> } "
            "triangle { 0, x, y uv_vectors <0.5, 1>, <2, 3>, <4, 5> } smooth_triangle { 0, y, x, z, y, z } } "
            "mesh { triangle { 0, x, y } } triangle { <1, 2, 0>, x, y translate 2*x pigment { uv_mapping "
            "checker } }");
  const Mesh& mesh = mesh_of(scene);
  REQUIRE(mesh.triangles.size() == 3);
  REQUIRE(mesh.coordinates.size() == 3);
  CHECK(mesh.coordinates[0].corner[2] == Vec2f(0, 0)); // without, they are 0
  CHECK(mesh.coordinates[1].corner[0] == Vec2f(0.5, 1));
  CHECK(mesh.coordinates[1].corner[2] == Vec2f(4, 5));
  CHECK(mesh.coordinates[2].corner[1] == Vec2f(0, 0));
  CHECK(mesh_of(scene, 1).coordinates.empty());
  REQUIRE(mesh_of(scene, 2).coordinates.size() == 1); // alone it has those of all other shapes
  CHECK(mesh_of(scene, 2).coordinates[0].corner[0] == Vec2f(3, 2));
  CHECK_THAT(error_line("triangle { 0, x, y uv_vectors 0, x, y }"), Catch::Contains("uv_vectors"));
}

TEST_CASE("instances share their mesh") {
  const Scene scene =
      parse("#declare M = mesh { triangle { 0, x, y } } #for (I, 1, 5) object { M translate I*x } #end "
            "union { object { M } object { M pigment { rgb 1 } } }");
  REQUIRE(scene.objects.size() == 7);
  for (std::size_t i = 1; i < 7; ++i)
    CHECK(&mesh_of(scene, i) == &mesh_of(scene, 0));
  CHECK(scene.objects[6].material != scene.objects[0].material);
}

TEST_CASE("mesh2") {
  SECTION("flat") {
    const Scene scene = parse(kSquare + "face_indices { 2, <0, 1, 2>, <0, 2, 3> } }");
    const Mesh& mesh = mesh_of(scene);
    CHECK(mesh.vertices.size() == 4);
    REQUIRE(mesh.triangles.size() == 2);
    CHECK(mesh.triangles[1].vertex[2] == 3);
    CHECK(mesh.triangles[1].normal[0] == kNoIndex);
  }
  SECTION("as many normals as vertices belong to them") {
    const Scene scene =
        parse(kSquare +
              "normal_vectors { 4, -z, <1, 0, -1>, -z*2, -z } face_indices { 2, <0, 1, 2>, <0, 2, 3> } }");
    const Mesh& mesh = mesh_of(scene);
    CHECK(mesh.triangles.at(0).normal[1] == 1);
    CHECK(mesh.triangles.at(1).normal[0] == kNoIndex); // three equal normals once they have length one
  }
  SECTION("faces beyond the normal indices are flat") {
    const Scene scene =
        parse(kSquare + "normal_vectors { 2, -z, <1, 0, -1> } face_indices { 2, <0, 1, 2>, <0, 2, 3> } "
                        "normal_indices { 1, <0, 1, 0> } }");
    const Mesh& mesh = mesh_of(scene);
    CHECK(mesh.triangles.at(0).normal[1] == 1);
    CHECK(mesh.triangles.at(1).normal[1] == kNoIndex);
  }
  SECTION("textures: none, one or three a face") {
    const Scene scene = parse(
        kSquare + "texture_list { 2, texture { pigment { rgb 1 } } texture { pigment { rgb 0.5 } } } "
                  "face_indices { 3, <0, 1, 2>, <0, 2, 3>, 1 <1, 2, 3>, 0, 1, 1 } pigment { rgb 0.1 } }");
    const auto& triangles = mesh_of(scene).triangles;
    const auto red = [&](Index material) { return scene.materials.at(material).pigment.rgb.x; };
    CHECK(triangles.at(0).material[0] == kNoIndex);
    CHECK(red(triangles.at(1).material[0]) == 0.5);
    CHECK(red(triangles.at(1).material[2]) == 0.5);
    CHECK(red(triangles.at(2).material[0]) == 1);
    CHECK(red(triangles.at(2).material[1]) == 0.5);
  }
  SECTION("the rest of it does not matter to solid colours") {
    const Scene scene =
        parse(kSquare + "uv_vectors { 1, <0, 0> } face_indices { 2, <0, 1, 2>, <0, 0, 3> } "
                        "uv_indices { 2, <0, 0, 0>, <0, 0, 0> } inside_vector z no_shadow scale 2 }");
    CHECK(mesh_of(scene).triangles.size() == 1); // one is degenerate
    CHECK(mesh_of(scene).inside_vector == Vec3(0, 0, 1));
    CHECK(scene.objects[0].no_shadow);
  }
}

TEST_CASE("surface coordinates of mesh2") {
  const std::string faces = "face_indices { 3, <0, 1, 2>, <0, 1, 1>, <0, 2, 3> } ";
  const auto coordinates = [&](const std::string& lists) {
    return mesh_of(parse(kSquare + faces + lists + "}")).coordinates;
  };
  CHECK(coordinates("").empty());
  const auto by_vertex = coordinates("uv_vectors { 4, 0, <1, 0>, <1, 2>, <0, 2> } ");
  REQUIRE(by_vertex.size() == 2); // the second face is none
  CHECK(by_vertex[0].corner[2] == Vec2f(1, 2));
  CHECK(by_vertex[1].corner[2] == Vec2f(0, 2));
  const auto by_index = coordinates("uv_indices { 3, <2, 1, 0>, <0, 0, 0>, <1, 1, 2> } "
                                    "uv_vectors { 3, 0, <1, 0>, <1, 2> } ");
  REQUIRE(by_index.size() == 2);
  CHECK(by_index[0].corner[0] == Vec2f(1, 2));
  CHECK(by_index[1].corner[1] == Vec2f(1, 0));
  const auto error = [&](const std::string& lists) { return error_line(kSquare + faces + lists + "}"); };
  CHECK_THAT(error("uv_vectors { 2, 0, x } "), Catch::Contains("needs uv_indices"));
  CHECK_THAT(error("uv_vectors { 2, 0, x } uv_indices { 1, <0, 0, 1> } "),
             Catch::Contains("1 uv_indices for 3 faces"));
  CHECK_THAT(error("uv_vectors { 1, x } uv_indices { 3, 0, 0, <0, 0, 1> } "),
             Catch::Contains("no uv vector 1"));
  CHECK_THAT(error("uv_vectors { 4, 0, x, y, 1e300 } "), Catch::Contains("too large"));
}

TEST_CASE("a mesh has the last of its inside vectors") {
  CHECK_FALSE(mesh_of(parse("mesh { triangle { 0, x, y } }")).has_inside());
  CHECK_FALSE(mesh_of(parse("mesh { triangle { 0, x, y } inside_vector 0 }")).has_inside());
  CHECK(mesh_of(parse("mesh { inside_vector x triangle { 0, x, y } inside_vector <1, 2> }")).inside_vector ==
        Vec3(1, 2, 0));
}

TEST_CASE("a mesh without triangles, or with an index out of range, is an error") {
  CHECK(error_line("mesh { }") == "scene.pov:1:1: error: this mesh has no triangles");
  CHECK(error_line(kSquare + "}") == "scene.pov:1:1: error: this mesh has no triangles");
  CHECK(error_line("mesh2 { vertex_vectors { 2000000000, 0 } }") ==
        "scene.pov:1:24: error: this list announces 2000000000 entries, but has 1");
  CHECK(error_line(kSquare + "face_indices { 3, <0, 1, 2> } }") ==
        "scene.pov:1:57: error: this list announces 3 entries, but has 1");
  CHECK(error_line(kSquare + "face_indices { 1, <0, 1, 4> } }") ==
        "scene.pov:1:1: error: mesh2 has no vertex 4, there are 4");
  CHECK(error_line(kSquare + "face_indices { 1, <0, 1, -1> } }") ==
        "scene.pov:1:1: error: mesh2 has no vertex -1, there are 4");
  CHECK(error_line(kSquare + "face_indices { 1, <0, 1, 2>, 0 } }") ==
        "scene.pov:1:1: error: mesh2 has no texture 0, there are 0");
  CHECK(
      error_line(kSquare +
                 "normal_vectors { 1, z } face_indices { 1, <0, 1, 2> } normal_indices { 1, <0, 0, 1> } }") ==
      "scene.pov:1:1: error: mesh2 has no normal 1, there are 1");
  CHECK(error_line(kSquare + "face_indices { 1, <0, 1") ==
        "scene.pov:1:67: error: unexpected end of the scene, expected '>'");
  CHECK(error_line("triangle { 0, 1e300*x, y }") ==
        "scene.pov:1:1: error: a mesh has a coordinate that is too large");
}

TEST_CASE("a triangle that is far away keeps its digits, a mesh those that it has in POV-Ray") {
  const std::string place = "#declare O = <500000, 0, 5400000>; ";
  const std::string corners = "O + 0.1*x, O + <1, 0.3, 0.7>, O + <0, 1, 0.2>";
  const auto vertex = [&](const std::string& text, std::size_t number) {
    const Scene scene = parse(place + text);
    return scene.objects.at(0).transform.point(Vec3(mesh_of(scene).vertices.at(number)));
  };
  CHECK(glm::distance(vertex("triangle { " + corners + " }", 0), Vec3(500000.1, 0, 5400000)) < 1e-6);
  CHECK(glm::distance(vertex("triangle { " + corners + " }", 1), Vec3(500001, 0.3, 5400000.7)) < 1e-6);
  CHECK(vertex("mesh { triangle { " + corners + " } }", 1) == Vec3(Vec3f(500001, 0.3, 5400000.7)));
  CHECK(parse("triangle { 1000, 1001*x, 1001*z }").objects.at(0).transform.is_identity());
}
