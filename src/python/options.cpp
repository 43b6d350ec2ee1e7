#include "python/options.hpp"

namespace pybind11::detail {

/// (left, top, right, bottom)
template <> struct type_caster<celltrace::PictureRegion> {
  PYBIND11_TYPE_CASTER(celltrace::PictureRegion, const_name("tuple"));

  bool load(handle source, bool convert) {
    make_caster<std::array<int, 4>> sides;
    if (!sides.load(source, convert)) return false;
    const auto [left, top, right, bottom] = cast_op<std::array<int, 4>>(sides);
    value = {left, right, top, bottom};
    return true;
  }
  static handle cast(const celltrace::PictureRegion& region, return_value_policy, handle) {
    return make_tuple(region.left, region.top, region.right, region.bottom).release();
  }
};

} // namespace pybind11::detail

namespace celltrace {

namespace {

using Declared = std::map<std::string, std::variant<double, std::string>>;

/// Texts of a scene's as Python's users expect them: warnings as warnings, whatever else there is nowhere.
void warn(std::string_view text) {
  if (text.find(": warning: ") == text.npos) return;
  while (!text.empty() && text.back() == '\n')
    text.remove_suffix(1);
  const py::gil_scoped_acquire lock;
  if (PyErr_WarnEx(PyExc_UserWarning, std::string(text).c_str(), 1)) throw py::error_already_set();
}

Fields<RenderOptions> picture_fields() {
  return Fields<RenderOptions>()
      .add("width", &RenderOptions::width, "")
      .add("height", &RenderOptions::height, "")
      .add("region", &RenderOptions::region, "")
      .add("antialiasing", &RenderOptions::antialiasing, "")
      .add("colours", &RenderOptions::colours, "")
      .add("alpha", &RenderOptions::alpha, "")
      .add("first_hits", &RenderOptions::first_hits, "");
}

Fields<RenderOptions> render_fields() {
  return picture_fields()
      .add("backend", &RenderOptions::backend, "")
      .add("spes", &RenderOptions::spes, "")
      .add("simd", &RenderOptions::simd, "")
      .add("cache", &RenderOptions::cache, "")
      .add("balance", &RenderOptions::balance, "")
      .add("accelerator", &RenderOptions::accelerator, "")
      .add("model", &RenderOptions::model, "")
      .add("max_trace_level", &RenderOptions::max_trace_level, "")
      .add("adc_bailout", &RenderOptions::adc_bailout, "")
      .add("quality", &RenderOptions::quality, "")
      .add(
          "schedule", [](RenderOptions& o) -> Schedule& { return o.emulation.schedule; }, "")
      .add(
          "seed", [](RenderOptions& o) -> std::uint64_t& { return o.emulation.seed; }, "");
}

const Fields<ParseOptions>& parse_fields() {
  static const Fields<ParseOptions> fields = Fields<ParseOptions>()
                                                 .add("library_paths", &ParseOptions::library_paths, "")
                                                 .add("readable_folders", &ParseOptions::readable_folders, "")
                                                 .add("writable_folders", &ParseOptions::writable_folders, "")
                                                 .add("clock", &ParseOptions::clock, "")
                                                 .add("version", &ParseOptions::version, "")
                                                 .add("lenient", &ParseOptions::lenient, "");
  return fields;
}

/// The value of a keyword, which is taken out; an empty handle if it is not there.
py::object take(py::kwargs& kwargs, const char* name) {
  return kwargs.contains(name) ? kwargs.attr("pop")(name) : py::object();
}

} // namespace

ParseOptions take_parse_options(py::kwargs& kwargs) {
  ParseOptions options;
  parse_fields().describe([&](const char* name, const char*, const auto&) {
    if (const py::object value = take(kwargs, name)) parse_fields().set(options, name, value);
  });
  if (const py::object declares = take(kwargs, "declares"))
    for (const auto& [name, value] : declares.cast<Declared>())
      options.declares.emplace_back(name, value);
  if (const py::object limits = take(kwargs, "limits"))
    for (const auto& given : limits.cast<std::map<std::string, std::uint64_t>>()) {
      const std::string& name = given.first; // no structured binding: Clang below 16 lets no lambda use one
      const auto& known = parse_limits();
      const auto limit = std::find_if(known.begin(), known.end(),
                                      [&](const NamedLimit& candidate) { return candidate.name == name; });
      if (limit == known.end()) throw py::value_error("there is no limit '" + name + "'");
      options.limits.*limit->limit = given.second;
    }
  const py::object message = take(kwargs, "message");
  options.message =
      message && !message.is_none() ? message.cast<std::function<void(std::string_view)>>() : warn;
  return options;
}

void set_render_options(RenderOptions& options, const py::kwargs& kwargs) {
  render_fields().set_all(options, py::args(), kwargs, "rendering");
}

void set_picture_options(RenderOptions& options, const py::kwargs& kwargs) {
  picture_fields().set_all(options, py::args(), kwargs, "set_picture");
}

} // namespace celltrace
