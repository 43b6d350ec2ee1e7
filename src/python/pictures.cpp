// Binds pictures in files and in memory, and their comparison.
#include "python/arrays.hpp"
#include "python/bindings.hpp"
#include "python/misfit.hpp"
#include "python/picture.hpp"

#include "celltrace/image.hpp"

#include <limits>
#include <variant>

namespace celltrace {

namespace py = pybind11;

py::object as_picture(const py::array& pixels, std::optional<double> gamma) {
  py::object picture = pixels.attr("view")(py::module_::import("celltrace").attr("Picture"));
  picture.attr("gamma") = gamma;
  return picture;
}

namespace {

/// Returns a picture from an array of (height, width, 3 or 4) channels; opaque without the fourth.
template <class Picture, class Channel> Picture image_of(const py::array& given, Channel opaque) {
  const bool has_alpha = given.ndim() == 3 && given.shape(2) == 4;
  const int channels = has_alpha ? 4 : 3;
  if (given.ndim() != 3 || given.shape(2) != channels)
    throw py::value_error("picture: the shape has to be (height, width, 3 or 4), and is " +
                          py::str(given.attr("shape")).cast<std::string>());
  const auto array = py::array_t<Channel, py::array::c_style>::ensure(given);
  Picture image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  const Channel* from = array.data();
  for (auto to = image.rgba.begin(); to != image.rgba.end();) {
    for (int i = 0; i < channels; ++i)
      *to++ = *from++;
    if (!has_alpha) *to++ = opaque;
  }
  return image;
}

/// Returns the array that NumPy makes of a value.
py::array array_of(const py::object& given, const char* name) {
  if (py::isinstance<py::array>(given)) return given; // a Picture stays one
  if (!py::isinstance<py::str>(given))
    if (py::array array = py::array::ensure(given)) return array;
  throw py::type_error(std::string(name) + ": has to be an array, not a " +
                       py::type::of(given).attr("__name__").cast<std::string>());
}

template <class Channel> bool holds(const py::array& array) {
  return array.dtype().is(py::dtype::of<Channel>());
}

/// Returns colours with a Picture's own gamma; other arrays are linear.
ColourImage colours_of(const py::array& array) {
  auto colours = image_of<ColourImage>(array, 1.0f);
  colours.gamma = py::getattr(array, "gamma", py::float_(1.0)).cast<std::optional<double>>();
  return colours;
}

using AnyImage = std::variant<Image, DeepImage, ColourImage>;

AnyImage any_image_of(const py::object& given) {
  const py::array array = array_of(given, "picture");
  if (holds<std::uint8_t>(array)) return image_of<Image>(array, std::numeric_limits<std::uint8_t>::max());
  if (holds<std::uint16_t>(array))
    return image_of<DeepImage>(array, std::numeric_limits<std::uint16_t>::max());
  if (holds<float>(array)) return colours_of(array);
  throw py::type_error("picture: has to be of uint8 or uint16, or of float32 for linear colours, and is of " +
                       py::str(array.dtype()).cast<std::string>());
}

/// Returns colours as to_image() converts them, for formats that do not hold floats.
AnyImage fitting(AnyImage image, ImageFormat format) {
  const auto* colours = std::get_if<ColourImage>(&image);
  return colours && !holds_numbers(format) ? AnyImage(to_image(*colours)) : std::move(image);
}

ImageFormat format_of(const std::string& name) {
  return image_format_of("picture." + name);
}

/// The parts of an OpenEXR file that keywords select.
struct ExrChoice {
  std::optional<FirstHits> first_hits;
  ExrOptions options;

