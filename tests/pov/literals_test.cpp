// mesh2's lists, matrices and the arguments of shapes, read as literals and by the grammar: the scene, or the
// error and its place, must be the same. A sum in front keeps a whole list from being read as literals.
#include <bit>
#include <random>
#include <sstream>

#include <catch2/catch.hpp>

#include "pov/literals.hpp"
#include "pov/parsing.hpp"

using namespace celltrace;
using test::parse;

namespace {

constexpr std::string_view kByGrammar = "0+", kByLiterals = "  ";

/// A list's text, with % where its first entry starts.
std::string with_first(std::string text, std::string_view first) {
  for (std::size_t at = 0; (at = text.find('%', at)) != text.npos; at += first.size())
    text.replace(at, 1, first);
  return text;
}

/// Everything a mesh holds, to the bit, or the error.
std::string outcome(const std::string& text) {
  try {
    const Scene scene = parse(text);
    if (scene.objects.empty()) return "nothing that can be seen";
    const Mesh& mesh = *std::get<std::shared_ptr<const Mesh>>(scene.objects.at(0).shape);
    std::ostringstream all;
    for (const auto* list : {&mesh.vertices, &mesh.normals})
      for (const Vec3f& v : *list)
        for (int i = 0; i < 3; ++i)
          all << std::bit_cast<std::uint32_t>(v[i]) << ' ';
    for (const Mesh::Triangle& triangle : mesh.triangles)
      for (int corner = 0; corner < 3; ++corner)
        all << triangle.vertex[corner] << '/' << triangle.normal[corner] << '/' << triangle.material[corner]
            << ' ';
    return all.str();
  } catch (const SceneError& error) {
    return error.what();
  }
}

/// Returns whether the text is a scene.
bool check_same(const std::string& text) {
  CAPTURE(text);
  const std::string by_grammar = outcome(with_first(text, kByGrammar));
  CHECK(outcome(with_first(text, kByLiterals)) == by_grammar);
  return by_grammar.find("error") == by_grammar.npos;
}

std::string mesh(const std::string& vertices, const std::string& faces = "%1, <0, 1, 2>") {
  return "#declare Z = 0;\n#macro V() <7, 8, 9> #end\nmesh2 {\n vertex_vectors {" + vertices +
         "}\n texture_list { 2, texture { pigment { rgb 1 } } texture { } }\n face_indices {" + faces +
         "} }\n";
}

} // namespace

TEST_CASE("literal lists are what the grammar makes of them") {
  for (const std::string vertices : {
           "%3, <0, 0, 0>, <1, 0, 0>, <0, 1, 0>",
           "%3,\n<0,0,0>,\r\n<1,0,0>,\r<0,1,0>\n",
           "%3 <0, 0, 0> <1, 0, 0> <0, 1, 0>",
           "%3.7, <-0, +.5, 1.>, // <9, 9, 9>,\n <1e-3,\t-1E+2 , 0.1>,<\t0, 1, 16777217>",
           "%3, <0.1, 0.30000000000000004, 123456789012345678901234567890>, <1e-320, 5e-324, 1>, <1e-400, 2, "
           "3>",
           "%3, <0, 0, 0>, <1, 0, 0> + Z, <0, 1, 0> -<1, 2, 3> * 2",
           "%4, <0, 0, 0>, <1, 0, 0>, V(), #if (Z) <1, 1, 1> #else <2, 2, 2> #end",
           "%4, <0, 0, 0>, <1, 2>, <1, 2, 3, 4>, <1, 2, 3, 4, 5>",
           "%4, 0, 1 <0, 1, 0> /* <5, 5, 5> */, 2",
           "%3, <0, 0, 0>, <1, 0, 0>.x, <0, 1, 0>,",
       })
    CHECK(check_same(mesh(vertices)));
  CHECK(check_same(mesh("%3, <0, 0, 0>, <1, 0, 0>, <0, 1, 0>",
                        "%4, <0, 1, 2>, 1, <0, 2, 1>, 0, 1, 1, <0.9, 1, 2> <2, 1, 0>")));
}

