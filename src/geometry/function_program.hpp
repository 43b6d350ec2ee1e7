// A function of numbers as a flat program for a machine with registers. A program is plain data: it contains
// nothing of the parser or of the place where it was written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace celltrace {

class FunctionCode;

/// Limit on parameters of a function, as in POV-Ray.
inline constexpr std::size_t kMostParameters = 56;

/// Operations on numbers, as lists for the compiler, the machine and the folding of constants. Each operation
/// gives the same bits wherever function_operations.hpp is compiled.
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
/// Two operations in one step: X(first, second) computes `first` of a and b, and `second` of this result and
/// c. `subtract_from` subtracts this result from c.
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
  // Operations of function_operations.hpp, on the registers a, b and c; they write the register `result`.
  CELLTRACE_UNARY_OPERATIONS(CELLTRACE_NAME) CELLTRACE_BINARY_OPERATIONS(CELLTRACE_NAME)
      CELLTRACE_TERNARY_OPERATIONS(CELLTRACE_NAME) CELLTRACE_FUSED_OPERATIONS(CELLTRACE_FUSED_NAME)
#undef CELLTRACE_NAME
#undef CELLTRACE_FUSED_NAME
  // Sum and difference of the products of a and b, and of c and d.
  sum_of_products,
  difference_of_products,
  // Control steps; `target` is the index of a step.
  copy,                 ///< a -> result
  jump,                 ///< continues at the target
  jump_unless_negative, ///< continues at the target unless a < 0
  jump_unless_zero,     ///< continues at the target unless a = 0
  enter_loop,           ///< continues at the target unless a <= b
  repeat,               ///< adds 1 to a, then continues at the target if a <= b
  call_code,   ///< calls callees[a] with the registers in `operands` from index target on as arguments
  call_native, ///< calls a native function in this way; its results go to `result` and the following
               ///< registers
  finish,      ///< returns a
};

/// A step of a program. Registers are numbered from 0; `target` consists of c and d.
struct FunctionStep {
  FunctionOp op;
  std::uint16_t result = 0, a = 0, b = 0, c = 0, d = 0;

  std::uint32_t target() const { return c | std::uint32_t{d} << 16; }
  void set_target(std::uint32_t target) {
    c = static_cast<std::uint16_t>(target);
    d = static_cast<std::uint16_t>(target >> 16);
  }
};

/// The state that functions depend on besides their arguments.
struct FunctionContext {
  int noise_generator = 2;

  bool operator==(const FunctionContext&) const = default;
};

/// Thrown if a function cannot be evaluated or takes too long.
struct FunctionFault {
  std::string what;
};

/// A function that has no program: a spline, a pigment, or an internal function of POV-Ray.
class NativeFunction {
public:
  static constexpr std::size_t kMostResults = 5;

  virtual ~NativeFunction() = default;

  /// Evaluates the function: reads as many arguments as the function has parameters, and writes its results.
  /// If there are several results, `results` has kMostResults places, and the remaining places become 0.
  /// Equal arguments and context give equal results. Throws FunctionFault.
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
  std::uint32_t parameters =
      0; ///< number of parameters, which are in the first registers; no step writes to them
  std::vector<double> constants; ///< constants, in the registers after the parameters; no step writes to them
  std::uint32_t registers = 0;   ///< number of all registers
  std::vector<std::uint16_t> operands;
  std::vector<FunctionCallee> callees;
};

} // namespace celltrace
