// Functions of numbers as straight code for a machine with registers. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// Operations of functions. Comparisons and logic give 1 or 0.
enum class FunctionOperation : uint32_t {
  constant, ///< the step's number
  negate,
  invert,
  absolute,
  square_root,
  floor,
  ceil,
  whole,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  sinh,
  cosh,
  tanh,
  asinh,
  acosh,
  atanh,
  exp,
  ln,
  log,
  add,
  subtract,
  multiply,
  divide,
  less,
  less_equal,
  equal,
  not_equal,
  greater_equal,
  greater,
  both,
  either,
  maximum,
  minimum,
  modulo,
  quotient,
  power,
  atan2,
  pick_negative, ///< b where a is below 0, else c
  pick_zero      ///< b where a is 0, else c
};
constexpr uint32_t kFunctionOperations = static_cast<uint32_t>(FunctionOperation::pick_zero) + 1;
/// Number of registers; the first three are the point.
constexpr uint32_t kFunctionRegisters = 64;

/// A step: an operation on registers, whose result goes to a register. The last step's result is the value.
struct alignas(16) FunctionStepRecord {
  uint32_t operation_and_result; ///< FunctionOperation, and the register in the upper half
  uint32_t a_and_b;              ///< registers, b in the upper half
  uint32_t c;
  float constant;
};
static_assert(sizeof(FunctionStepRecord) == 16, "eight a line");

} // namespace celltrace::kernel