TEST_CASE("literal lists have the grammar's errors, at the same place") {
  for (const std::string vertices : {
           "",
           "%",
           "%3",
           "%3, ,",
           "%3, <0, 0, 0>,, <1, 0, 0>",
           "%3, <0, 0, 0>, <1, 0, 0>",
           "%3, <0, 0, 0>, <1, 0, 0>, <0, 1, 0>, <0, 1, 0>",
           "%3, <0, 0, 0>,\n <1, 0, 1e999>,\n <0, 1, 0>",
           "%3, <0, 0, 0>,\n <1, , 0>, <0, 1, 0>",
           "%3, <0, 0, 0>,\n\n <1, 0, 0x>, <0, 1, 0>",
           "%3, <0, 0, 0>,\r\r\n <1, 0, 0>, <0, 1, 0>; <0, 0, 0>",
           "%3, <0, 0, 0>, 1 / 0, <0, 1, 0>",
           "%3, <0, 0, 0>, <1>, <0, 1, 0>",
           "%3, <0, 0, 0>, <1, 0, 0, <0, 1, 0>",
           "%3, <0, 0, 0>, \x01 <1, 0, 0>",
           "%3, <0, 0, 0>, #else <1, 0, 0>",
           "%<1, 2, 3>, <0, 0, 0>",
           "%1e9, <0, 0, 0>",
           "%3, <0, 0, 0>, 1e, <0, 0, 0>",
           "%3, <0, 0, 0>, <1, 2, 3> /* <0, 1, 0>",
       })
    check_same(mesh(vertices));
  for (const std::string faces :
       {"%1, <0, 1, 3>", "%1, <0, 1, -1>", "%1, 0, <0, 1, 2>", "%1, <0, 1, 2>, 0, 1",
        "%1, <0, 1, 2>, 0, 1, 1, 1", "%1, <0, 1, 2>, 2", "%1, <0, 1, 1e30>"})
    check_same(mesh("%3, <0, 0, 0>, <1, 0, 0>, <0, 1, 0>", faces));
}

TEST_CASE("lists put together at random are the same read either way") {
  const std::string pieces[] = {"<1, 2, 3>",  "<0.5,-1.25,+3e1>",
                                "<1, 2>",     "4",
                                "0.25",       "-1",
                                ",",          ",",
                                ",\n",        ",\r\n",
                                " ",          "// c\n",
                                "/* c */",    "Z",
                                "+",          "*",
                                "V()",        "<1,\n2, 3>",
                                "< 1 ,2,3 >", "1.x",
                                "<",          ">",
                                "(1)",        "#if (1)"};
  std::mt19937 random(7);
  int scenes = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string list;
    int vectors = 3;
    for (unsigned length = random() % 8; length-- > 0;) {
      const auto chosen = random() % 3 == 0 ? random() % std::size(pieces) : random() % 2 * 6;
      list += pieces[chosen];
      vectors += chosen <= 2 || chosen >= 16;
    }
    std::string counted = "%";
    counted += std::to_string(vectors);
    counted += ", <9, 9, 9>, <1, 0, 0>, <0, 1, 0> ";
    scenes += check_same(mesh(counted + list));
    check_same(mesh("%3, <0, 0, 0>, <1, 0, 0>, <0, 1, 0>", "%1, <0, 1, 2>" + list));
  }
  CHECK(scenes > 200);
}

TEST_CASE("a literal list may not be longer than any other") {
  ParseOptions options;
  options.limits.list_entries = 4;
  const auto fault = [&](const std::string& faces, std::string_view first) {
    const std::string text = mesh("%3, <0, 0, 0>, <1, 0, 0>, <0, 1, 0>", faces);
    return test::error_line(with_first(text, first), options);
  };
  CHECK(fault("%3, <0, 1, 2>, <0, 1, 2>, <0, 1, 2>", kByLiterals).empty());
  const std::string five = "%4, <0, 1, 2>, <0, 1, 2>, <0, 1, 2>, <0, 1, 2>";
  CHECK(fault(five, kByLiterals) ==
        "scene.pov:6:54: error: this list has more than 4 entries (--max list-entries=N allows more)");
  CHECK(fault(five, kByGrammar) == fault(five, kByLiterals));
}

