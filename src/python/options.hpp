// Options of reading and rendering as keyword arguments.
#pragma once

#include "python/fields.hpp"

#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"

#include <string>

namespace celltrace {

/// Takes the options of reading out of `kwargs`. Functions among them may be called without the interpreter's
/// lock.
ParseOptions take_parse_options(py::kwargs& kwargs);
/// Throws TypeError if there are any, for what has a Scene already.
void refuse_parse_options(const py::kwargs& kwargs);
/// Sets those of rendering; TypeError for others.
void set_render_options(RenderOptions& options, const py::kwargs& kwargs);
/// Sets those that a machine may change between frames; TypeError for others.
void set_picture_options(RenderOptions& options, const py::kwargs& kwargs);

// For docstrings: "name=default, ...", and a line on each.
std::string parse_signature();
std::string parse_listing();
std::string render_signature();
std::string render_listing();
std::string picture_signature();
std::string picture_listing();

} // namespace celltrace
