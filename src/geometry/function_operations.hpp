// The operations of functions. Results are POV-Ray's even if an operand is NaN, infinite, or outside of an
// operation's domain.
#pragma once

#include <cmath>

#include "geometry/function_program.hpp"

namespace celltrace {

inline constexpr double kDegreesPerRadian = 180 / 3.14159265358979323846;

/// Converts a number to an int, as POV-Ray's int() and div() do on a PC: numbers out of range, infinity and
/// NaN become the least int.
inline double to_int(double number) {
  constexpr double kBound = 2147483648.0;
  const double result = std::trunc(number);
  return result >= -kBound && result < kBound ? result : -kBound;
}

namespace operations {

inline double negate(double a) {
  return -a;
}
inline double invert(double a) {
  return a == 0 ? 1 : 0;
}
inline double absolute(double a) {
  return std::fabs(a);
}
inline double square_root(double a) {
  return std::sqrt(a);
}
inline double floor(double a) {
  return std::floor(a);
}
inline double ceil(double a) {
  return std::ceil(a);
}
inline double whole(double a) {
  return to_int(a);
}
inline double sin(double a) {
  return std::sin(a);
}
inline double cos(double a) {
  return std::cos(a);
}
inline double tan(double a) {
  return std::tan(a);
}
inline double asin(double a) {
  return std::asin(a);
}
inline double acos(double a) {
  return std::acos(a);
}
inline double atan(double a) {
  return std::atan(a);
}
inline double sinh(double a) {
  return std::sinh(a);
}
inline double cosh(double a) {
  return std::cosh(a);
}
inline double tanh(double a) {
  return std::tanh(a);
}
inline double asinh(double a) {
  return std::asinh(a);
}
inline double acosh(double a) {
  return std::acosh(a);
}
inline double atanh(double a) {
  return std::atanh(a);
}
inline double exp(double a) {
  return std::exp(a);
}
inline double ln(double a) {
  return std::log(a);
}
inline double log(double a) {
  return std::log10(a);
}

inline double add(double a, double b) {
  return a + b;
}
inline double subtract(double a, double b) {
  return a - b;
}
inline double subtract_from(double a, double b) {
  return b - a;
}
inline double multiply(double a, double b) {
  return a * b;
}
inline double divide(double a, double b) {
  return a / b;
}
// Comparisons in functions are exact. As in POV-Ray, "greater" means "not less or equal", so that "greater"
// is true if an operand is NaN.
inline double less(double a, double b) {
  return a < b ? 1 : 0;
}
inline double less_equal(double a, double b) {
  return a <= b ? 1 : 0;
}
inline double equal(double a, double b) {
  return a == b ? 1 : 0;
}
inline double not_equal(double a, double b) {
  return a != b ? 1 : 0;
}
inline double greater_equal(double a, double b) {
  return !(a < b) ? 1 : 0;
}
inline double greater(double a, double b) {
  return !(a <= b) ? 1 : 0;
}
inline double both(double a, double b) {
  return a != 0 && b != 0 ? 1 : 0;
}
inline double either(double a, double b) {
  return a != 0 || b != 0 ? 1 : 0;
}
// If an operand is NaN, maximum() returns the first operand and minimum() the second.
inline double maximum(double a, double b) {
  return b > a ? b : a;
}
inline double minimum(double a, double b) {
  return a <= b ? a : b;
}
inline double modulo(double a, double b) {
  return std::fmod(a, b);
}
inline double quotient(double a, double b) {
  return to_int(a / b);
}
inline double power(double a, double b) {
  return std::pow(a, b);
}
inline double atan2(double a, double b) {
  return std::atan2(a, b);
}

inline double pick_negative(double a, double b, double c) {
  return a < 0 ? b : c;
}
inline double pick_zero(double a, double b, double c) {
  return a == 0 ? b : c;
}

} // namespace operations

/// Returns the number of operands of an operation; not for fused operations and control steps.
inline unsigned operand_count(FunctionOp op) {
  if (op < FunctionOp::add) return 1;
  return op < FunctionOp::pick_negative ? 2 : 3;
}

/// Returns the result of an operation; not for fused operations and control steps.
double result_of(FunctionOp op, double a, double b, double c);

} // namespace celltrace