// Otherwise a mesh would be the same, only read slowly.
TEST_CASE("literals are taken up to what needs the grammar") {
  const std::string text = " 3,\n\t<1, 2, 3>, // <9, 9, 9>\r\n-4 ,<5, 6, 7> <8, 9, 0>, 1 + Z";
  std::vector<pov::ListEntry> list;
  CHECK(std::string(pov::take_literals(text.c_str(), text.c_str() + text.size() + 1, list, 10)) == "1 + Z");
  REQUIRE(list.size() == 5);
  CHECK(list[1].v == Vec3(1, 2, 3));
  CHECK(list[2].v == Vec3(-4));
  CHECK(list[2].is_float);
  CHECK(list[4].v == Vec3(8, 9, 0));
}

namespace {

/// The transformation a matrix makes, or the error.
std::string matrix_outcome(const std::string& numbers, std::string_view first) {
  const std::string text =
      "#declare Z = 0;\n#macro N() 7 #end\nsphere { 0, 1\n matrix <" + with_first(numbers, first) + "> }\n";
  try {
    const Scene scene = parse(text);
    if (scene.objects.empty()) return "left out";
    std::ostringstream all;
    for (const Vec3& row : scene.objects.at(0).transform.rows)
      for (int i = 0; i < 3; ++i)
        all << std::hex << std::bit_cast<std::uint64_t>(row[i]) << ' ';
    return all.str();
  } catch (const SceneError& error) {
    return error.what();
  }
}

} // namespace

TEST_CASE("a matrix of literals is what the grammar makes of it") {
  for (const std::string numbers : {
           "%1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0",
           "%-1.5, -0.0, +2e-1, 0, 1, -0, 0, 0, -1.0000, -0.25, 1e10, -3",
           "%2 , -1,\n-1,\t3, // -9,\n 1, 0, 0, 2, -7, 1, 2, -3",
           "%1, 0, 0, 0, 1 - 2, 0, 0, 0, 1, 0, -Z, N()",
           "%1, 0, 0, 0, - 1, 0, 0, 0, 1, -N(), 5 - 1, 3 * -2",
           "%1, 0, 0 0, 1, 0 0, 0, 1, 0, 0 0",
           "%3 -2, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0",
       }) {
    CAPTURE(numbers);
    const std::string by_grammar = matrix_outcome(numbers, kByGrammar);
    CHECK(by_grammar.find("error") == by_grammar.npos);
    CHECK(matrix_outcome(numbers, kByLiterals) == by_grammar);
  }
  for (const std::string numbers :
       {"%", "%1", "%1, 2, 3, 4, 5, 6", "%1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 4",
        "%-1, 0, 0,, 1, 0, 0, 0, 1, 0, 0, 0", "%1, 0, 0, <0, 1, 2>, 1, 0, 0, 0, 1, 0, 0, 0",
        "%1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1e999", "%1, 0, -, 0, 1, 0, 0, 0, 1, 0, 0, 0",
        "%1, --1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0,"}) {
    CAPTURE(numbers);
    const std::string by_grammar = matrix_outcome(numbers, kByGrammar);
    CHECK(matrix_outcome(numbers, kByLiterals) == by_grammar);
  }
}

namespace {

/// What cylinders and their textures come to, or the error.
std::string cylinder_outcome(const std::string& cylinder, std::string_view first) {
  const std::string text = "#declare Z = 0;\n#declare T = texture { pigment { rgb 1 } }\n"
                           "#macro Twice() * 2 #end\n#macro One() , 1 #end\n" +
                           with_first(cylinder, first);
  try {
    const Scene scene = parse(text);
    if (scene.objects.empty()) return "left out";
    std::ostringstream all;
    all << std::hex << scene.materials.size();
    for (const Object& object : scene.objects) {
      const auto& [base, cap, radius, open] = std::get<Cylinder>(object.shape);
      for (const double number : {base.x, base.y, base.z, cap.x, cap.y, cap.z, radius})
        all << ' ' << std::bit_cast<std::uint64_t>(number);
      all << open << object.no_shadow << object.transform.rows[3].x;
    }
    return all.str();
  } catch (const SceneError& error) {
    return error.what();
  }
}

/// Returns whether the text is a scene.
bool check_same_cylinder(const std::string& text) {
  CAPTURE(text);
  const std::string by_grammar = cylinder_outcome(text, kByGrammar);
  CHECK(cylinder_outcome(text, kByLiterals) == by_grammar);
  return by_grammar.find("error") == by_grammar.npos;
}

} // namespace

