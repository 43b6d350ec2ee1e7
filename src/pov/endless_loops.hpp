// Loops that cannot end: found by what they consist of, long before they have run as often as they may.
#pragma once

#include "pov/input.hpp"

namespace celltrace::pov {

struct Session;

/// How often a loop that is running will go on at least: infinity if it cannot end, 0 if that cannot be told,
/// as where it includes files or reads data. Cheap enough for once in a thousand iterations.
double least_iterations(const Session& session, const Frame& loop);

} // namespace celltrace::pov
