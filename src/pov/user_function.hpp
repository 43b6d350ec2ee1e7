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

/// An expression, a transformation of points, or something else that gives numbers.
using FunctionBody =
    std::variant<std::shared_ptr<const FunctionCode>, Transform, std::shared_ptr<const NativeFunction>>;

struct UserFunction {
  std::size_t parameters = 3;
  FunctionBody body;
  bool gives_vector = false; ///< or a colour
  bool gives_colour = false;
  int depth = 1; ///< of calls
  Location where = {};
  MemoryShare memory = {}; ///< of what an expression needs
};

/// Reads what stands behind `function`, from the token stream. What it may be called with is settled by then,
/// so that no function calls itself.
FunctionPtr read_function(Session& session, const Location& where);

/// The function's value for `count` arguments. Fails if these are not as many as it takes, if it takes too
/// long, or if it is not supported.
Quantity call_function(Session& session, const UserFunction& function, const double* arguments,
                       std::size_t count, const Location& where);

/// Fails unless a function takes so many arguments.
void check_argument_count(Session& session, const UserFunction& function, std::size_t count,
                          const Location& where);

/// A spline as a function of its number.
std::shared_ptr<const NativeFunction> spline_function(SplinePtr spline);
/// A pigment as a function of points that gives its colour.
std::shared_ptr<const NativeFunction> pigment_function(const PigmentDefinition& pigment);
/// A pigment's pattern, of which there must be one, as a function of points.
std::shared_ptr<const NativeFunction> pattern_function(const PigmentDefinition& pigment);
/// A function that fails wherever it is called: "`what` is not supported yet".
std::shared_ptr<const NativeFunction> unsupported_function(const std::string& what, std::size_t parameters,
                                                           std::size_t results);
/// POV-Ray's own function of this number, of three coordinates and parameters; null: there is none.
std::shared_ptr<const NativeFunction> internal_function(int number);

} // namespace celltrace::pov
