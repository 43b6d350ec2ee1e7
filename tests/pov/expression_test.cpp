// Numbers, vectors, colours, strings and functions. The expected values are POV-Ray 3.7's own.
#include <catch2/catch.hpp>

#include "pov/parsing.hpp"

using celltrace::test::error_line;
using celltrace::test::output;
using celltrace::test::value;

TEST_CASE("numbers are written in all of C's decimal ways") {
  CHECK(value("1.") == "1.000");
  CHECK(value(".5") == "0.500");
  CHECK(value("1e3") == "1000.000");
  CHECK(value("2.5E-1") == "0.250");
  CHECK(value("1e-999") == "0.000");
  CHECK(value("1e-99999") == "0.000");
  CHECK(error_line("global_settings { adc_bailout 1e99999 }") ==
        "scene.pov:1:31: error: this number is not finite");
}

TEST_CASE("a number has one decimal point") {
  for (const char* number : {"0.0.95", "<0.0.95, 1, 1>", "1.5.", "1..5", "1e3.5", ".5.5", "1.5.x", "1e5.x"}) {
    INFO(number);
    CHECK(error_line("#declare A = " + std::string(number) + ";").find("more than one decimal point") !=
          std::string::npos);
  }
  CHECK(error_line("sphere { 0, 0.0.95 }") ==
        "scene.pov:1:13: error: this number has more than one decimal point");
  CHECK(value("<1, 2.>.y") == "2.000");
  CHECK(value("(1.5).x") == "1.500");
}

TEST_CASE("operators bind as in POV-Ray") {
  CHECK(value("1 + 2 * 3") == "7.000");
  CHECK(value("-2 * -3") == "6.000");
  CHECK(value("2 -1") == "1.000");
  CHECK(value("7 / 2 / 2") == "1.750");
  CHECK(value("- -3") == "3.000");
  CHECK(value("!0") == "1.000");
  CHECK(value("!-5") == "0.000");
  CHECK(value("-!0") == "-1.000");
  CHECK(value("!!7") == "1.000");
  CHECK(value("(0 | 1 & 0)") == "0.000");
  CHECK(value("1 + (2 < 3)") == "2.000");
  CHECK(value("abs(1 < 2)") == "1.000");
  CHECK(value("(1 = 1)") == "1.000");
  CHECK(value("(1 != 1)") == "0.000");
  CHECK(value("(1 <= 1)") == "1.000");
  CHECK(value("(2 >= 3)") == "0.000");
  CHECK(value("(1 = 1 + 1e-12)") == "1.000");
  CHECK(value("(1 ? 2 : 3)") == "2.000");
  CHECK(value("(0 ? 2 : 0 ? 4 : 5)") == "5.000");
  CHECK(value("(\"a\" = \"a\") + (\"a\" != \"b\")") == "2.000");
}

TEST_CASE("functions of floats") {
  CHECK(value("int(-1.5)") == "-1.000");
  CHECK(value("floor(-0.5)") == "-1.000");
  CHECK(value("ceil(0.2)") == "1.000");
  CHECK(value("mod(-5, 3)") == "-2.000");
  CHECK(value("mod(5.5, 2)") == "1.500");
  CHECK(value("div(-5, 3)") == "-1.000");
  CHECK(value("div(5.7, 2.9)") == "1.000");
  CHECK(value("pow(2, 10)") == "1024.000");
  CHECK(value("sqrt(2)") == "1.414");
  CHECK(value("ln(10)") == "2.303");
  CHECK(value("log(100)") == "2.000");
  CHECK(value("exp(1)") == "2.718");
  CHECK(value("radians(180)") == "3.142");
  CHECK(value("degrees(pi)") == "180.000");
  CHECK(value("sin(pi / 2) + cos(0) + tan(0)") == "2.000");
  CHECK(value("atan2(1, 0)") == "1.571");
  CHECK(value("bitwise_and(6.9, -3.2)") == "4.000");
  CHECK(value("bitwise_or(1, 2, 8)") == "11.000");
  CHECK(value("bitwise_xor(1e20, 5)") == "-2147483643.000");
  CHECK(value("bitwise_xor(7)") == "7.000");
  CHECK(value("acos(1.0000001)") == "0.000");
  CHECK(value("asin(-2)") == "-1.571");
  CHECK(value("min(3, 1, 2)") == "1.000");
  CHECK(value("max(3)") == "3.000");
  CHECK(value("select(-1, 1, 2)") == "1.000");
  CHECK(value("select(0, 1, 2, 3)") == "2.000");
  CHECK(value("select(5, 1, 2, 3)") == "3.000");
}

