// Pictures in files, and compared.
#include "python/arrays.hpp"
#include "python/bindings.hpp"

#include "celltrace/image.hpp"

#include <pybind11/stl/filesystem.h>

#include <limits>

namespace celltrace {

namespace py = pybind11;

namespace {

/// A picture of an array of (height, width, 3 or 4) channels; without the fourth it is opaque.
template <class Channel> BasicImage<Channel> image_of(const py::array& given) {
  const bool has_alpha = given.ndim() == 3 && given.shape(2) == 4;
  const int channels = has_alpha ? 4 : 3;
  check_shape(given, {-1, -1, channels}, "picture");
  const auto array = py::array_t<Channel, py::array::c_style>::ensure(given);
  BasicImage<Channel> image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  const Channel* from = array.data();
  for (auto to = image.rgba.begin(); to != image.rgba.end();) {
    for (int i = 0; i < channels; ++i)
      *to++ = *from++;
    if (!has_alpha) *to++ = std::numeric_limits<Channel>::max();
  }
  return image;
}

template <class Channel> bool holds(const py::array& array) {
  return array.dtype().is(py::dtype::of<Channel>());
}

void save(const std::filesystem::path& path, const py::array& picture) {
  if (holds<std::uint8_t>(picture)) {
    const Image image = image_of<std::uint8_t>(picture);
    const py::gil_scoped_release release;
    save_image(path, image);
  } else if (holds<std::uint16_t>(picture)) {
    const DeepImage image = image_of<std::uint16_t>(picture);
    const py::gil_scoped_release release;
    save_image(path, image);
  } else {
    throw py::type_error("picture: has to be of uint8 or uint16");
  }
}

py::array load(const std::filesystem::path& path) {
  Image image;
  {
    const py::gil_scoped_release release;
    image = load_image(path);
  }
  return picture_array(std::move(image.rgba), image.width, image.height);
}

py::object compare(const py::array& a, const py::array& b) {
  if (!holds<std::uint8_t>(a) || !holds<std::uint8_t>(b))
    throw py::type_error("pictures to compare have to be of uint8");
  const std::string json = to_json(compare_images(image_of<std::uint8_t>(a), image_of<std::uint8_t>(b)));
  return py::module_::import("json").attr("loads")(json);
}

} // namespace

void bind_pictures(py::module_& module) {
  module.def(
      "save", &save, py::arg("path"), py::arg("picture"),
      "Writes an array of (height, width, 3 or 4), uint8 or uint16, as PNG or PPM, by the path's extension.");
  module.def("load", &load, py::arg("path"), "Reads a PNG or PPM: uint8, (height, width, 4).");
  module.def("compare", &compare, py::arg("a"), py::arg("b"),
             "How far two pictures are apart: a dict with psnr (dB, None if they are equal), worst_ssim,\n"
             "differing_pixels, max_difference and identical.");
}

} // namespace celltrace
