// Functions that a scene declares: expressions such as function (a, b) { sin(a) * b }, splines,
// transformations and POV-Ray's own, by number.
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "geometry/function_machine.hpp"
#include "pov/location.hpp"
#include "pov/memory.hpp"
#include "pov/quantity.hpp"
#include "pov/spline.hpp"

namespace celltrace::pov {

struct PigmentDefinition;
struct Session;
struct UserFunction;
using FunctionPtr = std::shared_ptr<const UserFunction>;

/// The body of a function: an expression, a transformation of points, or another source of numbers.
using FunctionBody =
    std::variant<std::shared_ptr<const FunctionCode>, Transform, std::shared_ptr<const NativeFunction>>;

struct UserFunction {
  std::size_t parameters = 3;
  FunctionBody body;
  bool returns_vector = false; ///< true: the function returns a vector or a colour
  bool returns_colour = false;
  int depth = 1; ///< levels of nested calls
  Location where = {};
  MemoryShare memory = {}; ///< memory of an expression
};

/// Reads the function that follows the word `function` from the token stream. The functions it may call are
/// known before its own name is, so that no function calls itself.
FunctionPtr read_function(Session& session, const Location& where);
/// Reads the rest of a function of x, y and z, of which the opening brace has been read, up to its last brace.
FunctionPtr read_function_body(Session& session, const Location& where);

/// Returns the function's value for `count` arguments. Fails if it takes another number of arguments, takes
/// too long, or is not supported.
Quantity call_function(Session& session, const UserFunction& function, const double* arguments,
                       std::size_t count, const Location& where);

/// Fails unless a function takes this many arguments.
void check_argument_count(Session& session, const UserFunction& function, std::size_t count,
                          const Location& where);

/// Returns a spline as a function of its number.
std::shared_ptr<const NativeFunction> spline_function(SplinePtr spline);
/// Returns a pigment as a function of points that gives its colour.
std::shared_ptr<const NativeFunction> pigment_function(const PigmentDefinition& pigment);
/// Returns a pigment's pattern, which must exist, as a function of points.
std::shared_ptr<const NativeFunction> pattern_function(const PigmentDefinition& pigment);
/// Returns a function that fails wherever it is called: "`what` is not supported yet".
std::shared_ptr<const NativeFunction> unsupported_function(const std::string& what, std::size_t parameters,
                                                           std::size_t results);
} // namespace celltrace::pov
