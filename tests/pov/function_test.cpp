// Functions and splines that a scene declares. Expected numbers are POV-Ray 3.7's.
#include <catch2/catch.hpp>

#include "pov/parsing.hpp"

using namespace celltrace;
using test::error_line;
using test::output;

namespace {

const std::string kF = "#declare f = function(x, y, z) { sin(x)*2 + y*-z + (x < y & y != 3) } ";

std::string number(const std::string& declarations, const std::string& expression) {
  return output(declarations + "#debug str(" + expression + ", 0, 6)");
}

std::string vector(const std::string& declarations, int count, const std::string& expression) {
  return output(declarations + "#debug vstr(" + std::to_string(count) + ", " + expression + ", \" \", 0, 6)");
}

} // namespace

TEST_CASE("declared functions of floats") {
  CHECK(number(kF, "f(1, 2, 3)") == "-3.317058");
  const std::string g =
      kF + "#declare g = function(a, b) { select(a, -1, sqrt(b), f(a, b, 1)) + max(a, b, 3) } ";
  CHECK(number(g, "g(1, 2)") == "3.682942");
  CHECK(number(g, "g(0, 2)") == "4.414214");
  CHECK(number(g, "g(-1, -2)") == "2.000000"); // the root is not taken
  CHECK(number("#declare F = function { x + 10*y + 100*z } ", "F(1, 2, 3)") == "321.000000");
  CHECK(number("#declare K = 3; #declare V = <1, 2>; #declare F = function(K) { !(K - 1) + V.y*K } ",
               "F(1)") == "3.000000");
  CHECK(number("#macro twice(A) (2*A) #end #declare F = function(a) { twice(3) + a } ", "F(4)") ==
        "10.000000");
  // u and v are other names of x and y; of parameters with one name the last counts.
  CHECK(number("#declare F = function { x + 10*u + 100*v + 1000*z } ", "F(1, 2, 3)") == "3211.000000");
  CHECK(number("#declare F = function(x, y, u) { x + 10*u + 100*y + 1000*v } ", "F(1, 2, 3)") ==
        "2233.000000");
  CHECK(number("#declare F = function(a) { a + 10*y } ", "F(4)") ==
        "scene.pov:1:35: warning: 'y' is no parameter of this function: it is 0 here\n4.000000");
  CHECK(number("#declare F = function(x) { sum(x, 1, 3, x) + sum(u, 1, 2, u) } ", "F(5)") == "25.000000");
  const std::string s = "#declare s = function(n) { sum(i, 1, n, i*i) + prod(i, 1, n, i) } ";
  CHECK(number(s, "s(4)") == "54.000000");
  CHECK(number(s, "s(0)") == "1.000000");
  // What a name stands for is settled when the function is declared.
  CHECK(number("#declare A = function(x) { x } #declare B = function(x) { A(x) + 1 } "
               "#declare A = function(x) { 100 } ",
               "B(1)") == "2.000000");
}

TEST_CASE("functions of transformations and splines, and POV-Ray's own") {
  CHECK(vector("#declare F = function { transform { rotate y*30 translate z } } ", 3, "F(1, 2, 0)") ==
        "0.866025 2.000000 0.500000");
  CHECK(vector("#declare F = function { spline { 0, x 1, y } } ", 2, "F(0.25)") == "0.750000 0.250000");
  CHECK(
      number("#declare F = function { transform { scale 10 } } #declare G = function(a) { F(a, 1, 3).gray } ",
             "G(2)") == "15.250000");
  CHECK(number("#declare F = function { transform { scale 3 } } #declare G = function(a) { F(a, 1, 1).x } ",
               "G(2)") == "6.000000");
  CHECK(number("#declare F = function { internal(61) } ", "F(1, 2, 3, 1)") == "2.741657");
  CHECK(number("#declare F = function { internal(76) } ", "F(1.2, 3.4, 5.6)") == "0.535667");
  CHECK(number("#declare F = function { internal(78) } ", "F(1.2, 3.4, 5.6, 3)") == "0.525027");
  CHECK(vector("", 3, "vturbulence(2, 0.5, 6, <1.1, 2.2, 3.3>)") == "-0.492049 -0.251254 0.422431");
}

