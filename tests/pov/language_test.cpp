// Directives, macros, loops and arrays.
#include <catch2/catch.hpp>

#include "pov/parsing.hpp"

using celltrace::ParseOptions;
using celltrace::test::error_line;
using celltrace::test::output;

TEST_CASE("comments nest and line ends may be of any kind") {
  CHECK(output("/* a /* b */ c */ // d\r#debug \"1\"\r\n#debug \"2\"\n// end") == "12");
}

TEST_CASE("#declare, #local and #undef") {
  CHECK(output("#declare A = 1; #declare A = A + 1; #debug str(A, 0, 0)") == "2");
  CHECK(output("#version 3.1; #declare A = 1 #declare B = 2 #debug str(A + B, 0, 0)") == "3");
  CHECK(output("declare A = 5; #debug str(A, 0, 0)") == "5");
  CHECK(output("#local A = 1; #undef A #ifdef (A) #debug \"y\" #else #debug \"n\" #end") == "n");
  CHECK(output("#declare deprecated once \"use B\" A = 1; #debug str(A, 0, 0)") == "1");
  CHECK(output("# declare A = 4; #debug str(A, 0, 0)") == "4");
  CHECK(error_line("#declare x = 1;") ==
        "scene.pov:1:10: error: 'x' is a reserved word, not a name to declare");
}

TEST_CASE("semicolons behind declarations") {
  CHECK(output("#declare A = 1;; #declare B = <1, 2, 3>; ; #debug str(A, 0, 0)") == "1");
  CHECK(output("#macro M() #local A = 2; #end M(); #debug \"on\"") == "on");
  CHECK(output("#declare I = 0; #while (I < 3) #declare I = I + 1;; #end #debug str(I, 0, 0)") == "3");
  for (const char* text : {"#declare A = 1;;;", "#declare A = \"a\";;", "#declare A = sphere { 0, 1 };;",
                           "#if (1) #declare A = 1; #end;", ";"}) {
    INFO(text);
    CHECK(error_line(text).find("unexpected ';'") != std::string::npos);
  }
}

TEST_CASE("semicolons that are missing behind numbers") {
  const auto is_missed = [](const std::string& line) {
    return line.find("error: 'A' needs a ';' behind its value, unless a #version below 3.5 comes first") !=
           std::string::npos;
  };
  for (const std::string text :
       {"#declare A = 1", "#local A = <1, 2> #declare B = 1;", "#declare A = rgb 1 sphere { 0, 1 }",
        "#declare A = array[2]; #declare A[0] = 1 #debug \"\"", "#macro M() #declare A = 1 #end M()",
        "#macro M() 1 #end #declare A = M() sphere { 0, 1 }", "#if (1) #declare A = 1 #end"}) {
    INFO(text);
    CHECK(is_missed(error_line(text)));
    CHECK(is_missed(error_line("#version 3.5; " + text)));
    CHECK(error_line("#version 3.49; " + text).empty());
  }
  ParseOptions options;
  options.version = 3.1;
  CHECK(error_line("#declare A = 1 #if (version != 3.1) #error \"no\" #end", options).empty());
  CHECK(is_missed(error_line("#version 3.7; #declare A = 1", options)));
  options.version = 0;
  CHECK_THROWS_AS(celltrace::test::parse("", options), celltrace::InputError);
  options.version = 1e300;
  CHECK_THROWS_AS(celltrace::test::parse("", options), celltrace::InputError);
  CHECK(error_line(" #declare A = 1").starts_with("scene.pov:1:11: error: "));
  CHECK(output("#macro M() 1; #end #declare A = M() #debug str(A, 0, 0)") == "1");
  CHECK(output("#declare A = \"a\" #declare B = array[1] {1} #declare C = function(x) { x } #debug A") ==
        "a");
}

TEST_CASE("conditions") {
  CHECK(output("#if (0) #debug \"1\" #elseif (1) #debug \"2\" #else #debug \"3\" #end") == "2");
  CHECK(output("#if (0) #if (1) #debug \"1\" #else #end #else #debug \"2\" #end") == "2");
  CHECK(output("#if (1) #debug \"1\" #elseif (1) #debug \"2\" #else #debug \"3\" #end") == "1");
  CHECK(output("#ifndef (A) #declare A = 1; #end #ifdef (A) #debug \"A\" #end") == "A");
  CHECK(output("#if (defined(A)) #debug \"y\" #else #debug \"n\" #end") == "n");
  CHECK(output("#declare V = \"b\"; #if (V = \"a\") #debug \"1\" #else #debug \"2\" #end") == "2");
  CHECK(output("#if (0) @ ' anything \"goes\" here #end #debug \"on\"") == "on");
}

