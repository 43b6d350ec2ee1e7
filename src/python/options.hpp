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
/// Throws TypeError if there are options of reading, for calls that have a Scene already.
void refuse_parse_options(const py::kwargs& kwargs);
/// Sets options of rendering. Throws TypeError for others.
void set_render_options(RenderOptions& options, const py::kwargs& kwargs);
/// Sets options that a machine may change between frames. Throws TypeError for others.
void set_picture_options(RenderOptions& options, const py::kwargs& kwargs);

// For docstrings: "name=default, ...", and a line for each option.
std::string parse_signature();
std::string parse_listing();
std::string render_signature();
std::string render_listing();
std::string picture_signature();
std::string picture_listing();

} // namespace celltrace