TEST_CASE("literal arguments of shapes are what the grammar makes of them") {
  for (const std::string cylinder : {
           "cylinder { %<1, 2, 3>, <4, 5, 6>, 0.5 }",
           "cylinder {%<1,2,-3e1>,<+4,.5,6.>,1texture{T}}",
           "cylinder {\n%<1, 2, 3>, // 7,\r\n <4, 5, 6>\n,\t-0\n open texture { T } }",
           "cylinder { %<1, 2, 3> <4, 5, 6> 0.5 no_shadow }",
           "cylinder { %<1, 2>, 4, 0.5 translate 2*x }",
           "cylinder { %<1, 2, 3>, <4, 5, 6>, 0.5 Twice() texture { T } }",
           "cylinder { %<1, 2, 3>, <4, 5, 6> One() }",
           "cylinder { %<1, 2, 3>, <4, 5, 6>, #if (Z) 2 #else 3 #end }",
           "cylinder { %<1, 2, 3>, <4, 5, 6>.y, 1 /* 2 */ no_shadow }",
           "cylinder { %<1, 2, 3>, <4, 5, 6>, 1e-400 texture { T } texture { T translate x } }",
           "cylinder { %<1, 2, 3>, <4, 5, 6>, 1e999 }",
           "#for (I, 1, 3) cylinder { %<1, 2, 3>, <4, 5, 6>, 1 translate I*x } #end",
       })
    CHECK(check_same_cylinder(cylinder));
  for (const std::string cylinder : {
           "cylinder { %",
           "cylinder { %1",
           "cylinder { %1 }",
           "cylinder { %1, }",
           "cylinder { %<1, 2, 3>, <4, 5, 6>, 0.5, }",
           "cylinder { %<1, 2, 3>, <4, 5, 6>, 0.5, texture { T } }",
           "cylinder { %<1, 2, 3>,\n\n <4, 5, 6>, 0.5, 1 texture { T } }",
           "cylinder { %<1, 2, 3>, 5, <4, 5, 6> texture { T } }",
           "cylinder { %<1, 2, 3>, <4, 5, 6>, 0.5\n pigmnet { rgb 1 } }",
           "cylinder { %<1, 2, 3>, <1, 2, 3>, 1 }",
           "cylinder { %<1, 2, 3>, <4, 5, 6>, 1 cylinder }",
           "cylinder { %<1, 2, 3>,, <4, 5, 6>, 1 }",
       })
    CHECK(!check_same_cylinder(cylinder));
  CHECK(cylinder_outcome("cylinder { }", "") == "scene.pov:5:12: error: unexpected '}', expected a number");
}

TEST_CASE("arguments of shapes put together at random are the same read either way") {
  const std::string pieces[] = {
      ", <4, 5, 6>", ", 0.5", " open", " texture { T }", ",",      "\n",     "// c\n", "/* c */", " Z",
      " +",          " -1",   " * 2",  " Twice()",       " One()", " <1,2>", ".x",     "#if (1)", " }"};
  std::mt19937 random(8);
  int scenes = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string cylinder = "cylinder { %<1, 2, 3>";
    for (unsigned length = random() % 6; length-- > 0;)
      cylinder += pieces[random() % 2 ? random() % std::size(pieces) : random() % 2];
    scenes += check_same_cylinder(cylinder + " }");
  }
  CHECK(scenes > 100);
}

TEST_CASE("literal arguments may not be more than any other") {
  ParseOptions options;
  options.limits.list_entries = 3;
  const std::string text = "polygon { %4, 0, x, x+y }",
                    literal = "polygon { %4, 0, <1, 0, 0>, <1, 1, 0>, 0 }";
  for (const std::string& polygon : {text, literal})
    CHECK(test::error_line(with_first(polygon, kByLiterals), options) ==
          test::error_line(with_first(polygon, kByGrammar), options));
  CHECK(test::error_line(with_first(literal, kByLiterals), options) ==
        "scene.pov:1:30: error: this list has more than 3 entries (--max list-entries=N allows more)");
}