TEST_CASE("#switch falls through without #break") {
  CHECK(output("#switch (2) #case (1) #debug \"1\" #case (2) #debug \"2\" #case (3) #debug \"3\" #break"
               " #else #debug \"e\" #end") == "23");
  CHECK(output("#switch (7) #range (1, 5) #debug \"r\" #break #else #debug \"e\" #end") == "e");
  CHECK(output("#switch (3) #range (1, 5) #debug \"r\" #break #else #debug \"e\" #end") == "r");
  CHECK(
      output("#switch (1) #case (1) #if (1) #if (1) #break #end #end #debug \"no\" #end #debug \"after\"") ==
      "after");
  CHECK(output("#switch (9) #case (1) #debug \"1\" #end") == "");
}

TEST_CASE("#while and #for") {
  CHECK(output("#declare I = 0; #while (I < 3) #debug str(I, 0, 0) #declare I = I + 1; #end") == "012");
  CHECK(output("#declare I = 0; #while (I < 5) #declare I = I + 1; #if (I = 3) #break #end #debug str(I, 0, "
               "0) #end") == "12");
  CHECK(output("#for (I, 5, 1, -2) #debug str(I, 0, 0) #end #debug str(I, 0, 0)") == "531-1");
  CHECK(output("#for (I, 0, 1, 0.1) #debug \".\" #end") == "...........");
  CHECK(output("#for (I, 1, 3) #for (J, 1, I) #debug str(J, 0, 0) #end #end") == "112123");
  CHECK(output("#for (I, 2, 1) #debug \"never\" #end") == "");
  CHECK(error_line("#for (I, 1, 2, 0) #end") == "scene.pov:1:1: error: the step of a #for must not be 0");
}

TEST_CASE("directives work anywhere between tokens") {
  const auto scene = celltrace::test::parse(
      "union { #for (I, 1, 4) sphere { <I, 0, 0> #if (I > 2) , 2 #else , 1 #end } #end }");
  REQUIRE(scene.objects.size() == 4);
  CHECK(std::get<celltrace::Sphere>(scene.objects[0].shape).radius == 1);
  CHECK(std::get<celltrace::Sphere>(scene.objects[3].shape).radius == 2);
}

TEST_CASE("a # before a word that is no directive has no meaning") {
  CHECK(output("#declare S = #sphere { 0, 1 }; #union { #object { #S } sphere { #y, 1 } } #debug \"on\"") ==
        "on");
  CHECK(output("#macro M() #debug \"m\" #end #M() # M() #declare A = #pi; #debug str(#A, 0, 1)") == "mm3.1");
  CHECK(output("#if (0) #object { #nothing } #else #debug \"else\" #end") == "else");
  CHECK(error_line("#declar A = 1;") == "scene.pov:1:1: error: there is no directive '#declar'");
}

