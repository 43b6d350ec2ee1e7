// Values at the ends of what functions and settings take, and one beyond. Expected numbers are POV-Ray 3.7's.
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "pov/parsing.hpp"

using namespace celltrace;
using test::error_line;
using test::material;
using test::output;
using test::parse;
using test::value;

namespace {

/// What the error of an expression says, without its place.
std::string refusal(const std::string& expression) {
  const std::string line = error_line("#declare A = " + expression + ";");
  const std::size_t words = line.find("error: ");
  return words == std::string::npos ? line : line.substr(words + 7);
}

/// The entries of a pattern's map, as "position:red,green,blue".
std::string colours_of(const std::string& pattern) {
  const Material made = material("pigment { " + pattern + " }");
  REQUIRE(made.pigment.map);
  std::string all;
  const auto number = [](double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  };
  for (const auto& [position, pigment] : made.pigment.map->entries) {
    all += (all.empty() ? "" : " ") + number(position) + ":" + number(pigment.rgb.x) + "," +
           number(pigment.rgb.y) + "," + number(pigment.rgb.z);
    CHECK(pigment.filter == 0);
    CHECK(pigment.transmit == 0);
  }
  return all;
}

} // namespace

TEST_CASE("comparisons have a tolerance, which does not count") {
  CHECK(value("(1e-10 ? 1 : 0)") == "0.000");
  CHECK(value("(-1e-10 ? 1 : 0)") == "0.000");
  CHECK(value("(1.1e-10 ? 1 : 0)") == "1.000");
  CHECK(value("!1e-10") == "1.000");
  CHECK(value("!1.1e-10") == "0.000");
  CHECK(value("(0 = 1e-10)") == "0.000");
  CHECK(value("(0 = 0.9e-10)") == "1.000");
  CHECK(value("(0 != 1e-10)") == "1.000");
  CHECK(value("(0 != 0.9e-10)") == "0.000");
  CHECK(value("(1e-10 <= 0)") == "1.000");
  CHECK(value("(1.1e-10 <= 0)") == "0.000");
  CHECK(value("(-1e-10 >= 0)") == "1.000");
  CHECK(value("(-1.1e-10 >= 0)") == "0.000");
  CHECK(value("(1e-12 > 0)") == "1.000");
  CHECK(value("(0 < 1e-12)") == "1.000");
  CHECK(value("(1 > 1) + (1 < 1)") == "0.000");
  const auto rounds = [](const std::string& loop) {
    return output("#for (I, " + loop + ") #debug \"x\" #end");
  };
  CHECK(rounds("1, 3") == "xxx");
  CHECK(rounds("1, 3.5, 0.5") == "xxxxxx");
  CHECK(rounds("3, 1, -1") == "xxx");
  CHECK(rounds("3, 1").empty());
  CHECK(rounds("0, -0.9e-10") == "x");
  CHECK(rounds("0, -1.1e-10").empty());
  CHECK(rounds("1, 1, -7") == "x");
}

TEST_CASE("functions of floats at the ends of their ranges") {
  CHECK(value("sqrt(0)") == "0.000");
  CHECK(value("acos(-1) + acos(-1.5)") == "6.283");
  CHECK(value("asin(1) + asin(1.5)") == "3.142");
  CHECK(value("acos(0.5)") == "1.047");
  CHECK(value("asin(0.5)") == "0.524");
  CHECK(value("atan(2)") == "1.107");
  CHECK(value("atan2(1, 2)") == "0.464");
  CHECK(value("atanh(0.5)") == "0.549");
  CHECK(value("acosh(2)") == "1.317");
  CHECK(value("asinh(2)") == "1.444");
  CHECK(value("sinh(1.5)") == "2.129");
  CHECK(value("cosh(1.5)") == "2.352");
  CHECK(value("tanh(0.5)") == "0.462");
  CHECK(value("sin(1)") == "0.841");
  CHECK(value("cos(1)") == "0.540");
  CHECK(value("tan(1)") == "1.557");
  CHECK(value("abs(-2.5)") == "2.500");
  CHECK(value("exp(2)") == "7.389");
  CHECK(value("ln(0.5)") == "-0.693");
  CHECK(value("log(0.01)") == "-2.000");
  CHECK(value("mod(7, -4)") == "3.000");
  CHECK(value("div(7, -2)") == "-3.000");
  CHECK(value("int(2.9)") == "2.000");
  CHECK(value("int(-2.9)") == "-2.000");
  CHECK(value("ceil(-1.5) + 10 * floor(1.5)") == "9.000");
  CHECK(value("degrees(1)") == "57.296");
  CHECK(value("radians(90)") == "1.571");
  CHECK(value("pow(2, -1) + pow(3, 2)") == "9.500");
  CHECK(value("max(1, 3, 2) + 10 * min(2, 3)") == "23.000");
  CHECK(value("max(-1, -3) + 10 * max(-3, -1)") == "-11.000");
  CHECK(value("min(1, 2, 1)") == "1.000");
  CHECK(value("bitwise_and(7, 14, 6)") == "6.000");
  CHECK(value("bitwise_and(-1, 5)") == "5.000");
  CHECK(value("bitwise_or(-8, 1)") == "-7.000");
  CHECK(value("bitwise_xor(12, 10, 1)") == "7.000");
  CHECK(value("select(0, 1, 2)") == "2.000");
  CHECK(value("select(1, 1, 2)") == "2.000");
  CHECK(value("select(-0.5, 1, 2, 3)") == "1.000");
  CHECK(value("select(0.5, 1, 2, 3)") == "3.000");
  CHECK(refusal("ln(0)") == "the logarithm of a number that is not positive");
  CHECK(refusal("ln(-1)") == "the logarithm of a number that is not positive");
  CHECK(refusal("log(0)") == "the logarithm of a number that is not positive");
  CHECK(refusal("sqrt(-1e-9)") == "the square root of a negative number");
  CHECK(refusal("rand(0)") == "rand() needs what seed() has given");
  CHECK(error_line("#declare R = seed(1); #declare A = rand(1);").find("rand() needs") != std::string::npos);
  CHECK(error_line("#declare R = seed(1); #declare A = rand(-1);").find("rand() needs") != std::string::npos);
  CHECK(refusal("chr(-1)") == "an argument is out of range");
  CHECK(refusal("chr(65536)") == "an argument is out of range");
  CHECK(refusal("pow(2)") == "pow() takes 2 arguments, not 1");
  CHECK(refusal("sin(1, 2)") == "sin() takes 1 argument, not 2");
  CHECK(refusal("select(1, 2)") == "select() takes 4 arguments, not 2");
  CHECK(refusal("select(1, 2, 3, 4, 5)") == "select() takes 4 arguments, not 5");
  CHECK(refusal("vdot(x, \"a\")") == "argument 2 of vdot() must be a vector, not a string");
  CHECK(refusal("sin(x)") == "argument 1 of sin() must be a float, not a vector");
  CHECK(refusal("strlen(2)") == "argument 1 of strlen() must be a string, not a float");
}

