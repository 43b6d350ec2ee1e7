#include "geometry/function_operations.hpp"

namespace celltrace {

double result_of(FunctionOp op, double a, double b, double c) {
  switch (op) {
#define CELLTRACE_UNARY(name)                                                                                \
  case FunctionOp::name:                                                                                     \
    return operations::name(a);
#define CELLTRACE_BINARY(name)                                                                               \
  case FunctionOp::name:                                                                                     \
    return operations::name(a, b);
#define CELLTRACE_TERNARY(name)                                                                              \
  case FunctionOp::name:                                                                                     \
    return operations::name(a, b, c);
    CELLTRACE_UNARY_OPERATIONS(CELLTRACE_UNARY)
    CELLTRACE_BINARY_OPERATIONS(CELLTRACE_BINARY)
    CELLTRACE_TERNARY_OPERATIONS(CELLTRACE_TERNARY)
#undef CELLTRACE_UNARY
#undef CELLTRACE_BINARY
#undef CELLTRACE_TERNARY
  default:
    return 0;
  }
}

} // namespace celltrace