TEST_CASE("macros") {
  SECTION("give tokens, not only whole constructs") {
    const auto scene =
        celltrace::test::parse("#macro Start() sphere { #end #macro Rest(R) , R } #end Start() 0 Rest(3)");
    REQUIRE(scene.objects.size() == 1);
    CHECK(std::get<celltrace::Sphere>(scene.objects[0].shape).radius == 3);
  }
  SECTION("are values in expressions and call themselves") {
    CHECK(output("#macro F(N) #if (N <= 1) 1 #else (N * F(N - 1)) #end #end #debug str(F(5) + 1, 0, 0)") ==
          "121");
    CHECK(output("#macro Name() \"n\" #end #declare A = Name(); #debug A") == "n");
    CHECK(output("#macro V(A) <A, A, A> #end #debug vstr(3, V(2) * 2, \" \", 0, 0)") == "4 4 4");
  }
  SECTION("take lone identifiers by reference, the rest by value") {
    CHECK(output("#macro M(A, B) #declare A = A + B; #declare B = 0; #end #declare Q = 1; #declare R = 2;"
                 "M(Q, R + 0) #debug str(Q, 0, 0) #debug str(R, 0, 0)") == "32");
  }
  SECTION("take what an #if chooses, arrays too") {
    const std::string show = "#macro M(A, B) #debug str(A[0], 0, 0) #debug str(B, 0, 0) #declare B = 9; #end "
                             "#declare P = array[1] {1} #declare Q = array[1] {2} #declare R = 3; ";
    CHECK(output(show + "M(#if (1) P #else Q #end, R) #debug str(R, 0, 0)") == "139");
    CHECK(output(show + "M(#if (0) P #else Q #end, #if (0) R #else 4 #end) #debug str(R, 0, 0)") == "243");
    CHECK(error_line(show + "M(#if (1) P #else Q, R)") != "");
  }
  SECTION("see their callers' locals and keep their own") {
    CHECK(output("#macro N() #debug str(L, 0, 0) #end #macro M() #local L = 3; N() #end M()"
                 "#ifdef (L) #debug \"leaked\" #end") == "3");
    CHECK(output("#declare L = 1; #macro M() #local L = 2; #end M() #debug str(L, 0, 0)") == "1");
    CHECK(output("#macro M() #declare G = 2; #end M() #debug str(G, 0, 0)") == "2");
  }
  SECTION("end at #break outside of a loop") {
    CHECK(output("#macro M() #debug \"1\" #break #debug \"2\" #end M() #debug \"3\"") == "13");
  }
  SECTION("may follow a declaration that has no semicolon") {
    const auto scene = celltrace::test::parse("#macro S(T) sphere { 0, 1 texture { T } } #end "
                                              "#declare Tex = texture { pigment { rgb 1 } } S(Tex)");
    CHECK(scene.materials.at(scene.objects.at(0).material).pigment.rgb.x == 1);
  }
  SECTION("are called rightly or not at all") {
    const std::string macro = "#macro M(A) #end ";
    CHECK(error_line(macro + "M()") == "scene.pov:1:18: error: macro 'M' takes 1 arguments, not 0");
    CHECK(error_line(macro + "M(1, 2)") == "scene.pov:1:18: error: macro 'M' takes only 1 arguments");
    CHECK(error_line(macro + "M(Q)") ==
          "scene.pov:1:20: error: 'Q' is not declared, macro 'M' cannot take it");
    CHECK(error_line(macro + "M 1") == "scene.pov:1:18: error: expected '(' after macro 'M'");
  }
}

TEST_CASE("arrays") {
  CHECK(
      output(
          "#declare A = array[3] {1, 2, 3} #debug str(A[1], 0, 0) #debug str(dimension_size(A, 1), 0, 0)") ==
      "23");
  CHECK(output("#declare A = array[2][2] {{1, 2}, {3, 4}} #debug str(A[1][0], 0, 0) #debug "
               "str(dimensions(A), 0, 0)") == "32");
  CHECK(output("#declare A = array[2]; #declare A[1] = \"x\"; #debug A[1] #ifdef (A[0]) #debug \"y\" #else "
               "#debug \"n\" "
               "#end") == "xn");
  CHECK(output("#declare A = array[4] {1, 2 3 4} #debug str(A[3], 0, 0)") == "4");
  CHECK(output("#declare A = array[2] {array[2] {1, 2}, array[2] {3, 4}} #debug str(A[1][1], 0, 0)") == "4");
  CHECK(output("#declare A = array[1] {1} #declare B = A; #declare B[0] = 2; #debug str(A[0], 0, 0)") == "1");
  CHECK(
      output(
          "#macro Set(A) #declare A[0] = 7; #end #declare A = array[1] {1} Set(A) #debug str(A[0], 0, 0)") ==
      "7");
  CHECK(output("#declare A = array[2] {1, 2} #undef A[0] #ifdef (A[0]) #debug \"y\" #else #debug \"n\" #end "
               "#declare A[0] = 3; #debug str(A[0] + A[1], 0, 0) #undef A #ifdef (A) #debug \"y\" #end") ==
        "n5");
  CHECK(output("#declare A = array[1][2] {{1, 2}} #undef A[0][1] #ifdef (A[0][1]) #debug \"y\" #end "
               "#debug str(A[0][0], 0, 0)") == "1");
  CHECK(error_line("#declare A = array[1] {1} #undef A[1]") ==
        "scene.pov:1:34: error: subscript 1 is out of range, the array has 1 elements");
  CHECK(error_line("#declare A = array[1]; #undef A[0]") ==
        "scene.pov:1:31: error: this element of 'A' has no value to forget");
  CHECK_FALSE(error_line("#declare A = 1; #undef A[0]").empty());
  CHECK(error_line("#declare A = array[2]; #declare B = A[2];") ==
        "scene.pov:1:37: error: subscript 2 is out of range, the array has 2 elements");
  CHECK(error_line("#declare A = array[2]; #declare B = A[0];") ==
        "scene.pov:1:37: error: this element of 'A' has no value yet");
  CHECK(error_line("#declare A = array[1] {1, 2}") ==
        "scene.pov:1:23: error: this array has 1 elements, but 2 are given");
  CHECK(error_line("#declare A = array[0];") == "scene.pov:1:20: error: an array has at least one element");
}

