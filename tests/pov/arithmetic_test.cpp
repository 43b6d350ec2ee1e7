// What macros and loops repeat is evaluated without the grammar where that is possible: it has to be the
// same.
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "pov/parsing.hpp"

using celltrace::SceneError;
using celltrace::test::error_line;
using celltrace::test::output;

namespace {

const std::string kDeclared =
    "#declare A = 2.5; #declare B = <1, -2, 3>; #declare C = rgbt <0.2, 0.4, 0.6, 0.5>; "
    "#declare D = array[3] {4, <5, 6>, array[2] {7, 8}}; #declare E = array[2]; "
    "#declare F = function(x, y) {x - 2 * y}; #declare S = \"text\"; "
    "#macro M(X) X * 2 #end #declare R = seed(7);\n";

/// What the scene says, or the first line of its error.
std::string outcome(const std::string& scene) {
  try {
    return output(scene);
  } catch (const SceneError& error) {
    const std::string all = error.what();
    return all.substr(0, all.find('\n'));
  }
}

/// Statements as the file has them and as a loop repeats them, in the same line.
std::string in_file(const std::string& statements) {
  return outcome(kDeclared + "\n" + statements + "\n");
}
std::string in_loop(const std::string& statements) {
  return outcome(kDeclared + "#for (I, 1, 1)\n" + statements + "\n#end");
}
std::string in_macro(const std::string& statements) {
  return outcome(kDeclared + "#macro Repeated()\n" + statements + "\n#end Repeated()");
}

/// Declares a value and says what it is, and what rand() gives afterwards.
std::string shown(const std::string& expression) {
  return "#declare V = " + expression + "; #debug concat(vstr(5, V, \" \", 0, 9), \" \", str(rand(R), 0, 9))";
}

void check(const std::string& statements) {
  INFO(statements);
  const std::string expected = in_file(statements);
  CHECK(in_loop(statements) == expected);
  CHECK(in_macro(statements) == expected);
}

class Expressions {
public:
  explicit Expressions(std::uint32_t seed) : random_(seed) {}

  std::string operator()(int depth) {
    if (depth == 0)
      return one_of({"1", "0", ".5", "2e1", "A", "B", "C", "B", "x", "pi", "S", "D", "U", "true"});
    const std::string a = (*this)(depth - 1 - below(depth)), b = (*this)(depth - 1 - below(depth));
    switch (below(20)) {
    case 0:
    case 1:
    case 2:
      return a + one_of({" + ", " - ", "+", " -"}) + b;
    case 3:
    case 4:
      return a + one_of({" * ", "/"}) + b;
    case 5:
      return one_of({"-", "+", "!", "- -", "-!"}) + a;
    case 6:
      return "(" + a + ")";
    case 7:
      return "(" + a + one_of({"<", "<=", "=", "!=", ">=", ">"}) + b + ")";
    case 8:
      return "(" + a + one_of({" & ", " | "}) + b + ")";
    case 9:
      return "(" + a + " ? " + b + " : " + a + ")";
    case 10:
    case 11:
      return "<" + a + one_of({", ", " "}) + b +
             one_of({"", ", 3", ", 3, 4", ", 3, 4, 5", ", 3, 4, 5, 6", ","}) + ">";
    case 12:
      return "(" + a + ")" + one_of({".x", ".z", ".t", ".red", ".grey", ".transmit", ".odd"});
    case 13:
      return one_of({"sin", "sqrt", "vlength", "vnormalize", "rand", "seed", "strlen", "abs"}) + "(" + a +
             ")";
    case 14:
      return one_of({"max", "vdot", "vcross", "pow", "mod", "F", "vrotate"}) + "(" + a + ", " + b + ")";
    case 15:
      return "rand(R)";
    case 16:
      return "D[" + a + "]" + one_of({"", "[1]", ".y"});
    case 17:
      return one_of({"E[0]", "D[2][A - 1.5]", "M(3)", "dimension_size(D, 1)", "F(1)", "D[0]"});
    case 18:
      return a + one_of({" red 0.5", " A", "", " ?"});
    default:
      return one_of({"rgb ", "color ", "srgb ", ""}) + a;
    }
  }

private:
  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  std::string one_of(const std::vector<const char*>& these) {
    return these[static_cast<std::size_t>(below(static_cast<int>(these.size())))];
  }

