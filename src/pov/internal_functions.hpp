// POV-Ray's internal functions by number.
#pragma once

#include <cstddef>
#include <optional>

#include "pov/user_function.hpp"

namespace celltrace::pov {

struct InternalFunction {
  FunctionBody body;
  std::size_t parameters = 3;
};

/// Returns the internal function of this number; nothing if there is none.
std::optional<InternalFunction> internal_function(int number);

} // namespace celltrace::pov