  ExrChoice(bool full_floats, const py::object& hits) {
    options.full_floats = full_floats;
    if (hits.is_none()) return;
    const auto depth = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(hits["depth"]);
    check_shape(depth, {-1, -1}, "depth");
    FirstHits& made = first_hits.emplace();
    made.height = static_cast<int>(depth.shape(0));
    made.width = static_cast<int>(depth.shape(1));
    made.depth.assign(depth.data(), depth.data() + depth.size());
    const auto normal = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(hits["normal"]);
    check_shape(normal, {made.height, made.width, 3}, "normal");
    made.normal.assign(normal.data(), normal.data() + normal.size());
    const auto object =
        py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>::ensure(hits["object"]);
    check_shape(object, {made.height, made.width}, "object");
    made.object.assign(object.data(), object.data() + object.size());
  }
  ExrChoice(const ExrChoice&) = delete;
  const ExrOptions& chosen() {
    options.first_hits = first_hits ? &*first_hits : nullptr;
    return options;
  }
};

py::bytes encode(const py::object& picture, const std::string& format, bool full_floats,
                 const py::object& first_hits) {
  const ImageFormat wanted = format_of(format);
  AnyImage image = any_image_of(picture);
  ExrChoice exr(full_floats, first_hits);
  std::vector<std::uint8_t> bytes;
  {
    const py::gil_scoped_release release;
    image = fitting(std::move(image), wanted);
    if (const auto* colours = std::get_if<ColourImage>(&image))
      bytes = encode_image(*colours, wanted, exr.chosen());
    else if (const auto* deep = std::get_if<DeepImage>(&image))
      bytes = encode_image(*deep, wanted);
    else
      bytes = encode_image(std::get<Image>(image), wanted);
  }
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::filesystem::path path_of(const py::object& given) {
  if (py::isinstance<py::array>(given))
    throw py::type_error("path: cannot be an array; it comes before the picture");
  return value_of<std::filesystem::path>(given, "path", "a path, or a file open for bytes");
}

void save(const py::object& to, const py::object& picture, const std::optional<std::string>& format,
          bool full_floats, const py::object& first_hits) {
  if (py::hasattr(to, "write")) {
    to.attr("write")(encode(picture, format.value_or("png"), full_floats, first_hits));
    return;
  }
  const std::filesystem::path path = path_of(to);
  FileOptions options;
  if (format) options.format = format_of(*format);
  AnyImage image = any_image_of(picture);
  ExrChoice exr(full_floats, first_hits);
  const py::gil_scoped_release release;
  image = fitting(std::move(image), options.format ? *options.format : image_format_of(path));
  if (const auto* colours = std::get_if<ColourImage>(&image))
    save_image(path, *colours, exr.chosen(), options);
  else if (const auto* deep = std::get_if<DeepImage>(&image))
    save_image(path, *deep, options);
  else
    save_image(path, std::get<Image>(image), options);
}

py::object load(const py::object& from) {
  Image image;
  if (py::hasattr(from, "read")) {
    const auto bytes = from.attr("read")().cast<std::string>();
    const py::gil_scoped_release release;
    image = decode_image(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  } else {
    const std::filesystem::path path = path_of(from);
    const py::gil_scoped_release release;
    image = load_image(path);
  }
  return as_picture(picture_array(std::move(image.rgba), image.width, image.height), std::nullopt);
}

py::object to_image_array(const py::object& given, int bits) {
  const py::array colours = array_of(given, "colours");
  if (!holds<float>(colours)) throw py::type_error("colours: have to be of float32");
  if (bits != 8 && bits != 16) throw py::value_error("bits: 8 or 16");
  const ColourImage linear = colours_of(colours);
  if (bits == 16) {
    DeepImage deep = to_deep_image(linear);
    return as_picture(picture_array(std::move(deep.rgba), deep.width, deep.height), std::nullopt);
  }
  Image image = to_image(linear);
  return as_picture(picture_array(std::move(image.rgba), image.width, image.height), std::nullopt);
}

py::object compare(const py::object& one, const py::object& other) {
  const py::array a = array_of(one, "a"), b = array_of(other, "b");
  if (!holds<std::uint8_t>(a) || !holds<std::uint8_t>(b))
    throw py::type_error("pictures to compare have to be of uint8");
  const auto opaque = std::numeric_limits<std::uint8_t>::max();
  const std::string json = to_json(compare_images(image_of<Image>(a, opaque), image_of<Image>(b, opaque)));
  return py::module_::import("json").attr("loads")(json);
}

} // namespace

void bind_pictures(py::module_& module) {
  const std::string arrays = "an array of (height, width, 3 or 4): of uint8 or uint16, or of float32 for "
                             "linear\ncolours, as colours=True gives them";
  const std::string exr =
      "full_floats and first_hits, as Session.first_hits has them, are for OpenEXR files.";
  const auto def = [&](const char* name, const auto& function, const std::string& parameters,
                       const std::string& doc, const auto&... more) {
    module.def(name, function, signed_doc(name, parameters, doc).c_str(), more...);
    add_misfit([&](auto... last) { module.def(name, last...); }, {name, parameters});
  };
  def("save", &save, "path, picture, format=None, *, full_floats=False, first_hits=None",
      "Writes a picture to a path, or to a file open for bytes, as io.BytesIO().\n\npicture: " + arrays +
          ", which formats of integers get as to_image() makes them.\nformat: png, ppm, exr, hdr, ...; "
          "None: by the path's extension, in open files png.\n" +
          exr,
      py::arg("path"), py::arg("picture"), py::arg("format") = py::none(), py::kw_only(),
      py::arg("full_floats") = false, py::arg("first_hits") = py::none());
  def("encode", &encode, "picture, format='png', *, full_floats=False, first_hits=None",
      "The bytes of the file that save() would write.", py::arg("picture"), py::arg("format") = "png",
      py::kw_only(), py::arg("full_floats") = false, py::arg("first_hits") = py::none());
  def("to_image", &to_image_array, "colours, bits=8",
      "Makes a picture for display, of uint8 or, with bits=16, of uint16, of linear colours of float32:\n"
      "they are divided by their alpha, clipped to 0..1 and encoded as sRGB.",
      py::arg("colours"), py::arg("bits") = 8);
  def("load", &load, "path",
      "Reads a PNG, PPM, BMP, TGA or JPEG, of a path or an open file: uint8, (height, width, 4).",
      py::arg("path"));
  def("compare", &compare, "a, b",
      "How far two pictures are apart: a dict with psnr (dB, None if they are equal), worst_ssim,\n"
      "differing_pixels, max_difference and identical.",
      py::arg("a"), py::arg("b"));
}

} // namespace celltrace
