// Whether objects keep within what bounds them: POV-Ray does not look for them where rays miss that, and this
// program ignores it.
#pragma once

#include "pov/object.hpp"

namespace celltrace::pov {

struct Session;

/// Whether an object reaches out of its `bounded_by`, as far as rays from all sides show it and few objects of
/// the scene have been tried before.
bool reaches_out_of_bounds(Session& session, const ObjectDefinition& object, const Location& where);

} // namespace celltrace::pov
