// The code of functions for the kernel, from their graphs.
#pragma once

#include "geometry/function_machine.hpp"
#include "records/function.hpp"

#include <vector>

namespace celltrace {

/// Returns the steps that compute a function of x, y and z. Throws InputError if the function has another
/// number of parameters, calls functions that have no graph, has loops whose bounds depend on the point, or
/// needs too many steps or registers.
std::vector<kernel::FunctionStepRecord> function_code(const FunctionCode& function);

} // namespace celltrace
