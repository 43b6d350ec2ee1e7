// The parts of the module; each function adds its names.
#pragma once

#include <pybind11/pybind11.h>

namespace celltrace {

void bind_errors(pybind11::module_& module);
void bind_geometry(pybind11::module_& module);
void bind_mesh(pybind11::module_& module);
void bind_surfaces(pybind11::module_& module);
void bind_scene(pybind11::module_& module);
void bind_rendering(pybind11::module_& module);
void bind_pictures(pybind11::module_& module);

} // namespace celltrace
