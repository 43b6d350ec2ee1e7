// Converts pictures and lists of vectors to NumPy's arrays.
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace celltrace {

/// Returns an array of that shape, which takes over the values without copying.
template <class Value>
pybind11::array_t<Value> array_of_shape(std::vector<Value>&& values, std::vector<pybind11::ssize_t> shape) {
  auto owned = std::make_unique<std::vector<Value>>(std::move(values));
  Value* first = owned->data();
  const pybind11::capsule owner(owned.get(),
                                [](void* memory) { delete static_cast<std::vector<Value>*>(memory); });
  owned.release();
  return pybind11::array_t<Value>(std::move(shape), first, owner);
}
template <class Channel>
pybind11::array_t<Channel> picture_array(std::vector<Channel>&& channels, int width, int height) {
  return array_of_shape(std::move(channels), {height, width, 4});
}

/// Throws ValueError unless the array has as many dimensions as `shape`, and their sizes; -1: any size.
inline void check_shape(const pybind11::array& array, const std::vector<int>& shape,
                        const std::string& name) {
  bool fits = array.ndim() == static_cast<pybind11::ssize_t>(shape.size());
  std::string wanted;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    fits = fits && (shape[i] < 0 || array.shape(static_cast<pybind11::ssize_t>(i)) == shape[i]);
    wanted += (i ? ", " : "") + (shape[i] < 0 ? std::string("n") : std::to_string(shape[i]));
  }
  if (!fits)
    throw pybind11::value_error(name + ": the shape has to be (" + wanted + "), and is " +
                                pybind11::str(array.attr("shape")).cast<std::string>());
}

} // namespace celltrace
