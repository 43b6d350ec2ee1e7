// Tells whether objects keep within what bounds them. POV-Ray does not look for an object if a ray misses its
// bounds; this program ignores bounds.
#pragma once

#include "pov/object.hpp"

namespace celltrace::pov {

struct Session;

/// Returns whether an object reaches out of its `bounded_by`, as far as rays from all sides show it; false if
/// many objects of the scene have been tested before.
bool reaches_out_of_bounds(Session& session, const ObjectDefinition& object, const Location& where);

} // namespace celltrace::pov