TEST_CASE("vectors are promoted and padded") {
  CHECK(value(3, "<1, 2, 3> + 1") == "2.00 3.00 4.00");
  CHECK(value(3, "<1 2 3> * 2") == "2.00 4.00 6.00");
  CHECK(value(3, "<1 -2, 3, 4>") == "-1.00 3.00 4.00");
  CHECK(value(5, "<1, 2> + <0, 0, 0, 1>") == "1.00 2.00 0.00 1.00 0.00");
  CHECK(value(3, "x + 2 * y - z") == "1.00 2.00 -1.00");
  CHECK(value("vlength(3)") == "5.196");
  CHECK(value("<1, 2, 3>.y") == "2.000");
  CHECK(value("(x + 2 * y).v") == "2.000");
  CHECK(value("t.t + u.x + v.y") == "3.000");
  CHECK(error_line("#declare A = <1, 2>.z;") ==
        "scene.pov:1:20: error: a vector of 2 components has no such component");
  CHECK(error_line("#declare A = <1, 2, 3, 4, 5, 6>;") ==
        "scene.pov:1:30: error: a vector has at most five components");
}

TEST_CASE("functions of vectors") {
  CHECK(value(3, "vcross(x, y)") == "0.00 0.00 1.00");
  CHECK(value("vdot(<1, 2, 3>, <4, 5, 6>)") == "32.000");
  CHECK(value(3, "vnormalize(<0, 3, 4>)") == "0.00 0.60 0.80");
  CHECK(value(3, "vnormalize(0)") == "0.00 0.00 0.00");
  CHECK(value(3, "vrotate(x, 90 * y)") == "0.00 0.00 -1.00");
  CHECK(value(3, "vrotate(y, 90 * x)") == "0.00 0.00 1.00");
  CHECK(value("vlength(vrotate(y, 20 / x)) * 0").find("nan") != std::string::npos); // as in POV-Ray
  CHECK(value(3, "vaxis_rotate(x, z, 90)") == "0.00 1.00 0.00");
}

TEST_CASE("colours") {
  CHECK(value(5, "rgb 0.5") == "0.50 0.50 0.50 0.00 0.00");
  CHECK(value(5, "rgbf 1") == "1.00 1.00 1.00 1.00 0.00");
  CHECK(value(5, "rgbt 1") == "1.00 1.00 1.00 0.00 1.00");
  CHECK(value(5, "rgbft <1, 2, 3, 4, 5>") == "1.00 2.00 3.00 4.00 5.00");
  CHECK(value(5, "rgb <1, 2, 3, 4, 5>") == "1.00 2.00 3.00 4.00 5.00");
  CHECK(value(5, "rgbt <1, 2, 3, 4>") == "1.00 2.00 3.00 0.00 4.00");
  CHECK(value(5, "color red 1 filter 0.5") == "1.00 0.00 0.00 0.50 0.00");
  CHECK(value(5, "colour rgb 1 transmit 0.25") == "1.00 1.00 1.00 0.00 0.25");
  CHECK(value(5, "color 0.5") == "0.50 0.50 0.50 0.50 0.50");
  CHECK(value(5, "color <1, 2, 3>") == "1.00 2.00 3.00 0.00 0.00");
  CHECK(output("#declare C = rgbft <1, 2, 3, 4, 5>; #debug str(C.gray, 0, 3) #debug str(C.t, 0, 0)"
               "#debug str(C.filter, 0, 0) #debug str(C.transmit, 0, 0) #debug str(C.green, 0, 0)") ==
        "1.8174452");
  CHECK(output("#declare White = rgb 1; #debug vstr(3, White * 0.25, \",\", 0, 2)") == "0.25,0.25,0.25");
}

TEST_CASE("strings") {
  CHECK(output("#debug concat(\"a\", str(2.5, 0, 1), chr(66))") == "a2.5B");
  CHECK(output("#debug concat(substr(\"hello\", 2, 3), strupr(\"ab\"), strlwr(\"CD\"))") == "ellABcd");
  CHECK(output("#debug str(3, 5, -1)") == "3.000000");
  CHECK(output("#debug str(3.14159, -8, 2)") == "00003.14");
  CHECK(output("#debug str(1.5, 6, 1)") == "   1.5");
  CHECK(output("#debug str(-1.5, -6, 1)") == "-001.5");
  CHECK(output("#debug str(2.5, 0, 0)") == "2");
  CHECK(output("#debug \"quote \\\" and backslash \\\\\\n\"") == "quote \" and backslash \\\n");
  CHECK(value("strlen(\"abc\") + asc(\"A\") + val(\" 2.5\") + strcmp(\"b\", \"a\")") == "71.500");
  CHECK(value("strcmp(\"ab\", \"ad\") + 1000*strcmp(\"abc\", \"ab\") + strcmp(\"x\", \"x\")") == "98998.000");
  CHECK(value("val(\"abc\") + asc(\"\")") == "0.000");
}

TEST_CASE("random numbers repeat POV-Ray's") {
  CHECK(output("#declare S = seed(42); #debug str(rand(S), 0, 6) #debug \" \" #debug str(rand(S), 0, 6)") ==
        "0.723583 0.329979");
}

