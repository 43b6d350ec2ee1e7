// Functions that a scene declares: function (a, b) { sin(a) * b }, compiled to a program for a stack of
// numbers; and those of splines, transformations and POV-Ray's own, by number.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "pov/location.hpp"
#include "pov/quantity.hpp"
#include "pov/spline.hpp"
#include "pov/unsupported.hpp"

namespace celltrace::pov {

struct Session;
struct UserFunction;
using FunctionPtr = std::shared_ptr<const UserFunction>;

/// One step of a function: it takes its operands from the stack and leaves its result there.
struct FunctionStep {
  enum class Kind : std::uint8_t {
    constant, ///< value
    load,     ///< of variable `a`
    store,    ///< to variable `a`
    negate,
    invert, ///< 1 for 0, else 0
    add,
    subtract,
    multiply,
    divide,
    compare, ///< Relation(a)
    both,    ///< 1 if neither is 0
    either,
    builtin,  ///< the language's function `a` of `b` arguments
    call,     ///< function `a` of UserFunction::callees, component `b` of its result, with `c` arguments
    choose,   ///< goes on at `a` if below 0, at `b` if 0, at `c` if above
    jump,     ///< goes on at `a`
    jump_past ///< goes on at `a` if the first operand is greater than the second
  };
  Kind kind = Kind::constant;
  std::uint32_t a = 0, b = 0, c = 0;
  double value = 0;
  Location where = {};
};

struct FunctionProgram {
  std::vector<FunctionStep> steps;
  std::uint32_t variables = 0; ///< the parameters first
  std::vector<FunctionPtr> callees;
};

/// One of POV-Ray's own, of three coordinates and parameters.
struct InternalFunction {
  int number = 0;
};

struct UserFunction {
  std::size_t parameters = 3;
  std::variant<FunctionProgram, InternalFunction, SplinePtr, Transform, UnsupportedPtr> body;
  bool gives_vector = false; ///< or a colour
  int depth = 1;             ///< of calls
  Location where = {};
};

/// Reads what stands behind `function`, from the token stream. What it may be called with is settled by then,
/// so that no function calls itself.
FunctionPtr read_function(Session& session, const Location& where);

/// Its value. Fails if the arguments are not as many as it takes, or if it takes too long.
Quantity call_function(Session& session, const UserFunction& function, const std::vector<double>& arguments,
                       const Location& where);

/// How many parameters internal function `number` takes after its three coordinates; -1 if there is none.
int internal_parameters(int number);
/// Its value, at arguments[0..2] with the parameters behind.
double internal_value(Session& session, int number, const double* arguments, const Location& where);

} // namespace celltrace::pov
