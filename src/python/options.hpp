// Options of reading and rendering as keyword arguments.
#pragma once

#include "python/fields.hpp"

#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"

namespace celltrace {

/// Takes the options of reading out of `kwargs`. Functions among them may be called without the interpreter's
/// lock.
ParseOptions take_parse_options(py::kwargs& kwargs);
/// Sets those of rendering; TypeError for others.
void set_render_options(RenderOptions& options, const py::kwargs& kwargs);
/// Sets those that a machine may change between frames; TypeError for others.
void set_picture_options(RenderOptions& options, const py::kwargs& kwargs);

} // namespace celltrace
