#include "python/options.hpp"

namespace pybind11::detail {

/// Converts (left, top, right, bottom).
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

/// Issues warnings of a scene as Python's warnings; drops other texts.
void warn(std::string_view text) {
  if (text.find(": warning: ") == text.npos) return;
  while (!text.empty() && text.back() == '\n')
    text.remove_suffix(1);
  const py::gil_scoped_acquire lock;
  if (PyErr_WarnEx(PyExc_UserWarning, std::string(text).c_str(), 1)) throw py::error_already_set();
}

const Fields<RenderOptions>& picture_fields() {
  static const Fields<RenderOptions> fields =
      Fields<RenderOptions>()
          .add("width", &RenderOptions::width, "of the picture, in pixels")
          .add("height", &RenderOptions::height, "of the picture, in pixels")
          .add("region", &RenderOptions::region,
               "(left, top, right, bottom): only these pixels, without those at right and bottom")
          .add("antialiasing", &RenderOptions::antialiasing, "an Antialiasing")
          .add("colours", &RenderOptions::colours, "the result is float32, linear and not clipped")
          .add("alpha", &RenderOptions::alpha, "transparent where the background is seen")
          .add("first_hits", &RenderOptions::first_hits, "Session.first_hits is wanted");
  return fields;
}

const Fields<RenderOptions>& render_fields() {
  static const Fields<RenderOptions> fields =
      Fields<RenderOptions>(picture_fields())
          .add("backend", &RenderOptions::backend, "native, cell_emu or cell_sim")
          .add("spes", &RenderOptions::spes, "how many threads, or emulated SPEs; 0: one for each processor")
          .add("simd", &RenderOptions::simd, "auto, or an instruction set of the processor's")
          .add("cache", &RenderOptions::cache, "a Cache: the software cache of emulated SPEs")
          .add("balance", &RenderOptions::balance,
               "how work is shared: gde, diffusion, fixed (or static), scatter or tiles")
          .add("accelerator", &RenderOptions::accelerator, "automatic (or auto), grid or bvh")
          .add("model", &RenderOptions::model, "shared, pipeline, pipeline-split or offload")
          .add("max_trace_level", &RenderOptions::max_trace_level, "in place of the scene's")
          .add("adc_bailout", &RenderOptions::adc_bailout, "in place of the scene's")
          .add("quality", &RenderOptions::quality, "POV-Ray's levels, 0 (colours alone) to 11")
          .add(
              "schedule", [](RenderOptions& o) -> Schedule& { return o.emulation.schedule; },
              "of emulated SPEs: free or lockstep")
          .add(
              "seed", [](RenderOptions& o) -> std::uint64_t& { return o.emulation.seed; },
              "of the order of events in lockstep")
          .add("most_seconds", &RenderOptions::most_seconds,
               "a frame that takes longer, with what it prepares, raises Cancelled; 0: no limit")
          .add(
              "most_memory", &RenderOptions::most_memory,
              "bytes of the picture, and of the scene as it is rendered; more is an InputError; 0: no limit");
  return fields;
}

const Fields<ParseOptions>& parse_fields() {
  static const Fields<ParseOptions> fields =
      Fields<ParseOptions>()
          .add("library_paths", &ParseOptions::library_paths, "folders with include files")
          .add("readable_folders", &ParseOptions::readable_folders,
               "folders that a scene may read besides its own and the library's")
          .add("writable_folders", &ParseOptions::writable_folders, "folders that a scene may write")
          .add("clock", &ParseOptions::clock, "what `clock` is")
          .add("version", &ParseOptions::version, "as if the scene began with this #version")
          .add("lenient", &ParseOptions::lenient, "leave out what is not supported, with a warning");
  return fields;
}

/// Keywords of reading that have no field: their names, defaults and meanings.
struct OtherKeyword {
  const char *name, *usual, *doc;
};
constexpr OtherKeyword kDeclares = {"declares", "{}",
                                    "a dict of floats and strings that the scene finds declared"};
constexpr OtherKeyword kLimits = {"limits", "{}", "a dict of what the scene may cost, as {'seconds': 10}"};
constexpr OtherKeyword kMessage = {
    "message", "None", "a function that hears #debug, warnings and the like; None: warnings are Python's"};
constexpr OtherKeyword kOtherKeywords[] = {kDeclares, kLimits, kMessage};

/// Removes a keyword and returns its value; an empty handle if it is not there.
py::object take(py::kwargs& kwargs, const char* name) {
  return kwargs.contains(name) ? kwargs.attr("pop")(name) : py::object();
}

/// Returns the limit of this name. Throws ValueError if there is none.
std::uint64_t ParseLimits::*limit_named(const std::string& name) {
  const auto& known = parse_limits();
  const auto limit = std::find_if(known.begin(), known.end(),
                                  [&](const NamedLimit& candidate) { return candidate.name == name; });
  if (limit != known.end()) return limit->limit;
  std::vector<std::string> names;
  for (const NamedLimit& candidate : known)
    names.emplace_back(candidate.name);
  const bool is_of_rendering = name.compare(0, 7, "render-") == 0;
  throw py::value_error(
      "limits: there is no '" + name + "'" +
      (is_of_rendering ? "; those of rendering are most_seconds and most_memory" : suggestion(name, names)));
}

} // namespace