TEST_CASE("two random streams do not share their numbers") {
  CHECK(output("#declare A = seed(1); #declare B = seed(-7); #debug concat(str(rand(A), 0, 6), \" \", "
               "str(rand(B), 0, 6), \" \", str(rand(A), 0, 6))") == "0.421993 0.046073 0.487121");
}

TEST_CASE("functions of vectors whose components differ") {
  CHECK(value(3, "vaxis_rotate(<1, 2, 3>, <1, 1, 0>, 30)") == "2.13 0.87 2.95");
  CHECK(value(3, "vrotate(<1, 2, 3>, <10, 20, 30>)") == "1.07 2.29 2.76");
  CHECK(value(3, "vcross(<1, 2, 3>, <-4, 5, 7>)") == "-1.00 -19.00 13.00");
  CHECK(value("vlength(<2, 3, 6>)") == "7.000");
  CHECK(value(3, "vturbulence(2, 0.5, 6, <1.2, 3.4, 5.6>)") == "-0.27 0.12 0.10");
  CHECK(value(3, "vturbulence(3, 0.25, 2, <1.2, 3.4, 5.6>)") == "0.03 0.26 0.22");
  CHECK(value(3, "vturbulence(2, 0.5, 0, <1.2, 3.4, 5.6>)") ==
        value(3, "vturbulence(2, 0.5, 1, <1.2, 3.4, 5.6>)"));
  CHECK(
      value("vlength(vturbulence(2, 0.9, 99, <1.2, 3.4, 5.6>) - vturbulence(2, 0.9, 10, <1.2, 3.4, 5.6>))") ==
      "0.000");
  CHECK(value("vlength(vturbulence(2, 0.9, 10, <1.2, 3.4, 5.6>) - vturbulence(2, 0.9, 9, <1.2, 3.4, 5.6>)) > "
              "0") == "1.000");
}

TEST_CASE("numbers as text are as wide as 254 characters") {
  CHECK(value("strlen(str(1, 254, 0))") == "254.000");
  CHECK(output("#debug str(1, 255, 0)") == "<invalid>");
  CHECK(output("#debug str(1, -255, 0)") == "<invalid>");
  CHECK(value("strlen(str(1, -254, 0))") == "254.000");
  CHECK(value("strlen(str(1, 0, 252))") == "254.000");
  CHECK(output("#debug str(1, 0, 253)") == "1");
  CHECK(output("#debug str(-0.5, -8, 2)") == "-0000.50");
  CHECK(output("#debug str(-0.5, 8, 2)") == "   -0.50");
  CHECK(output("#debug str(-0.5, -5, 2)") == "-0.50");
  CHECK(output("#debug str(-0.5, -6, 2)") == "-00.50");
  CHECK(output("#debug str(12.5, 4, 1)") == "12.5");
  CHECK(output("#debug str(12.5, 5, 1)") == " 12.5");
  CHECK(output("#debug str(12.5, 2, 1)") == "12.5");
  CHECK(output("#debug str(1e400, -6, 1)") == "   inf");
  CHECK(output("#debug str(-1e400, -6, 1)") == "  -inf");
  CHECK(output("#debug str(1.5, 0, -7)") == "1.500000");
  CHECK(output("#debug vstr(2, <1, 2, 3>, \",\", -4, 1)") == "01.0,02.0");
  CHECK(output("#debug vstr(5, <1, 2, 3, 4, 5>, \"; \", 0, 0)") == "1; 2; 3; 4; 5");
  CHECK(output("#debug vstr(4, 7, \",\", 0, 0)") == "7,0,0,0");
}