TEST_CASE("faults of functions") {
  CHECK(error_line(kF + "#debug str(f(1, 2), 0, 0)") ==
        "scene.pov:1:82: error: this function takes 3 arguments, not 2");
  CHECK(error_line("#declare F = function(a) { a + b }") == "scene.pov:1:32: error: 'b' is not declared");
  CHECK(error_line("#declare F = function(a) { a + }") ==
        "scene.pov:1:32: error: unexpected '}', expected a number");
  CHECK(error_line("#declare F = function(a) { F(a) }") == "scene.pov:1:28: error: 'F' is not declared");
  CHECK(error_line("#declare F = function { internal(77) }") ==
        "scene.pov:1:33: error: there is no internal function of this number");
  CHECK(error_line("#declare F = function(n) { sum(i, 1, n, 1) } #declare A = F(1e15);") ==
        "scene.pov:1:59: error: this function takes too long");
  CHECK(error_line("#declare F = function(a) { rand(a) }") ==
        "scene.pov:1:28: error: rand() is no function that functions may call");
  std::string nested =
      "#declare F = function(x) { x } #for (I, 1, 1000) #declare F = function(x) { F(x) } #end";
  CHECK(error_line(nested) == "scene.pov:1:77: error: functions call one another too deeply");
}

TEST_CASE("functions go on with what is no number") {
  struct Row {
    const char* expression;
    const char* argument;
    const char* value;
  };
  // Where an operand is no number, its sign is the processor's.
  const Row kRows[] = {
      {"ln(x)", "0", "-inf"},
      {"log(x)", "0", "-inf"},
      {"1/x", "0", "inf"},
      {"-1/x", "0", "-inf"},
      {"pow(x, -1)", "0", "inf"},
      {"atanh(x)", "1", "inf"},
      {"exp(x)", "1000", "inf"},
      {"atan2(x, 0)", "0", "0.00"},
      {"div(7, x)", "0", "-2147483648.00"},
      {"div(x, 1)", "1e20", "-2147483648.00"},
      {"int(1/x)", "0", "-2147483648.00"},
      {"int(sqrt(x))", "-1", "-2147483648.00"},
      {"floor(1/x)", "0", "inf"},
      {"max(0.5, sqrt(x))", "-1", "0.50"},
      {"min(sqrt(x), 0.5)", "-1", "0.50"},
      {"max(0.5, sqrt(x), 0.7)", "-1", "0.70"},
      {"min(0.5, sqrt(x), 0.7)", "-1", "0.70"},
      {"min(0.5, sqrt(x), 0.2)", "-1", "0.20"},
      {"select(sqrt(x), 1, 2)", "-1", "2.00"},
      {"select(sqrt(x), 1, 2, 3)", "-1", "3.00"},
      {"select(1/x, 1, 2, 3)", "0", "3.00"},
      {"sqrt(x) < 1", "-1", "0.00"},
      {"sqrt(x) <= 1", "-1", "0.00"},
      {"sqrt(x) = 1", "-1", "0.00"},
      {"sqrt(x) != 1", "-1", "1.00"},
      {"sqrt(x) > 1", "-1", "1.00"},
      {"sqrt(x) >= 1", "-1", "1.00"},
      {"1 > sqrt(x)", "-1", "1.00"},
      {"1/x = 1/x", "0", "1.00"},
      {"sqrt(x) & 1", "-1", "1.00"},
      {"sqrt(x) | 0", "-1", "1.00"},
      {"x & 1", "1e-12", "1.00"},
      {"x = 1", "1 + 1e-12", "0.00"},
      {"sum(i, 1, sqrt(x), i)", "-1", "0.00"},
      {"prod(i, sqrt(x), 3, i)", "-1", "1.00"},
      {"mod(1, 1/x)", "0", "1.00"},
      {"pow(-1, 1/x)", "0", "1.00"},
      {"1/min(x, -x)", "0", "inf"},
      {"1/max(x, -x)", "0", "inf"},
  };
  for (const Row& row : kRows) {
    INFO(row.expression << " at " << row.argument);
    CHECK(output("#declare F = function(x) { " + std::string(row.expression) + " } #debug str(F(" +
                 row.argument + "), 0, 2)") == row.value);
  }
  for (const char* nothing : {"sqrt(x)", "ln(x)", "log(x)", "pow(x, 0.5)", "acosh(x)", "asin(2*x)",
                              "acos(2*x)", "mod(x, 0)", "max(sqrt(x), 0.5)", "min(0.5, sqrt(x))", "0*sqrt(x)",
                              "sin(x/0)", "floor(sqrt(x))", "sum(i, 1, 2, sqrt(x))"}) {
    INFO(nothing);
    const std::string value = number("#declare F = function(x) { " + std::string(nothing) + " } ", "F(-1)");
    CHECK((value == "nan" || value == "-nan"));
  }
}

