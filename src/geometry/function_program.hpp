// A function of numbers as a flat program for a machine with registers. Data alone: a program knows neither
// the parser nor the place in a scene where it was written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace celltrace {

class FunctionCode;

/// As many parameters as a function has at the most, which is POV-Ray's number.
inline constexpr std::size_t kMostParameters = 56;

/// Operations of numbers, as lists for the compiler, the machine and whoever folds constants. Each gives the
/// same bits everywhere that function_operations.hpp is compiled.
#define CELLTRACE_UNARY_OPERATIONS(X)                                                                        \
  X(negate)                                                                                                  \
  X(invert)                                                                                                  \
  X(absolute)                                                                                                \
  X(square_root)                                                                                             \
  X(floor)                                                                                                   \
  X(ceil)                                                                                                    \
  X(whole)                                                                                                   \
  X(sin)                                                                                                     \
  X(cos)                                                                                                     \
  X(tan)                                                                                                     \
  X(asin)                                                                                                    \
  X(acos)                                                                                                    \
  X(atan)                                                                                                    \
  X(sinh)                                                                                                    \
  X(cosh)                                                                                                    \
  X(tanh)                                                                                                    \
  X(asinh)                                                                                                   \
  X(acosh)                                                                                                   \
  X(atanh)                                                                                                   \
  X(exp)                                                                                                     \
  X(ln)                                                                                                      \
  X(log)
#define CELLTRACE_BINARY_OPERATIONS(X)                                                                       \
  X(add)                                                                                                     \
  X(subtract)                                                                                                \
  X(multiply)                                                                                                \
  X(divide)                                                                                                  \
  X(less)                                                                                                    \
  X(less_equal)                                                                                              \
  X(equal)                                                                                                   \
  X(not_equal)                                                                                               \
  X(greater_equal)                                                                                           \
  X(greater)                                                                                                 \
  X(both)                                                                                                    \
  X(either)                                                                                                  \
  X(maximum)                                                                                                 \
  X(minimum)                                                                                                 \
  X(modulo)                                                                                                  \
  X(quotient)                                                                                                \
  X(power)                                                                                                   \
  X(atan2)
#define CELLTRACE_TERNARY_OPERATIONS(X)                                                                      \
  X(pick_negative)                                                                                           \
  X(pick_zero)
/// Two operations in one step: X(first, second) is `second` of `first` of a and b, and of c. `subtract_from`
/// takes the result of the first one away from c.
#define CELLTRACE_FUSED_OPERATIONS(X)                                                                        \
  X(add, add)                                                                                                \
  X(add, subtract)                                                                                           \
  X(add, subtract_from)                                                                                      \
  X(add, multiply)                                                                                           \
  X(subtract, add)                                                                                           \
  X(subtract, subtract)                                                                                      \
  X(subtract, subtract_from)                                                                                 \
  X(subtract, multiply)                                                                                      \
  X(multiply, add)                                                                                           \
  X(multiply, subtract)                                                                                      \
  X(multiply, subtract_from)                                                                                 \
  X(multiply, multiply)

enum class FunctionOp : std::uint16_t {
#define CELLTRACE_NAME(name) name,
#define CELLTRACE_FUSED_NAME(first, second) first##_##second,
  // Those of function_operations.hpp; registers a, b, c -> result.
  CELLTRACE_UNARY_OPERATIONS(CELLTRACE_NAME) CELLTRACE_BINARY_OPERATIONS(CELLTRACE_NAME)
      CELLTRACE_TERNARY_OPERATIONS(CELLTRACE_NAME) CELLTRACE_FUSED_OPERATIONS(CELLTRACE_FUSED_NAME)
#undef CELLTRACE_NAME
#undef CELLTRACE_FUSED_NAME
  // Products of a and b, and of c and d.
  sum_of_products,
  difference_of_products,
  // Control; `target` is the number of a step.
  copy,                 ///< a -> result
  jump,                 ///< goes on at the target
  jump_unless_negative, ///< goes on at the target unless a < 0
  jump_unless_zero,     ///< goes on at the target unless a = 0
  enter_loop,           ///< goes on at the target unless a <= b
  repeat,               ///< adds 1 to a; goes on at the target if a <= b then
  call_code,   ///< calls callees[a]; its arguments are in the registers of `operands` from the target on
  call_native, ///< the same; its results go to `result` and the registers behind
  finish,      ///< gives a
};

/// One step. Registers are numbered from 0; `target` is made of c and d.
struct FunctionStep {
  FunctionOp op;
  std::uint16_t result = 0, a = 0, b = 0, c = 0, d = 0;

  std::uint32_t target() const { return c | std::uint32_t{d} << 16; }
  void set_target(std::uint32_t target) {
    c = static_cast<std::uint16_t>(target);
    d = static_cast<std::uint16_t>(target >> 16);
  }
};

/// What functions depend on besides their arguments.
struct FunctionContext {
  int noise_generator = 2;

  bool operator==(const FunctionContext&) const = default;
};

/// Thrown where a function is evaluated that cannot be, or that takes too long.
struct FunctionFault {
  std::string what;
};

/// A function that is no program: a spline, a pigment, or one of POV-Ray's own.
class NativeFunction {
public:
  static constexpr std::size_t kMostResults = 5;

  virtual ~NativeFunction() = default;

  /// Of so many parameters, so many numbers; the rest of `results`, of which there are kMostResults where
  /// there is more than one, is 0. Gives the same for the same arguments and context. Throws FunctionFault.
  virtual void evaluate(const double* arguments, const FunctionContext& context, double* results) const = 0;

  std::size_t parameters() const { return parameters_; }
  std::size_t results() const { return results_; }

protected:
  NativeFunction(std::size_t parameters, std::size_t results) : parameters_(parameters), results_(results) {}

private:
  std::size_t parameters_, results_;
};

using FunctionCallee =
    std::variant<std::shared_ptr<const FunctionCode>, std::shared_ptr<const NativeFunction>>;

struct FunctionProgram {
  std::vector<FunctionStep> steps;
  std::uint32_t parameters = 0;  ///< in the first registers, which no step writes to
  std::vector<double> constants; ///< in the registers behind, likewise
  std::uint32_t registers = 0;   ///< in all
  std::vector<std::uint16_t> operands;
  std::vector<FunctionCallee> callees;
};

} // namespace celltrace