TEST_CASE("parts of strings begin and end in them") {
  CHECK(output("#debug substr(\"abc\", 1, 3)") == "abc");
  CHECK(output("#debug substr(\"abc\", 3, 1)") == "c");
  CHECK(output("#debug concat(\"[\", substr(\"abc\", 2, 0), \"]\")") == "[]");
  CHECK(output("#debug concat(\"[\", substr(\"abc\", 4, 0), \"]\")") == "[]");
  CHECK(output("#debug concat(\"[\", substr(\"abc\", 0, 3), \"]\")") == "[]");
  const std::string outside = "substr() reaches outside its string";
  for (const char* arguments : {"4, 1", "1, 4", "3, 2", "-1, 1", "2, -1", "5, 0", "0, 4"}) {
    INFO(arguments);
    CHECK(error_line("#debug substr(\"abc\", " + std::string(arguments) + ")").find(outside) !=
          std::string::npos);
  }
}

TEST_CASE("letters of both cases, to the first and the last") {
  CHECK(output("#debug strupr(\"`az{mAZ09\")") == "`AZ{MAZ09");
  CHECK(output("#debug strlwr(\"@AZ[Maz09\")") == "@az[maz09");
  CHECK(value("strcmp(\"a\", \"\") + 1000 * strcmp(\"\", \"b\")") == "-97903.000");
  CHECK(value("strcmp(chr(200), \"a\")") == "103.000");
  CHECK(value("strcmp(\"\", \"\")") == "0.000");
}

TEST_CASE("texts as numbers") {
  CHECK(value("val(\"-2.5e1\")") == "-25.000");
  CHECK(value("val(\"+3\")") == "3.000");
  CHECK(value("val(\" \\t 7 apples\")") == "7.000");
  CHECK(value("val(\"0XfF\")") == "255.000");
  CHECK(value("val(\"0x\")") == "0.000");
  CHECK(value("val(\"\")") == "0.000");
  CHECK(value("val(\"0\")") == "0.000");
  CHECK(value("val(\"07\")") == "7.000");
}

TEST_CASE("codes of characters take one to three bytes") {
  for (const char* code : {"1", "127", "128", "255", "256", "2047", "2048", "4660", "65535"}) {
    INFO(code);
    CHECK(value("asc(chr(" + std::string(code) + "))") == std::string(code) + ".000");
  }
  CHECK(
      value(
          "strlen(chr(255)) + 10 * strlen(chr(256)) + 100 * strlen(chr(2047)) + 1000 * strlen(chr(2048))") ==
      "3221.000");
  // Bytes that look like the first of several.
  CHECK(value("asc(concat(chr(195), \"a\"))") == "195.000");
  CHECK(value("asc(concat(chr(195), chr(128)))") == "195.000"); // shorter than it has to be
  CHECK(value("asc(concat(chr(226), chr(130)))") == "226.000");
  CHECK(value("asc(concat(chr(226), chr(130), \"a\"))") == "226.000");
  CHECK(value("asc(concat(chr(240), chr(144), chr(128), chr(128)))") == "240.000");
  CHECK(value("asc(chr(128))") == "128.000");
}

TEST_CASE("dates") {
  CHECK(output("#debug datetime(0)") == "2000-01-01 00:00:00Z");
  CHECK(output("#debug datetime(366.5)") == "2001-01-01 12:00:00Z");
  CHECK(output("#debug datetime(-1, \"%d.%m.%y\")") == "31.12.99");
  CHECK(output("#debug concat(\"[\", datetime(1, \"\"), \"]\")") == "[]");
  CHECK(error_line("#debug datetime(1e12)").find("this date is out of range") != std::string::npos);
  CHECK(error_line("#debug datetime(-1e12)").find("this date is out of range") != std::string::npos);
}

