// Scenes made to exhaust the parser.
#include <catch2/catch.hpp>

#include "pov/parsing.hpp"

using celltrace::ParseOptions;
using celltrace::test::error_line;
using celltrace::test::repeated;

namespace {

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("loops and macros end") {
  ParseOptions options;
  options.limits.loop_iterations = 500;
  CHECK(error_line("#while (1) #end", options) == "scene.pov:1:1: error: the loops of the scene run more "
                                                  "than 500 times (--max loop-steps=N allows more)");
  CHECK(error_line("#for (I, 1, 10, 1e-9) #end", options) ==
        "scene.pov:1:1: error: the loops of the scene run more than 500 times (--max loop-steps=N allows "
        "more)");
  CHECK(
      error_line("#macro M() M() #end M()") ==
      "scene.pov:1:12: error: macros call one another more than 1000 deep (--max macro-depth=N allows more)");
  CHECK(contains(error_line("#macro M() #declare A = M(); #end M()"), "nested too deeply"));
  CHECK(contains(error_line("#macro M(A) M(M(A)) #end M(1)"), "nested too deeply"));
  options.limits.tokens = 100;
  CHECK(contains(error_line(repeated("sphere { 0, 1 }", 50), options), "the scene has more than 100 tokens"));
}

TEST_CASE("loops that cannot end are found before they have run long") {
  const std::string start = "#declare A = 1; #declare B = array[2] {1, 2} #declare F = function(x) {x + A} "
                            "#macro Twice(X) X * 2 #end\n";
  for (const char* loop :
       {"#while (1) #end", "#while (A < 2 & B[1]) #declare C = A; #end",
        "#while (F(A) > 0) sphere { A, 1 } #end",
        "#while (sin(A) < pi) #if (A) #local D = B; #end #for (I, 1, 2) #declare C = I; #end #end",
        "#while (A = 1) #while (A = 2) #end #switch (A) #case (1) #debug \"\" #end #end",
        "#macro Endless(A) #while (A) #local B = A + 1; #end #end Endless(3)",
        "#while (A < 5) sphere { A, Twice(A) } #end",
        "#macro Own() #local A = 3; #for (A, 1, 2) #end #end #while (A) Own() #end",
        "#for (I, 1, 1/0) #end"}) {
    INFO(loop);
    CHECK(contains(error_line(start + loop),
                   "error: this loop never ends: nothing in it changes what that depends on"));
  }
  const char* by_default = "the loops of the scene run more than 1000000000 times";
  CHECK(contains(error_line("#for (I, 1, 1e10) sphere { I, 1 } #end"), by_default));
  CHECK(contains(error_line("#for (I, 0, -1e10, -1) #end"), by_default));
  ParseOptions few;
  few.limits.loop_iterations = 1'000'000;
  CHECK(
      contains(error_line("#while (now < 1e9) #end", few), "the loops of the scene run more than 1000000 "));
}

TEST_CASE("loops that only seem to be endless end") {
  const std::string start =
      "#declare A = 0; #declare B = array[2] {0, 0} #declare R = seed(1); "
      "#macro Count(X) #declare X = X + 1; #end #macro Next() #declare A = A + 1; #end\n";
  for (const char* loop :
       {"#while (A < 3000) #declare A = A + 1; #end", "#while (B[1] < 3000) #declare B[1] = B[1] + 1; #end",
        "#while (A < 3000) Count(A) #end", "#while (A < 3000) Next() #end",
        "#macro M(X) #while (A < 3000) #declare X = X + 1; #end #end M(A)", "#while (rand(R) < 0.999) #end",
        "#while (1) #declare A = A + 1; #if (A > 3000) #break #end #end",
        "#macro Nested() Next() #end #while (A < 3000) #declare C = 2; Nested() #end",
        "#macro Local(X) #local X = X + 1; #end #while (A < 3000) Local(A) #end",
        "#macro Loop(X) #for (X, X + 1, X) #end #end #while (A < 3000) Next() #end",
        "#while (A < 3000) #macro New() #declare A = A + 1; #end New() #end",
        "#for (I, 1, 1e9) #declare A = A + 1; #if (A > 3000) #break #end #end",
        "#for (I, 1, 1e9) #if (I > 3000) #declare I = 2e9; #end #end",
        "#declare C = 1; #while (defined(C)) #declare A = A + 1; #if (A > 3000) #undef C #end #end",
        "#while (A < 3000) declare A = A + 1; #end", "#while (A < 3000) #for (A, A + 1, A + 1) #end #end",
        "#declare N = <0, 0, 0>; #while (N.z = 0) #declare A = A + 1; #declare C = trace(sphere { 0, A / "
        "3000 }, "
        "<0, 0.99, -9>, z, N); #end",
        "#while (A < 3000) #declare deprecated once \"it is old\" A = A + 1; #end"}) {
    INFO(loop);
    CHECK(error_line(start + loop + " sphere { 0, 1 }").empty());
  }
}

TEST_CASE("nesting has an end") {
  CHECK(contains(error_line("#declare A = " + repeated("(", 100000)), "nested more than 256 deep"));
  CHECK(contains(error_line("#declare A = " + repeated("<", 100000)), "nested more than 256 deep"));
  CHECK(contains(error_line("#declare A = (" + repeated("1?1:", 100000)), "nested more than 256 deep"));
  CHECK(contains(error_line(repeated("union { ", 100000)), "nested more than 256 deep"));
  CHECK(contains(error_line("ovus " + repeated("{", 100000)), "nested more than 256 deep"));
  CHECK(error_line("#declare A = " + repeated("-", 100000) + "1;").empty());
  CHECK(error_line("#declare A = 1" + repeated("+1", 100000) + ";").empty());
  CHECK(contains(error_line("#declare U = sphere { 0, 1 } "
                            "#for (I, 1, 2000) #declare U = union { object { U } hollow } #end U"),
                 "objects are nested too deeply"));
  CHECK(contains(
      error_line("#declare U = sphere { 0, 1 } "
                 "#for (I, 1, 2000) #declare U = sphere { 0, 1 clipped_by { object { U } } } #end U"),
      "objects are nested too deeply"));
  const auto nested = [](int times, const char* modifier) {
    return "#declare U = sphere { 0, 1 } #for (I, 1, " + std::to_string(times) +
           ") #declare U = union { object { U } " + modifier + " } #end U";
  };
  CHECK(error_line(nested(999, "")).empty());
  CHECK(error_line(nested(100, "inverse")).empty());
  CHECK(contains(error_line(nested(101, "inverse")), "CSG is nested more than 100 deep"));
  CHECK(error_line(nested(50, "clipped_by { box { -1, 1 } }")).empty());
  CHECK(contains(error_line("#declare A = array[1] {1} #for (I, 1, 1000) #declare A = array[1] {A} #end"),
                 "too large to be copied"));
}

TEST_CASE("a Scene takes CSG as deep as the language makes it") {
  const auto nested = [](int times, const std::string& use) {
    return "#declare U = sphere { 0, 1 } #for (I, 1, " + std::to_string(times) +
           ") #declare U = merge { object { U } } #end " + use;
  };
  const std::string uses[] = {"object { U }",
                              "sphere { 0, 1 pigment { object { U color rgb 0, color rgb 1 } } }"};
  for (const std::string& use : uses) {
    CAPTURE(use);
    CHECK_NOTHROW(celltrace::validate(celltrace::test::parse(nested(100, use))));
    CHECK(contains(error_line(nested(101, use)), "CSG is nested more than 100 deep"));
  }
}

TEST_CASE("what a scene makes is bounded") {
  ParseOptions options;
  options.limits.objects = 10;
  CHECK(contains(error_line("#for (I, 1, 11) sphere { 0, 1 } #end", options), "more than 10 objects"));
  CHECK(contains(error_line("#declare U = union { sphere { 0, 1 } sphere { 0, 1 } } "
                            "#for (I, 1, 30) #declare U = union { object { U } object { U } } #end U"),
                 "objects"));
  const auto doubled = [&](const std::string& both) {
    return error_line("#declare U = sphere { 0, 1 } #for (I, 1, 30) #declare U = " + both + " #end U",
                      options);
  };
  CHECK(contains(doubled("difference { object { U } object { U } }"), "objects"));
  CHECK(contains(doubled("sphere { 0, 1 clipped_by { U U } translate x }"), "objects"));
  options.limits.triangles = 10;
  CHECK(contains(error_line("mesh { #for (I, 1, 11) triangle { 0, x, y } #end }", options),
                 "more than 10 triangles"));
  options.limits.list_entries = 100;
  CHECK(contains(error_line("mesh2 { vertex_vectors { 1 #for (I, 1, 200) x #end } }", options),
                 "this list has more than 100 entries"));
  options.limits.recorded_tokens = 50;
  CHECK(contains(error_line("#macro M() " + repeated("x ", 100) + "#end", options), "more than 50 tokens"));
  options.limits.array_elements = 100;
  CHECK(contains(error_line("#declare A = array[20][20];", options), "an array has more than 100 elements"));
  CHECK(contains(error_line("#declare A = array[1e30];"), "an array has more than"));
  CHECK(contains(
      error_line("#declare A = array[2] {1, 1} #for (I, 1, 40) #declare A = array[2] {A, A} #end", options),
      "the arrays of the scene have more than 100 elements"));
  options.limits.array_elements = 1000;
  CHECK(contains(
      error_line("#declare B = array[20]; #for (I, 0, 19) #declare B[I] = array[100]; #end", options),
      "the arrays of the scene have more than 1000 elements (--max array-elements=N allows more)"));
  CHECK(error_line("#for (I, 0, 99) #declare B = array[100]; #end", options).empty());
  options.limits.memory = 1 << 20;
  CHECK(contains(
      error_line("#declare B = array[800]; #for (I, 0, 799) #declare B[I] = sphere { 0, 1 "
                 "texture { pigment { rgb 1 } } texture { pigment { rgbt 1 } } } #end",
                 options),
      "error: the declarations of the scene need more than 1048576 bytes of memory (--max memory=N"));
  CHECK(error_line("#for (I, 0, 9999) #declare B = sphere { 0, 1 pigment { rgb 1 } } #end", options).empty());
  CHECK(contains(error_line("#declare S = \"abc\"; #for (I, 1, 40) #declare S = concat(S, S); #end"),
                 "this string is too long"));
  options.limits.text_bytes = 1000;
  CHECK(contains(error_line("#for (I, 1, 400) #declare S = str(I, 5, 0); #end", options),
                 "makes more than 1000 bytes of text"));
}

TEST_CASE("objects are counted before there are too many") {
  const std::string doubled = "#declare U = sphere { 0, 1 } #for (I, 1, 200) #declare U = ";
  for (const char* twice : {"union { object { U } object { U } }", "difference { object { U } object { U } }",
                            "sphere { 0, 1 clipped_by { object { U } object { U } } }"}) {
    INFO(twice);
    CHECK(contains(error_line(doubled + twice + " #end object { U }"),
                   "the scene has more than 4000000 objects"));
  }
}

TEST_CASE("reading a scene takes no longer than it may") {
  ParseOptions options;
  options.limits.seconds = 0;
  CHECK(contains(error_line("#while (1) #declare A = 1; #end", options),
                 "reading the scene takes more than 0 seconds (--max seconds=N allows more)"));
}

TEST_CASE("every limit has a name") {
  std::size_t bytes = 0;
  for (const celltrace::NamedLimit& limit : celltrace::parse_limits()) {
    CHECK(celltrace::ParseLimits{}.*limit.limit > 0);
    bytes += sizeof(std::uint64_t);
  }
  CHECK(bytes == sizeof(celltrace::ParseLimits));
}

TEST_CASE("lexemes are bounded") {
  CHECK(error_line(repeated("a", 100000)) == "scene.pov:1:1: error: this name is too long");
  CHECK(error_line("#declare A = " + repeated("1", 100000)) ==
        "scene.pov:1:14: error: this number is too long");
  CHECK(error_line("#debug \"" + repeated("abcdefghij", 200000) + "\"") ==
        "scene.pov:1:8: error: this string is too long");
  CHECK(error_line("sphere { " + repeated(" ", 1000000) + "0, 1 }").empty());
}