TEST_CASE("messages") {
  CHECK(output("#debug \"a\" #render \"b\" #statistics \"c\"") == "abc");
  CHECK(output("#warning \"careful\"") == "scene.pov:1:1: warning: careful\n");
  CHECK(error_line("\n #error \"enough\"") == "scene.pov:2:2: error: enough");
}

TEST_CASE("#version decides gamma unless the scene does") {
  using celltrace::GammaMode;
  const auto mode = [](const char* text) { return celltrace::test::parse(text).gamma_mode; };
  CHECK(mode("camera { }") == GammaMode::none);
  CHECK(celltrace::test::parse("camera { }").version == Approx(3.62));
  CHECK(mode("#version 3.6; camera { }") == GammaMode::none);
  CHECK(mode("#version 3.7; camera { }") == GammaMode::assumed);
  CHECK(mode("#declare V = version; #version 3.5; #version V;") == GammaMode::assumed);
  CHECK(mode("global_settings { assumed_gamma srgb }") == GammaMode::srgb);
  const auto scene = celltrace::test::parse("#version 3.1; global_settings { assumed_gamma 2.2 }");
  CHECK(scene.gamma_mode == GammaMode::assumed);
  CHECK(scene.assumed_gamma == 2.2);
  CHECK(scene.version == 3.1);
}

TEST_CASE("which versions there are") {
  using celltrace::test::parse;
  CHECK(parse("#version unofficial 3.6; camera { }").version == 3.6);
  CHECK(parse("#version unofficial 3.7; camera { }").version == 3.7);
  CHECK(parse("#version 3.704; camera { }").version == 3.704);
  CHECK(error_line("#version official 3.7; camera { }") ==
        "scene.pov:1:10: error: 'official' is not declared");
  CHECK_FALSE(error_line("#version unofficial patch 3.7; camera { }").empty());
  CHECK(error_line("#version 3.8; camera { }") ==
        "scene.pov:1:1: error: this scene needs version 3.8 of POV-Ray's language, not 3.7");
  CHECK_FALSE(error_line("#version unofficial 3.8; camera { }").empty());
  CHECK_FALSE(error_line("#version 3.705; camera { }").empty());
}

TEST_CASE("#default changes what textures start from") {
  const auto scene =
      celltrace::test::parse("#default { pigment { rgb 0.5 } finish { ambient 1 } } sphere { 0, 1 }"
                             "#default { texture { pigment { rgb 1 } } } sphere { 0, 1 finish { phong 1 } }");
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.materials[0].pigment.rgb.x == 0.5);
  CHECK(scene.materials[0].finish.ambient.x == 1);
  CHECK(scene.materials[1].pigment.rgb.x == 1);
  CHECK(scene.materials[1].finish.ambient.x == 1);
  CHECK(scene.materials[1].finish.phong == 1);
}

TEST_CASE("what a macro has left behind its value belongs to the macro") {
  const std::string choose = "#macro F(X) #if (X < 1) 5 + 1 #else 7 #end #end ";
  CHECK(output(choose + "#declare V = <F(0), F(2), 1 #if (1) + 3 #end,>; #debug vstr(3, V, \" \", 0, 0)") ==
        "6 7 4");
  CHECK(output(choose + "#macro G(A, B) #debug str(A - B, 0, 0) #end G(F(2), F(0))") == "1");
  CHECK(output(choose + "#macro H() #local V = F(0); #debug str(V, 0, 0) #end H()") == "6");
  CHECK(output("#macro T(A) #if (vlength(A)) transform { translate A } #else transform { scale 2 } #end #end "
               "#declare U = T(x); #declare F = function { transform { U } } "
               "#debug vstr(3, F(1, 1, 1), \" \", 0, 0)") == "2 1 1");
}