TEST_CASE("splines at, between and beyond knots that are not evenly spread") {
  const auto spline = [](const std::string& kind, const std::string& at) {
    return output("#declare S = spline { " + kind +
                  " -1, <1, 5, 2> 0.5, <3, -1, 0> 1, <4, 4, -2> 3, <0, 2, 1> 4, <2, 2, 2> } "
                  "#debug vstr(3, S(" +
                  at + "), \" \", 0, 4)");
  };
  CHECK(spline("linear_spline", "-0.25") == "2.0000 2.0000 1.0000");
  CHECK(spline("linear_spline", "0.5") == "3.0000 -1.0000 0.0000");
  CHECK(spline("linear_spline", "3.5") == "1.0000 2.0000 1.5000");
  CHECK(spline("linear_spline", "-2") == "1.0000 5.0000 2.0000");
  CHECK(spline("linear_spline", "-1") == "1.0000 5.0000 2.0000");
  CHECK(spline("linear_spline", "4") == "2.0000 2.0000 2.0000");
  CHECK(spline("quadratic_spline", "-0.25") == "1.8125 -1.9375 1.7500");
  CHECK(spline("quadratic_spline", "0.75") == "3.4792 1.0625 -0.9167");
  CHECK(spline("quadratic_spline", "2") == "3.6000 7.4000 -2.7000");
  CHECK(spline("quadratic_spline", "3.5") == "0.6667 1.9167 1.5417");
  CHECK(spline("quadratic_spline", "3") == "0.0000 2.0000 1.0000");
  CHECK(spline("cubic_spline", "0.75") == "3.6042 1.4062 -1.0885");
  CHECK(spline("cubic_spline", "2") == "2.0000 4.2500 -1.1250");
  CHECK(spline("cubic_spline", "0.5") == "3.0000 -1.0000 0.0000");
  CHECK(spline("cubic_spline", "0") == "3.0000 -1.0000 0.0000");
  CHECK(spline("cubic_spline", "3") == "0.0000 2.0000 1.0000");
  CHECK(spline("cubic_spline", "3.5") == "0.0000 2.0000 1.0000");
  CHECK(spline("natural_spline", "-0.25") == "1.7256 -1.2762 1.7107");
  CHECK(spline("natural_spline", "0.75") == "3.5884 1.4232 -1.0527");
  CHECK(spline("natural_spline", "2") == "2.2683 5.8134 -1.7799");
  CHECK(spline("natural_spline", "3.5") == "0.5915 1.5546 1.7069");
  CHECK(spline("natural_spline", "1") == "4.0000 4.0000 -2.0000");
  const auto short_one = [](const std::string& kind, const std::string& knots, const std::string& at) {
    return output("#declare S = spline { " + kind + " " + knots + " } #debug vstr(2, S(" + at +
                  "), \" \", 0, 4)");
  };
  CHECK(short_one("linear_spline", "0, <1, 2> 2, <5, 4>", "0.5") == "2.0000 2.5000");
  CHECK(short_one("quadratic_spline", "0, <1, 2> 2, <5, 4>", "0.5") == "2.0000 2.5000");
  CHECK(short_one("natural_spline", "0, <1, 2> 2, <5, 4>", "0.5") == "2.0000 2.5000");
  CHECK(short_one("cubic_spline", "0, <1, 2> 2, <5, 4>", "0.5") == "3.0000 3.0000");
  CHECK(short_one("cubic_spline", "0, <1, 2> 2, <5, 4> 3, <0, 0>", "0.5") == "5.0000 4.0000");
  CHECK(short_one("cubic_spline", "0, <1, 2>", "0.5") == "1.0000 2.0000");
  CHECK(short_one("linear_spline", "0, <1, 2> 0, <3, 4> 1, <5, 6>", "0") == "3.0000 4.0000");
  CHECK(short_one("linear_spline", "1, <5, 6> 0, 3", "0.5") == "4.0000 4.5000");
}

TEST_CASE("patterns have POV-Ray's colours by themselves") {
  const std::string grey = "0:0,0,0 1:1,1,1";
  for (const char* pattern : {"boxed",
                              "bumps",
                              "cells",
                              "crackle",
                              "cylindrical",
                              "dents",
                              "gradient x",
                              "granite",
                              "leopard",
                              "onion",
                              "pigment_pattern { bozo }",
                              "planar",
                              "quilted",
                              "ripples",
                              "slope y",
                              "spherical",
                              "spiral1 2",
                              "spiral2 2",
                              "spotted",
                              "waves",
                              "wrinkles"}) {
    INFO(pattern);
    CHECK(colours_of(pattern) == grey);
  }
  CHECK(colours_of("agate") ==
        "0:1,1,1 0.5:0.95,0.75,0.5 0.5:0.9,0.7,0.5 0.6:0.9,0.7,0.4 0.6:1,0.7,0.4 1:0.6,0.3,0");
  CHECK(colours_of("bozo") == "0.4:1,1,1 0.4:0,1,0 0.6:0,1,0 0.6:0,0,1 0.8:0,0,1 0.8:1,0,0");
  CHECK(colours_of("brick") == "0:0.5,0.5,0.5 1:0.6,0.15,0.15");
  CHECK(colours_of("checker") == "0:0,0,1 1:0,1,0");
  CHECK(colours_of("cubic") == "0:1,0,0 1:0,1,0 2:0,0,1 3:1,1,0 4:0,1,1 5:1,0,1");
  CHECK(colours_of("triangular") == "0:1,0,0 1:0,1,0 2:0,0,1 3:1,1,0 4:0,1,1 5:1,0,1");
  CHECK(colours_of("hexagon") == "0:0,0,1 1:0,1,0 2:1,0,0");
  CHECK(colours_of("square") == "0:1,0,0 1:0,1,0 2:0,0,1 3:1,1,0");
  CHECK(colours_of("object { sphere { 0, 1 } }") == "0:0,0,1 1:0,1,0");
  const std::string fractal = "0.001:0,0,0 0.001:0,1,1 0.012:1,1,0 0.015:1,0,1 0.1:0,1,1";
  CHECK(colours_of("mandel 9") == fractal);
  CHECK(colours_of("julia <0, 1>, 9") == grey);
  CHECK(colours_of("magnet 1 mandel 9") == grey);
  CHECK(colours_of("magnet 2 julia <0, 1>, 9") == grey);
  CHECK(colours_of("marble") == "0:0.9,0.8,0.8 0.9:0.9,0.08,0.08 0.9:0,0,0 1:0,0,0");
  CHECK(colours_of("radial") == "0:0,1,1 0.333:1,1,0 0.666:1,0,1 1:0,1,1");
  CHECK(colours_of("wood") == "0.6:0.666,0.312,0.2 0.6:0.4,0.1333,0.066");
}