TEST_CASE("what is no number is an argument, and goes on in expressions") {
  const std::string numbers = "#declare R = function(x) { sqrt(x) } #declare V = function(x) { 1/x } "
                              "#declare N = R(-1); #declare I = V(0); ";
  const auto holds = [&](const char* condition) {
    return output(numbers + "#if (" + condition + ") #debug \"yes\" #else #debug \"no\" #end");
  };
  for (const char* condition : {"N <= 1", "N >= 1", "N = 1", "N = N", "I = I", "I > 1", "I >= I", "!N"})
    CHECK(holds(condition) == "yes");
  for (const char* condition : {"N", "N < 1", "N > 1", "N != 1", "I != I", "I < I", "N & 1", "N | 0"})
    CHECK(holds(condition) == "no");
  CHECK(number(numbers, "(N ? 2 : 3)") == "3.000000");
  CHECK(number(numbers, "select(N, 1, 2, 3)") == "3.000000");
  CHECK(number(numbers, "V(I)") == "0.000000");
  CHECK(number(numbers + "#declare S = seed(N); ", "rand(S)") == "0.500003");
  CHECK(output(numbers + "#debug str(I, -8, 2)") == "     inf");
  CHECK(number(numbers + "#declare S = function { spline { cubic_spline 0, x 1, y 2, z 3, x } } ",
               "S(N).y") == "1.000000");
  for (const char* kind : {"linear_spline", "quadratic_spline", "natural_spline"}) {
    const std::string value =
        number(numbers + "#declare S = function { spline { " + kind + " 0, x 1, y 2, z 3, x } } ", "S(N).y");
    CHECK((value == "nan" || value == "-nan"));
  }
}

TEST_CASE("components of what functions give") {
  const std::string moved = "#declare F = function { transform { scale 10 } } ";
  CHECK(number(moved + "#declare G = function { F(x, y, z).hf } ", "G(0.3, 0.2, 0.1)") == "2.996091");
  CHECK(error_line(moved + "#declare A = F(1, 2, 3).hf;") ==
        "scene.pov:1:73: error: a vector of 3 components has no such component");
}

TEST_CASE("pigments and patterns are functions of points") {
  const auto at = [](const std::string& declarations, const std::string& function) {
    return number(declarations, function + "(1.2, 3.4, 5.6)");
  };
  CHECK(at("#declare F = function { pattern { granite scale 0.3 turbulence 0.2 } } ", "F") == "0.398628");
  CHECK(at("#declare F = function { pattern { crackle metric 1 form <1, 0, 0> } } ", "F") == "0.832894");
  CHECK(at("#declare F = function { pattern { checker } } ", "F") == "1.000000");
  CHECK(at("global_settings { number_of_waves 5 } #declare F = function { pattern { ripples } } ", "F") ==
        "0.359171"); // of ten waves in any case
  CHECK(at("#declare F = function { pattern { bozo } } ", "F") == "0.535667");
  CHECK(at("#declare F = function { pattern { bozo } } global_settings { noise_generator 1 } ", "F") ==
        "0.541099");
  CHECK(at("#declare F = function { pattern { pigment_pattern { bozo color_map { [0 rgb 0] "
           "[1 rgb <1, 0.5, 0.2>] } } sine_wave } } ",
           "F") == "0.939568");
  const std::string pigment = "#declare E = function { pigment { bozo color_map { [0 rgb <1, 0, 0>] "
                              "[0.5 rgbt <0, 1, 0, 0.5>] [1 rgbf <0, 0, 1, 0.7>] } scale 0.4 } } ";
  CHECK(vector(pigment, 5, "E(1.2, 3.4, 5.6)") == "0.000000 0.878338 0.121662 0.085163 0.439169");
  CHECK(number(pigment, "E(1.2, 3.4, 5.6).gray") == "0.531211");
  CHECK(number(pigment, "E(1.2, 3.4, 5.6).transmit") == "0.439169");
  CHECK(at(pigment + "#declare A = function { pattern { granite scale 0.3 turbulence 0.2 } } "
                     "#declare F = function { E(x, y, z).hf + E(y, x, z).gray*A(x, y, z) } ",
           "F") == "0.198735");
  CHECK(
      vector(
          "#declare P = pigment { rgbft <0.1, 0.2, 0.3, 0.4, 0.5> } #declare F = function { pigment { P } } ",
          5, "F(7, 8, 9)") == "0.100000 0.200000 0.300000 0.400000 0.500000");
  // Nothing goes wrong far away, or nowhere.
  const std::string far =
      "#declare V = function(x) { 1/x } #declare I = V(0); #declare P = function { pattern { ";
  for (const char* pattern :
       {"bozo", "granite", "crackle", "cells", "checker", "hexagon", "wood", "mandel 20",
        "bozo noise_generator 3", "bozo warp { repeat x } warp { black_hole 0, 1 }"})
    for (const char* point : {"I", "-I", "I-I", "1e300", "1e20", "3e9"})
      CHECK_NOTHROW(output(far + pattern + " } } #declare A = P(" + point + ", 1, 2);"));
}