TEST_CASE("constants and what the caller sets") {
  CHECK(value("true + yes + on + no + off + false") == "3.000");
  // As POV-Ray has them for a still picture.
  CHECK(value("clock_delta + clock_on + initial_frame + final_frame + frame_number + final_clock") ==
        "0.000");
  CHECK(value("version") == "3.700");
  CHECK(value("now > 9000 & now*2 < 1e6") == "1.000"); // days since 2000
  celltrace::ParseOptions options;
  options.width = 320;
  options.height = 200;
  options.clock = 0.25;
  options.declares = {{"Count", 3.0}, {"Name", std::string("n")}};
  CHECK(output("#debug str(image_width / image_height + clock, 0, 2) #debug Name #debug str(Count, 0, 0)",
               options) == "1.85n3");
  options.declares = {{"x", 1.0}};
  CHECK_THROWS_AS(celltrace::test::parse("camera { }", options), celltrace::InputError);
  options.declares = {{"9lives", 1.0}};
  CHECK_THROWS_AS(celltrace::test::parse("camera { }", options), celltrace::InputError);
}

TEST_CASE("a scene knows which frame of which animation it is") {
  celltrace::ParseOptions options;
  options.clock = 0.5;
  options.frame = {true, 7, 2, 12, -1, 3, 0.4};
  CHECK(
      output(
          "#debug concat(str(clock_on, 0, 0), str(frame_number, 3, 0), str(initial_frame, 3, 0), "
          "str(final_frame, 3, 0), str(initial_clock, 3, 0), str(final_clock, 2, 0), str(clock_delta, 4, 1), "
          "str(clock, 4, 1))",
          options) == "1  7  2 12 -1 3 0.4 0.5");
}

TEST_CASE("a division by zero is infinite") {
  using celltrace::test::output;
  using celltrace::test::parse;
  const std::string warning = "scene.pov:1:15: warning: division by zero\n";
  CHECK(output("#declare A = 1/0; #debug str(A, 0, 0)") == warning + "inf");
  CHECK(output("#declare A =-1/0; #debug str(A, 0, 0)") == warning + "inf"); // as POV-Ray has it
  CHECK(output("#declare A = <1, 2, 3>/<1, 0, 2>; #debug vstr(3, A, \" \", 0, 1)") ==
        "scene.pov:1:23: warning: division by zero\n1.0 inf 1.5");
  // Once for each place.
  CHECK(output("#declare A = 1; #for (I, 1, 3) #declare B = A/0; #end #declare C = 1/0;") ==
        "scene.pov:1:46: warning: division by zero\nscene.pov:1:69: warning: division by zero\n");
  CHECK(
      output("#if (1e400) #debug \"y\" #end #for (I, 1, 1e400) #debug \"n\" #if (I = 3) #break #end #end") ==
      "ynnn");
  CHECK(value("int(1e400)") == "-2147483648.000");
  CHECK(value("int(3e9)") == "-2147483648.000");
  CHECK(value("int(-2147483648.5)") == "-2147483648.000");
  CHECK(value("int(2147483647.5)") == "2147483647.000");
  CHECK(value("div(1, 0)") == "-2147483648.000");
  CHECK(value("div(-7, 2)") == "-3.000");

  const auto scene =
      parse("box { <-1, -1, 0>, <1, 1e400, -1e400> pigment { rgb <1, 1e400, 0.5> } finish { ambient "
            "1e400 } } sphere { 0, 1 pigment { rgbt <1, 1, 1, 1e400> } } "
            "light_source { y, rgb 1e400 }");
  const auto& box = std::get<celltrace::Box>(scene.objects.at(0).shape);
  CHECK(box.corner[1] == celltrace::Vec3(1, 1e5, -1e5));
  CHECK(scene.materials.at(0).pigment.rgb == celltrace::Vec3(1, 0, 0.5));
  CHECK(scene.materials.at(0).finish.ambient.x >= 1e20);
  CHECK(scene.materials.at(1).pigment.rgb == celltrace::Vec3(0));
  CHECK(scene.materials.at(1).pigment.transmit == 0);
  CHECK(scene.lights.at(0).colour.x >= 1e20);
  CHECK(error_line("torus { 1, 1 } global_settings { adc_bailout 1e400 }") ==
        "scene.pov:1:46: error: this number is not finite");
}

TEST_CASE("impossible calculations are errors") {
  CHECK(error_line("#declare A = sqrt(-1);") ==
        "scene.pov:1:14: error: the square root of a negative number");
  CHECK(error_line("#declare A = ln(0);") ==
        "scene.pov:1:14: error: the logarithm of a number that is not positive");
  CHECK(error_line("global_settings { adc_bailout <1, 2> }") ==
        "scene.pov:1:31: error: expected a float, found a vector");
  CHECK(error_line("#declare A = sin(1, 2);") == "scene.pov:1:14: error: sin() takes 1 argument, not 2");
  CHECK(error_line("#declare A = sin(x);") ==
        "scene.pov:1:14: error: argument 1 of sin() must be a float, not a vector");
  CHECK(error_line("#declare A = strlen(3);") ==
        "scene.pov:1:14: error: argument 1 of strlen() must be a string, not a float");
  CHECK(error_line("#declare A = rand(0);") == "scene.pov:1:14: error: rand() needs what seed() has given");
  CHECK(error_line("#declare A = substr(\"abc\", 2, 5);") ==
        "scene.pov:1:14: error: substr() reaches outside its string");
}