TEST_CASE("POV-Ray's own functions have as many arguments as POV-Ray's") {
  const std::vector<int> parameters = {5, 5, 5, 5, 2,  2, 5, 4, 2, 1, 4, 1, 1, 1, 1, 6, 6, 3, 1, 4,
                                       3, 6, 1, 1, 10, 7, 7, 1, 1, 6, 1, 3, 4, 3, 6, 1, 1, 4, 1, 6,
                                       5, 1, 1, 1, 4,  1, 3, 0, 1, 1, 7, 5, 6, 1, 1, 1, 3, 0, 6, 6,
                                       4, 1, 5, 4, 6,  1, 4, 7, 2, 0, 2, 3, 1, 1, 2, 6, 0};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const int expected = 3 + parameters[i];
    const std::string start = "#declare F = function { internal(" + std::to_string(i) + ") } #declare A = F(";
    INFO(start);
    std::string arguments = "1";
    for (int argument = 1; argument < expected; ++argument)
      arguments += ", 1";
    const std::string less = error_line(start + arguments.substr(3) + ");"),
                      more = error_line(start + arguments + ", 1);"),
                      right = error_line(start + arguments + ");");
    CHECK(less.find(std::to_string(expected)) != std::string::npos);
    CHECK(more.find(std::to_string(expected)) != std::string::npos);
    CHECK((right.empty() || right.find("is not supported yet") != std::string::npos));
  }
  CHECK_FALSE(error_line("#declare F = function { internal(79) }").empty());
  CHECK_FALSE(error_line("#declare F = function { internal(-1) }").empty());
}

TEST_CASE("POV-Ray's own functions at points without symmetry") {
  const auto internal = [](int number, const std::string& arguments) {
    return output("#declare F = function { internal(" + std::to_string(number) + ") } #debug str(F(" +
                  arguments + "), 0, 5)");
  };
  CHECK(internal(17, "1, 2, 3, 4, 5, 6") == "20.97618");
  CHECK(internal(47, "1, 2, 3") == "1.00685");
  CHECK(internal(51, "3, 2, 4, 0.5, 0.25, 0.125, 3, 7") == "-132.50000");
  CHECK(internal(57, "2, 3, 6") == "7.00000");
  CHECK(internal(60, "1, 2, 3, 0.25, 0.5, 1.5, 2.5") == "1.04904");
  CHECK(internal(60, "0.1, 0.1, 0.1, 0.25, 0.5, 1.5, 2.5") == "-0.25000");
  CHECK(internal(61, "2, 3, 6, 1.5") == "5.50000");
  CHECK(internal(68, "0.5, 0.25, 0.75, 0.5, 0.8") == "0.14764");
  CHECK(internal(69, "1, 5, 2") == "0.46365");
  CHECK(internal(70, "3, 2, 4, 1.5, 0.25") == "3.78113");
}

TEST_CASE("settings at their ends") {
  const auto settings = [](const std::string& text) {
    return parse("global_settings { " + text + " } sphere { 0, 1 }");
  };
  CHECK(settings("max_trace_level 256").max_trace_level == 256);
  CHECK(settings("max_trace_level 257").max_trace_level == 256);
  CHECK(settings("max_trace_level 1").max_trace_level == 1);
  CHECK(settings("max_trace_level 0").max_trace_level == 1);
  CHECK(settings("max_trace_level 7.9").max_trace_level == 7);
  CHECK(settings("adc_bailout 1").adc_bailout == 1);
  CHECK(settings("adc_bailout 0.25").adc_bailout == 0.25);
  CHECK_FALSE(settings("adc_bailout 1").objects.empty());
  CHECK(settings("number_of_waves 1000.5").number_of_waves == 1000);
  CHECK(settings("number_of_waves 1").number_of_waves == 1);
  CHECK(settings("number_of_waves 0").number_of_waves == 1);
  CHECK(settings("number_of_waves 3").number_of_waves == 3);
  CHECK(error_line("global_settings { number_of_waves 1001 }").find("at most 1000 waves") !=
        std::string::npos);
  CHECK(settings("noise_generator 1").noise_generator == 1);
  CHECK(settings("noise_generator 3.5").noise_generator == 3);
  for (const char* number : {"0.9", "4"})
    CHECK(error_line("global_settings { noise_generator " + std::string(number) + " }")
              .find("noise generators") != std::string::npos);
  CHECK(error_line("global_settings { assumed_gamma 0 }").find("must be greater than 0") !=
        std::string::npos);
  CHECK(settings("assumed_gamma 1e-3").assumed_gamma == 1e-3);
}