  std::mt19937 random_;
};

} // namespace

TEST_CASE("what is repeated has the values that it has once") {
  for (const char* expression : {"1 + 2 * 3 - -4 / 8",
                                 "-A * -B + !0",
                                 "<A, B.y, C.t>",
                                 "(A > 2 & B.x < 1 | C.red = 0.2)",
                                 "D[1] + D[2][0] * x",
                                 "D[D[0] - 4 + 0.9]",
                                 "F(A, D[0]) + F(1, 2)",
                                 "max(1, A, B.z) + vlength(B) + strlen(S)",
                                 "C * 2",
                                 "C + B",
                                 "<1, 2> * <3, 4, 5>",
                                 "(A ? B : C)",
                                 "(1 ? 2 : 1 ? rand(R) : 4)",
                                 "M(A) + 1",
                                 "rand(R) + M(rand(R))",
                                 "B/0",
                                 "seed(3)",
                                 "rand(seed(3)) + foo",
                                 "<1, 2, 3, 4, 5>",
                                 "<rand(R), 2, 3, 4, 5>",
                                 "<1, 2, 3,>",
                                 "<1 -2, 3>",
                                 "5 -2",
                                 "image_width * clock + version",
                                 "D",
                                 "S",
                                 "A.x",
                                 "B.filter",
                                 "C.grey + B.grey",
                                 "A.grey",
                                 "D[3]",
                                 "D[-1]",
                                 "E[1]",
                                 "D[2]",
                                 "A[0]",
                                 "F",
                                 "F(B, 1)",
                                 "sqrt(-1)",
                                 "1e400",
                                 "-1e400 < 3",
                                 "(1e400 < 3)",
                                 "(B < 2 & 1)",
                                 "foo",
                                 "",
                                 "A B",
                                 "rgb A",
                                 "A red 0.5"})
    check(shown(expression));
}

TEST_CASE("what is repeated has the values that it has once: at random") {
  Expressions expressions(11);
  for (int i = 0; i < 2000; ++i)
    check(shown(expressions(1 + i % 5)));
}

TEST_CASE("conditions that are repeated hold as they do once") {
  for (const char* condition :
       {"(1)", "(A > 2)", "(A = 2.5 & B.x)", "(B)", "(S = \"text\")", "(rand(R) < 0.5)", "((A) < (3))", "A",
        "(A", "()", "(1 ? 0 : 1)", "(!defined(A) | 1)", "(1/0)", "(C.red > 0.1)"})
    check("#if " + std::string(condition) +
          " #debug \"yes\" #else #debug \"no\" #end #debug str(rand(R), 0, 9)");
}

TEST_CASE("shapes that are repeated have the arguments that they have once") {
  for (const char* arguments :
       {"B, A", "<A, B.y, 0>, D[0]", "B A", "B, A,", "<1, 2, 3> A", "B * 2, 1 - A", "x*A, vlength(B) scale 2",
        "x*A, vlength(B) M(3)", "B, rand(R) translate <rand(R), A, 1>", "B, S", "<B, 1, 2>, 1", "B, 1 }", "",
        "B, 1 matrix <1, A - 1.5, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0>", "rgb A, 1"}) {
    const std::string sphere = "sphere { " + std::string(arguments) + " }";
    check("#declare O = " + sphere +
          " #debug concat(vstr(3, min_extent(O), \" \", 0, 6), vstr(3, max_extent(O), \" \", 0, 6), "
          "str(rand(R), 0, 9))");
  }
}

TEST_CASE("deep expressions that are repeated are left to the grammar") {
  const auto nested = [](int depth, const char* open, const char* close) {
    std::string text;
    for (int i = 0; i < depth; ++i)
      text += open;
    text += "1";
    for (int i = 0; i < depth; ++i)
      text += close;
    return text;
  };
  check(shown(nested(50, "(", ")")));
  check(shown(nested(200, "(", ")")));
  check(shown(nested(300, "(", ")")));
  check(shown(nested(200, "abs(", ")")));
  check(shown("(" + nested(200, "0 ? 1 : ", "") + ")"));
}
