// Words that stand for a value of the language itself.
#pragma once

#include "pov/session.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

enum class Constant { x, y, z, u, v, t, pi, on, off, clock, clock_delta, now, version };

Value value_of(Constant constant, const Session& session);

/// Declares the names that a scene may declare anew: image_width and the like, and ParseOptions::declares.
/// Throws InputError for a name that cannot be declared.
void declare_predefined(Session& session);

} // namespace celltrace::pov