TEST_CASE("fractals at the ends of what they take") {
  const auto fractal = [](const std::string& text) {
    return std::get<pattern::Fractal>(material("pigment { " + text + " }").pigment.map->pattern.kind);
  };
  const auto warns = [](const std::string& pigment, const char* of) {
    return output("sphere { 0, 1 pigment { " + pigment + " } }").find(of) != std::string::npos;
  };
  const char* const less = "less than 0 iterations";
  CHECK(fractal("mandel -0.5").interior_factor == 1);
  CHECK_FALSE(warns("mandel -0.5", less));
  CHECK(fractal("mandel -1").interior_factor == 0.55);
  CHECK(warns("mandel -1", less));
  const char* const many = "this fractal has 65535 iterations";
  CHECK(fractal("mandel 65535").iterations == 65535);
  CHECK_FALSE(warns("mandel 65535.9", many));
  CHECK(warns("mandel 65536", many));
  CHECK(fractal("mandel 1").iterations == 1);
  const char* const unknown = "a fractal's exponent is one of 2 to 33";
  CHECK(fractal("mandel 9 exponent 2.5").exponent == 2);
  CHECK_FALSE(warns("mandel 9 exponent 2", unknown));
  CHECK(warns("mandel 9 exponent 1.9", unknown));
  CHECK(fractal("mandel 9 exponent 33").exponent == 33);
  CHECK_FALSE(warns("mandel 9 exponent 33.9", unknown));
  CHECK(warns("mandel 9 exponent 34", unknown));
  CHECK(fractal("mandel 9").exponent == 2);
  CHECK(fractal("mandel 9 exterior 0, 3").exterior == 0);
  CHECK(fractal("mandel 9 exterior 8.5, 3").exterior == 8);
  CHECK(fractal("mandel 9 interior 8.5, 3").interior == 8);
  CHECK(fractal("mandel 9").exterior == 1);
  CHECK(fractal("mandel 9").exterior_factor == 1);
  CHECK(fractal("mandel 9").interior == 0);
  CHECK(fractal("mandel 9").interior_factor == 1);
  for (const char* word : {"exterior", "interior"})
    for (const char* type : {"-0.1", "9"})
      CHECK(error_line("sphere { 0, 1 pigment { mandel 5 " + std::string(word) + " " + type + ", 2 } }")
                .find("must lie between 0 and 8") != std::string::npos);
  CHECK(fractal("magnet 0 mandel 5").magnet == 0);
  CHECK(fractal("magnet 1 mandel 5").magnet == 1);
  for (const char* magnet : {"3", "1.5", "-1"})
    CHECK(error_line("sphere { 0, 1 pigment { magnet " + std::string(magnet) + " mandel 5 } }")
              .find("a magnet is of kind 1 or 2") != std::string::npos);
  CHECK(error_line("sphere { 0, 1 pigment { magnet 1 bozo 5 } }") != "");
  CHECK(error_line("sphere { 0, 1 pigment { magnet 1 gradient 5 } }").find("expected 'mandel' or 'julia'") !=
        std::string::npos);
}

TEST_CASE("turbulence has one to ten octaves") {
  const auto octaves = [](const std::string& number) {
    return material("pigment { bozo turbulence 1 octaves " + number + " }")
        .pigment.map->pattern.turbulence.octaves;
  };
  CHECK(octaves("0") == 1);
  CHECK(octaves("1.9") == 1);
  CHECK(octaves("2") == 2);
  CHECK(octaves("10") == 10);
  CHECK(octaves("11") == 10);
}

TEST_CASE("fogs that divide by zero have these numbers") {
  const Fog low = parse("fog { fog_type 2 distance 3 rgbft <1, 2, 3, 0.4, 0.5> turbulence 0.5 }").fogs.at(0);
  CHECK(low.altitude == 1e-10);
  CHECK(low.distance == 1e-4);
  CHECK(low.filter == 0);
  CHECK(low.transmit == 0);
  CHECK(low.turbulence.amount == Vec3(0));
  const Fog whole =
      parse("fog { fog_type 2 fog_alt 2 distance 3 rgbft <1, 2, 3, 0.4, 0.5> up 2*x turbulence 0.5 }")
          .fogs.at(0);
  CHECK(whole.altitude == 2);
  CHECK(whole.distance == 3);
  CHECK(whole.colour == Vec3(1, 2, 3));
  CHECK(whole.filter == 0.4);
  CHECK(whole.transmit == 0.5);
  CHECK(whole.up == Vec3(1, 0, 0));
  CHECK(whole.turbulence.amount == Vec3(0.5));
  CHECK(parse("fog { fog_type 2 rgb 1 }").fogs.at(0).distance == 0);
  CHECK(parse("fog { fog_type 2.9 fog_alt 1 distance 1 rgb 1 }").fogs.at(0).is_ground);
  CHECK_FALSE(parse("fog { fog_type 1.9 distance 1 rgb 1 }").fogs.at(0).is_ground);
  CHECK_FALSE(parse("fog { fog_type 3 distance 1 rgb 1 }").fogs.at(0).is_ground);
  CHECK(output("fog { fog_type 3 distance 1 rgb 1 }").find("fogs of type 1 and 2") != std::string::npos);
  CHECK(output("fog { fog_type 1 distance 1 rgb 1 }").find("fogs of type") == std::string::npos);
}

