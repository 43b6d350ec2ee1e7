// Errors of the text, with their places.
#include <catch2/catch.hpp>

#include "pov/parsing.hpp"

using celltrace::test::error;
using celltrace::test::error_line;
using celltrace::test::output;

TEST_CASE("text that makes no sense") {
  CHECK(error_line("foo") == "scene.pov:1:1: error: 'foo' is not declared");
  CHECK(error_line("\n  sphere { 0, 1 pigment { Redd } }") ==
        "scene.pov:2:27: error: 'Redd' is not declared");
  CHECK(error_line("sphere { 0, 1 } ;") ==
        "scene.pov:1:17: error: unexpected ';', expected an object, the camera or a directive");
  CHECK(error_line("sphere { }") == "scene.pov:1:10: error: unexpected '}', expected a number");
  CHECK(error_line("sphere { 0, 1") == "scene.pov:1:14: error: unexpected end of the scene");
  CHECK(error_line("sphere { 0, 1 radius }") == "scene.pov:1:15: error: unexpected 'radius'");
  CHECK(error_line("sphere { 0, 1 autostop }") == "scene.pov:1:15: error: 'autostop' is not supported yet");
  CHECK(error_line("#debug 3") == "scene.pov:1:8: error: unexpected number, expected a string");
  CHECK(error_line("#declare A = x.w;") ==
        "scene.pov:1:15: error: '.w' is no component of a vector or colour");
  CHECK(error_line("sphere { 0, @ }") ==
        "scene.pov:1:13: error: unexpected character '@', expected a number");
  CHECK(error_line(std::string("sphere \1 { }", 12)) ==
        "scene.pov:1:8: error: unexpected character 0x01, expected '{'");
  CHECK(error_line("sphere { 0, \xC3\xA9 }") ==
        "scene.pov:1:13: error: unexpected character 0xC3, expected a number");
}

TEST_CASE("things that never end") {
  CHECK(error_line("sphere { /* 0, 1 }") == "scene.pov:1:10: error: this comment is never closed");
  CHECK(error_line("#debug \"abc\n\n") == "scene.pov:1:8: error: this string is never closed");
  CHECK(error_line("#if (1)\n#debug \"a\"") == "scene.pov:1:1: error: #end is missing for what starts here");
  CHECK(error_line("\n#if (0)\n#debug \"a\"") ==
        "scene.pov:2:1: error: #end is missing for what starts here");
  CHECK(error_line("#while (1) sphere { 0, 1 }") ==
        "scene.pov:1:1: error: #end is missing for what starts here");
  CHECK(error_line("#macro M() sphere { 0, 1 }") ==
        "scene.pov:1:1: error: #end is missing for what starts here");
  CHECK(error_line("sphere_sweep { 0, x { ") == "scene.pov:1:14: error: the block that starts here is never closed");
  CHECK(error_line("#macro M(A) #end M(1") ==
        "scene.pov:1:18: error: the arguments of macro 'M' are never closed");
}

TEST_CASE("directives in the wrong place") {
  CHECK(error_line("#end") == "scene.pov:1:1: error: #end without anything to end");
  CHECK(error_line("#else") == "scene.pov:1:1: error: #else without #if");
  CHECK(error_line("#case (1)") == "scene.pov:1:1: error: #case and #range belong into a #switch");
  CHECK(error_line("#break") == "scene.pov:1:1: error: #break outside of a loop, #switch or macro");
  CHECK(error_line("#nonsense") == "scene.pov:1:1: error: there is no directive '#nonsense'");
  CHECK(error_line("#if 1 = 1 #end") == "scene.pov:1:5: error: unexpected number, expected '('");
  CHECK(error_line("#declare A") == "scene.pov:1:11: error: expected '=' after the name to declare");
  CHECK(error_line("#declare = 1") == "scene.pov:1:10: error: expected a name to declare");
}

TEST_CASE("places inside macros and loops show how they were reached") {
  CHECK(error("#macro M()\n sphere { 0, oops }\n#end\n#macro N() M() #end\n\nN()") ==
        "scene.pov:2:14: error: 'oops' is not declared\n"
        "    in macro 'M' called from scene.pov:4\n"
        "    in macro 'N' called from scene.pov:6");
  CHECK(error("#for (I, 1, 2)\n oops\n#end") == "scene.pov:2:2: error: 'oops' is not declared");
}

TEST_CASE("columns count from 1 in every line, whatever ends it") {
  CHECK(error_line("\r\n\r  oops") == "scene.pov:3:3: error: 'oops' is not declared");
  CHECK(error_line("/* \n \n */ oops") == "scene.pov:3:5: error: 'oops' is not declared");
  CHECK(error_line("#debug \"a\nb\" oops") == "scene.pov:2:4: error: 'oops' is not declared");
}

TEST_CASE("what POV-Ray warns of, too") {
  const std::string zero = "warning: a scale by 0 counts as one by 1\n";
  CHECK(output("sphere { 0, 1 scale 0 }") == "scene.pov:1:21: " + zero);
  CHECK(output("sphere { 0, 1 pigment { checker scale <1, 0, 1> } }") == "scene.pov:1:39: " + zero);
  CHECK(output("sphere { 0, 1 scale <1, 1e-11, 2> scale -1 }").empty());

  const std::string few = "warning: this CSG has less than two objects\n";
  CHECK(output("union { sphere { 0, 1 } }") == "scene.pov:1:1: " + few);
  CHECK(output("#declare D = difference { box { 0, 1 } scale 2 } object { D }") == "scene.pov:1:14: " + few);
  CHECK(output("merge { }") == "scene.pov:1:1: " + few);
  CHECK(output("union { sphere { 0, 1 } light_source { 9, 1 } } light_group { sphere { 0, 1 } }").empty());

  CHECK(output("polygon { 3, 0, x, y }") ==
        "scene.pov:1:1: warning: this polygon does not come back to the point where its last loop begins\n");
  CHECK(output("polygon { 4, 0, x, y, 0 }").empty());
}

TEST_CASE("a camera that looks along its sky") {
  const std::string warning =
      "warning: this camera looks along its 'sky': it keeps the 'right' that it has\n";
  CHECK(output("camera { look_at 0 location 5*y }") == "scene.pov:1:10: " + warning);
  CHECK(output("camera { look_at 0 location -5*z sky z }") == "scene.pov:1:10: " + warning);
  CHECK(output("camera { look_at 0 location 5*y sky z }").empty());
  CHECK(output("camera { location 5*y }").empty());
  CHECK(output("#declare C = camera { location 5*y look_at 0 } camera { C } camera { C translate x }") ==
        "scene.pov:1:36: " + warning);
  // Here the camera is at the origin yet.
  CHECK(output("#version 3.1; camera { look_at y location <5, 1, 0> }") == "scene.pov:1:24: " + warning);
  CHECK(output("#version 3.1; camera { look_at x location <1, 5, 0> }").empty());
  CHECK(output("#version 3.1; camera { location 5*y look_at 0 sky z }") == "scene.pov:1:37: " + warning);
}

TEST_CASE("a place is warned of once") {
  CHECK(output("#for (I, 1, 3) sphere { 0, I scale 0 scale 0 } #end") ==
        "scene.pov:1:36: warning: a scale by 0 counts as one by 1\n"
        "scene.pov:1:44: warning: a scale by 0 counts as one by 1\n");
}
