// Finds loops that cannot end from their contents, long before they reach the limit on iterations.
#pragma once

#include "pov/input.hpp"

namespace celltrace::pov {

struct Session;

/// Returns how many more iterations a running loop does at least: infinity if it cannot end, 0 if that is
/// unknown, as for a loop that includes files or reads data. Cheap enough to call every thousand iterations.
double least_iterations(const Session& session, const Frame& loop);

} // namespace celltrace::pov