TEST_CASE("reflection of one colour is the whole range, but not by Fresnel's law") {
  const auto finish = [](const std::string& text) {
    return material("finish { reflection { " + text + " } }").finish;
  };
  CHECK(finish("0.5").reflection_min == Vec3(0.5));
  CHECK(finish("0.5").reflection_max == Vec3(0.5));
  CHECK(finish("0.5 fresnel on").reflection_min == Vec3(0));
  CHECK(finish("0.5 fresnel off").reflection_min == Vec3(0.5));
  CHECK(finish("0.2, 0.5 fresnel on").reflection_min == Vec3(0.2));
  CHECK(finish("0.2, 0.5").reflection_min == Vec3(0.2));
  CHECK(finish("0.2, 0.5").reflection_max == Vec3(0.5));
  CHECK(finish("0.5").reflection_falloff == 1);
  CHECK(finish("0.5").reflection_exponent == 1);
  CHECK(finish("0.5").reflection_metallic == 0);
  CHECK_FALSE(finish("0.5").reflection_fresnel);
  CHECK(finish("0.5 falloff 2 exponent 0.5 metallic 0.25").reflection_falloff == 2);
  CHECK(finish("0.5 falloff 2 exponent 0.5 metallic 0.25").reflection_exponent == 0.5);
  CHECK(finish("0.5 falloff 2 exponent 0.5 metallic 0.25").reflection_metallic == 0.25);
}

TEST_CASE("a matrix's columns that are zero become ones") {
  const auto corner = [](const std::string& matrix) {
    return parse("sphere { 0, 1 matrix <" + matrix + "> }").objects.at(0).transform.point({2, 3, 4});
  };
  CHECK(corner("1,0,0, 0,0,0, 0,0,1, 0,0,0") == Vec3(2, 3, 4));
  CHECK(corner("0,0,0, 0,2,0, 0,0,3, 5,6,7") == Vec3(7, 12, 19));
  CHECK(corner("1,0,0, 0,2,0, 0,0,0, 5,6,7") == Vec3(7, 12, 11));
  CHECK(corner("1,0,0.5, 0,2,0, 0,0,1e-11, 0,0,0") == Vec3(2, 6, 1 + 4e-11));
  CHECK(error_line("sphere { 0, 1 matrix <1,0,0, 0,1,0, 0,0,1, 0,0> }")
            .find("a matrix has 12 numbers, not 11") != std::string::npos);
  CHECK(error_line("sphere { 0, 1 matrix <1,0,0, 0,1,0, 0,0,1, 0,0,x> }")
            .find("expected a float, found a vector") != std::string::npos);
}

TEST_CASE("subscripts are whole numbers from 0 to the size less 1") {
  const std::string array = "#declare A = array[3] {5, 6, 7}; #declare B = ";
  CHECK(output(array + "A[2.9]; #debug str(B, 0, 0)") == "7");
  CHECK(output(array + "A[-0.9]; #debug str(B, 0, 0)") == "5");
  CHECK(error_line(array + "A[-1];").find("this subscript is out of range") != std::string::npos);
  CHECK(error_line(array + "A[-1.5];").find("this subscript is out of range") != std::string::npos);
  CHECK(error_line(array + "A[1e15];").find("this subscript is out of range") != std::string::npos);
  CHECK(error_line(array + "A[3];").find("subscript 3 is out of range, the array has 3 elements") !=
        std::string::npos);
  CHECK(error_line(array + "A[1][0];").find("not an array with so many dimensions") != std::string::npos);
}

TEST_CASE("versions up to 3.7 are known") {
  CHECK(error_line("#version 3.7;").empty());
  CHECK(error_line("#version 3.704;").empty());
  CHECK(error_line("#version 3.71;").find("this scene needs version 3.71") != std::string::npos);
  CHECK(error_line("#version 3.8;").find("this scene needs version 3.8") != std::string::npos);
  CHECK(error_line("#version unofficial 3.6;").empty());
  // From 3.5 on a number that is declared has a semicolon.
  CHECK(error_line("#version 3.49; #declare A = 1 sphere { 0, 1 }").empty());
  CHECK_FALSE(error_line("#version 3.5; #declare A = 1 sphere { 0, 1 }").empty());
}

TEST_CASE("every part of a cone whose radius is below 0") {
  const auto count = [](const std::string& radii) {
    return parse("cone { 0, " + radii + " }").objects.size();
  };
  CHECK(count("-1, y, 0") == 1);
  CHECK(count("0, y, -1") == 1);
  CHECK(count("-1, y, 1") == 2);
  CHECK(count("1, y, 2") == 1);
  const auto warns = [](const std::string& radii) {
    return output("cone { 0, " + radii + " }").find("shows a part of this cone only") != std::string::npos;
  };
  CHECK(warns("-1, y, 0"));
  CHECK(warns("1, y, -1.5"));
  CHECK_FALSE(warns("1, y, -0.5"));
  CHECK_FALSE(warns("1, y, -1"));
}

TEST_CASE("area lights shine from 16 places a side at the most if from all of them") {
  const auto places = [](const std::string& counts) {
    return parse("light_source { 0 rgb 1 area_light x, y, " + counts + " area_illumination }").lights.size();
  };
  CHECK(places("16, 1") == 16);
  CHECK(places("17, 1") == 16);
  CHECK(places("2, 17") == 32);
  const auto lights =
      parse("light_source { 0 rgb <1, 2, 4> area_light 4*x, 2*y, 2, 1 area_illumination }").lights;
  REQUIRE(lights.size() == 2);
  CHECK(lights[0].location == Vec3(-2, 0, 0));
  CHECK(lights[1].location == Vec3(2, 0, 0));
  CHECK(lights[1].colour == Vec3(0.5, 1, 2));
  CHECK(error_line("light_source { 0 rgb 1 area_light x, y, 256.9, 256 }").empty());
  CHECK_FALSE(error_line("light_source { 0 rgb 1 area_light x, y, 0.9, 2 }").empty());
  CHECK_FALSE(error_line("light_source { 0 rgb 1 area_light x, y, 2, 257 }").empty());
}