ParseOptions take_parse_options(py::kwargs& kwargs) {
  ParseOptions options;
  parse_fields().describe([&](const char* name, const char*, const auto&) {
    if (const py::object value = take(kwargs, name)) parse_fields().set(options, name, value);
  });
  if (const py::object declares = take(kwargs, "declares"))
    for (const auto& [name, value] : value_of<Declared>(declares, kDeclares.name, kDeclares.doc))
      options.declares.emplace_back(name, value);
  if (const py::object limits = take(kwargs, "limits"))
    for (const auto& [name, value] :
         value_of<std::map<std::string, std::uint64_t>>(limits, kLimits.name, kLimits.doc))
      options.limits.*limit_named(name) = value;
  const py::object message = take(kwargs, "message");
  options.message =
      message && !message.is_none()
          ? value_of<std::function<void(std::string_view)>>(message, kMessage.name, kMessage.doc)
          : warn;
  return options;
}

std::string parse_signature() {
  std::string text = parse_fields().signature();
  for (const auto& [name, usual, doc] : kOtherKeywords)
    text += std::string(", ") + name + "=" + usual;
  return text;
}

std::string parse_listing() {
  std::string text = parse_fields().listing();
  for (const auto& [name, usual, doc] : kOtherKeywords)
    text += std::string("    ") + name + ": " + doc + "\n";
  text += "The names of limits:";
  for (const NamedLimit& limit : parse_limits())
    text += std::string(&limit == &parse_limits().front() ? " " : ", ") + limit.name;
  return text + "\n";
}

std::string render_signature() {
  return render_fields().signature();
}

std::string render_listing() {
  return render_fields().listing();
}

std::string picture_signature() {
  return picture_fields().signature_of_changes();
}

std::string picture_listing() {
  return picture_fields().listing();
}

void refuse_parse_options(const py::kwargs& kwargs) {
  std::vector<std::string> names = parse_fields().names();
  for (const OtherKeyword& keyword : kOtherKeywords)
    names.emplace_back(keyword.name);
  for (const std::string& name : names)
    if (kwargs.contains(name.c_str()))
      throw py::type_error(name + ": is for scenes that are read from a file or text, where " +
                           "Scene.from_file() and Scene.from_text() take it; this scene has been read");
}

void set_render_options(RenderOptions& options, const py::kwargs& kwargs) {
  render_fields().set_all(options, py::args(), kwargs, "rendering");
}

void set_picture_options(RenderOptions& options, const py::kwargs& kwargs) {
  picture_fields().set_all(options, py::args(), kwargs, "set_picture");
}

} // namespace celltrace