TEST_CASE("functions of what is not supported are an error where they are called") {
  const std::string declaration =
      "#declare F = function { pattern { density_file df3 \"a.png\"  scale 2 } } ";
  CHECK(error_line(declaration).empty());
  CHECK(error_line(declaration + "#declare A = F(1, 2, 3);") ==
        "scene.pov:1:86: error: 'density_file' is not supported yet");
  CHECK(error_line(declaration + "#declare G = function { F(x, y, z) } #declare A = G(1, 2, 3);") ==
        "scene.pov:1:123: error: 'density_file' is not supported yet");
  // A pattern gives one number, a pigment five.
  for (const std::string pattern : {"density_file df3 \"a.png\" ", "slope y"}) {
    INFO(pattern);
    const std::string of_pattern = "#declare F = function { pattern { " + pattern + " } } ";
    CHECK(error_line(of_pattern + "#declare G = function { F(x, y, z)*2 }").empty());
    CHECK_FALSE(error_line(of_pattern + "#declare G = function { F(x, y, z).x }").empty());
    const std::string of_pigment = "#declare F = function { pigment { " + pattern + " } } ";
    CHECK(error_line(of_pigment + "#declare G = function { F(x, y, z).transmit }").empty());
    CHECK_FALSE(error_line(of_pigment + "#declare G = function { F(x, y, z)*2 }").empty());
  }
  CHECK(
      error_line("#declare F = function { pigment { slope y } } #declare A = F(1, 2, 3);") ==
      "scene.pov:1:60: error: a pigment of surface coordinates or slopes as a function is not supported yet");
  CHECK(error_line("#declare F = function { pattern { scale 2 } }") ==
        "scene.pov:1:25: error: there is no pattern in this function");
}

TEST_CASE("splines") {
  const auto spline = [](const std::string& kind, const std::string& at) {
    return vector("#declare S = spline { " + kind +
                      " -1, <0,0,1> 0, <0,0,0> 1, <1,2,3> 2, <3,1,0> 3.5, <4,4,1> 4, <0,1,0> } ",
                  3, "S(" + at + ")");
  };
  CHECK(spline("linear_spline", "0.5") == "0.500000 1.000000 1.500000");
  CHECK(spline("linear_spline", "9") == "0.000000 1.000000 0.000000");
  CHECK(spline("quadratic_spline", "2.5") == "3.600000 1.400000 -0.400000");
  CHECK(spline("cubic_spline", "-0.5") == "0.000000 0.000000 0.000000");
  CHECK(spline("cubic_spline", "1.5") == "2.020833 1.500000 1.645833");
  CHECK(spline("cubic_spline", "2.75") == "4.437500 2.968750 0.406250");
  CHECK(spline("cubic_spline", "4") == "4.000000 4.000000 1.000000");
  CHECK(spline("natural_spline", "-0.75") == "-0.053306 -0.197849 0.381774");
  CHECK(spline("natural_spline", "2.5") == "4.537685 2.363636 -0.135975");
  const std::string mixed = "#declare S = spline { natural_spline 3.5, 4 1, <1, 2> 2, x + t*5 } ";
  CHECK(vector(mixed, 5, "S(1.7)") == "0.857200 0.266800 0.000000 4.095000 0.000000");
  CHECK(vector(mixed, 5, "S(1.7, linear_spline)") == "1.000000 0.600000 0.000000 3.500000 0.000000");
  CHECK(vector(mixed, 5, "S(1.7, quadratic_spline)") == "0.832000 0.208000 0.000000 4.200000 0.000000");
  CHECK(vector(mixed + "#declare S = spline { S linear_spline 7, 5 } ", 2, "S(6)") == "4.714286 4.714286");
  CHECK(error_line("#declare S = spline { }") == "scene.pov:1:14: error: this spline has no vectors");
}