TEST_CASE("what rays meet of shapes that others cut") {
  const auto hit = [](const std::string& object, const std::string& ray) {
    return output("#declare O = " + object + " #declare N = <0, 0, 0>; #declare P = trace(O, " + ray +
                  ", N); #debug concat(vstr(3, P, \" \", 0, 3), \" facing \", vstr(3, N, \" \", 0, 3))");
  };
  // The second and third of what is taken away, and the first of what is common.
  CHECK(hit("difference { box { -1, 1 } sphere { -z, 0.5 } sphere { -0.5*z, 0.75 } }", "-5*z, z") ==
        "0.000 0.000 0.250 facing 0.000 0.000 -1.000");
  CHECK(hit("intersection { box { -1, 1 } box { <-2, -2, -0.5>, 2 } }", "-5*z, z") ==
        "0.000 0.000 -0.500 facing 0.000 0.000 -1.000");
  CHECK(hit("intersection { box { <-2, -2, -0.5>, 2 } box { -1, 1 } }", "5*z, -z") ==
        "0.000 0.000 1.000 facing 0.000 0.000 1.000");
  CHECK(hit("merge { box { -1, 1 } box { <-2, -2, 0>, 2 } }", "<0, 0, 0.5>, z") ==
        "0.000 0.000 2.000 facing 0.000 0.000 1.000");
  CHECK(hit("union { box { -1, 1 } box { <-2, -2, 0>, 2 } }", "<0, 0, 0.5>, z") ==
        "0.000 0.000 1.000 facing 0.000 0.000 1.000");
  CHECK(hit("sphere { 0, 1 }", "-5*z, 0") == "0.000 0.000 0.000 facing 0.000 0.000 0.000");
  // A ray neither meets what it starts at, nor what is further than 1e7.
  CHECK(hit("plane { z, 0 }", "-1e-7*z, z") == "0.000 0.000 0.000 facing 0.000 0.000 0.000");
  CHECK(hit("plane { z, 0 }", "<0, 0, -1e-5>, z") == "0.000 0.000 0.000 facing 0.000 0.000 1.000");
  CHECK(hit("plane { z, 0 }", "-1.1e7*z, z") == "0.000 0.000 0.000 facing 0.000 0.000 0.000");
  CHECK(hit("plane { z, 0 }", "-9e6*z, z") == "0.000 0.000 0.000 facing 0.000 0.000 1.000");
}

TEST_CASE("the lesser of an object's extent and its bounds'") {
  const auto extent = [](const std::string& object) {
    return output(
        "#declare O = " + object +
        " #debug concat(vstr(3, min_extent(O), \" \", 0, 1), \" to \", vstr(3, max_extent(O), \" \", 0, 1))");
  };
  CHECK(extent("sphere { 0, 1 bounded_by { box { -0.5, 0.5 } } }") == "-0.5 -0.5 -0.5 to 0.5 0.5 0.5");
  CHECK(extent("sphere { 0, 1 bounded_by { box { -2, 2 } } }") == "-1.0 -1.0 -1.0 to 1.0 1.0 1.0");
  CHECK(extent("box { -1, 1 bounded_by { box { 0, 2 } } }") == "-1.0 -1.0 -1.0 to 1.0 1.0 1.0"); // as large
  CHECK(extent("sphere { 0, 1 clipped_by { box { -0.5, 0.5 inverse } } }") ==
        "-1.0 -1.0 -1.0 to 1.0 1.0 1.0");
  CHECK(extent("difference { box { -2, 2 } plane { x, 1 } plane { y, 0 inverse } }") ==
        "1.0 -2.0 -2.0 to 2.0 0.0 2.0");
  CHECK(extent("difference { plane { x, 1 } box { -2, 2 } }").find("to 1.0") != std::string::npos);
}

TEST_CASE("objects are tried against their bounds until that takes too long") {
  const auto is_warned = [](int before) {
    return output("#for (I, 1, " + std::to_string(before) +
                  ") sphere { 0, 1 bounded_by { box { -1, 1 } } } #end "
                  "sphere { 0, 1 bounded_by { box { -0.5, 0.5 } } }")
               .find("reaches out of its 'bounded_by'") != std::string::npos;
  };
  CHECK(is_warned(65));
  CHECK_FALSE(is_warned(66));
  // From all six sides, and near to the edges of what is tried.
  for (const char* side :
       {"<0.7, 0, 0>", "<-0.7, 0, 0>", "<0, 0.7, 0>", "<0, -0.7, 0>", "<0, 0, 0.7>", "<0, 0, -0.7>"}) {
    INFO(side);
    CHECK(output("union { box { -1, 1 } sphere { " + std::string(side) +
                 " * 2, 0.5 } bounded_by { box { -1, 1 } } }")
              .find("reaches out") != std::string::npos);
  }
}
