// Converts arrays to celltrace.Picture, which notebooks show.
#pragma once

#include <pybind11/numpy.h>

#include <optional>

namespace celltrace {

/// Returns the pixels as a picture. `gamma` is for colours as floats, as in ColourImage.
pybind11::object as_picture(const pybind11::array& pixels, std::optional<double> gamma);

} // namespace celltrace
