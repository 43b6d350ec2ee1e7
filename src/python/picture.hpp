// Arrays as celltrace.Picture, which notebooks show.
#pragma once

#include <pybind11/numpy.h>

#include <optional>

namespace celltrace {

/// `gamma`: of colours as numbers, as ColourImage has it.
pybind11::object as_picture(const pybind11::array& pixels, std::optional<double> gamma);

} // namespace celltrace
