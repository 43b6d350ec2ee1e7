#include "python/arrays.hpp"
#include "python/bindings.hpp"
#include "python/misfit.hpp"
#include "python/options.hpp"
#include "python/picture.hpp"
#include "python/reading.hpp"

#include "celltrace/session.hpp"

namespace celltrace {

namespace {

// Shares of the phases in a job's progress.
constexpr double kReading = 0.1, kBuilding = 0.2;

/// Returns a framebuffer in an array of (height, width, 3 or 4) bytes.
Framebuffer framebuffer_of(const py::array& array, const RenderOptions& options) {
  const bool has_alpha = array.ndim() == 3 && array.shape(2) == 4;
  check_shape(array, {options.height, options.width, has_alpha ? 4 : 3}, "into");
  if (!array.dtype().is(py::dtype::of<std::uint8_t>()) || !array.writeable())
    throw py::value_error("into: has to be a writable array of uint8");
  if (array.strides(2) != 1 || array.strides(1) != array.shape(2) || array.strides(0) <= 0)
    throw py::value_error("into: pixels of a row have to lie side by side");
  return {const_cast<void*>(array.data()), static_cast<std::size_t>(array.strides(0)),
          has_alpha ? PixelFormat::rgba8 : PixelFormat::rgb8};
}

py::object array_of(RenderResult& result, bool colours) {
  if (colours)
    return as_picture(
        picture_array(std::move(result.colours.rgba), result.colours.width, result.colours.height),
        result.colours.gamma);
  return as_picture(picture_array(std::move(result.image.rgba), result.image.width, result.image.height),
                    std::nullopt);
}

py::object arrays_of(FirstHits hits) {
  const py::ssize_t width = hits.width, height = hits.height;
  py::dict arrays;
  arrays["depth"] = array_of_shape(std::move(hits.depth), {height, width});
  arrays["normal"] = array_of_shape(std::move(hits.normal), {height, width, 3});
  arrays["object"] = array_of_shape(std::move(hits.object), {height, width});
  return arrays;
}

/// A Session that Python's threads may share: changes while it renders are refused.
class GuardedSession {
public:
  GuardedSession(const PythonScene& scene, RenderOptions options) {
    options.build_progress = [this](double fraction) {
      watch_->set_part(0, kBuilding);
      return (*watch_)(fraction);
    };
    session_.emplace(scene, options);
  }
  GuardedSession(const GuardedSession&) = delete;

  /// Returns the session. Throws Error while another thread, or a frame's own progress function, uses it.
  Session& idle() {
    if (watch_) throw Error("the session is rendering");
    return *session_;
  }
  void cancel() { session_->cancel(); }

  PythonScene scene() { return idle().scene(); }
  void set_camera(const Camera& to) { idle().set_camera(to); }
  void replace(const PythonScene& scene) { idle().replace(scene); }
  void set_picture(const py::kwargs& kwargs) {
    RenderOptions options = idle().options();
    set_picture_options(options, kwargs);
    session_->set_picture(options);
  }
  const py::object& statistics() const { return statistics_; }
  const py::object& first_hits() const { return first_hits_; }

  py::object render(const std::optional<py::array>& into, const py::object& progress) {
    Session& session = idle();
    if (into) session.set_framebuffer(framebuffer_of(*into, session.options()));
    Watch watch(progress);
    RenderResult result;
    watch_ = &watch;
    try {
      const py::gil_scoped_release release;
      result = session.render([&](double fraction) {
        watch.set_part(kBuilding, 1);
        return watch(fraction);
      });
    } catch (...) {
      finish(into.has_value());
      throw;
    }
    finish(into.has_value());
    watch.check(result.complete);
    statistics_ = py::module_::import("json").attr("loads")(to_json(result.statistics));
    first_hits_ = session.options().first_hits ? arrays_of(std::move(result.first_hits)) : py::none();
    return into ? py::object(*into) : array_of(result, session.options().colours);
  }

private:
  void finish(bool had_framebuffer) {
    watch_ = nullptr;
    if (had_framebuffer) session_->set_framebuffer(std::nullopt);
  }

  std::optional<Session> session_;
  Watch* watch_ = nullptr; ///< watches the frame that is being rendered
  py::object statistics_ = py::none(), first_hits_ = py::none();
};

std::filesystem::path path_of(const py::object& scene) {
  std::filesystem::path path = value_of<std::filesystem::path>(scene, "scene", "a Scene or a path");
  std::error_code ignored;
  if (path.string().find('{') != std::string::npos && !std::filesystem::exists(path, ignored))
    throw py::value_error("scene: there is no such file; Scene.from_text() makes a Scene of a text");
  return path;
}

/// Renders one frame of a scene, or of a scene's file.
py::object render_once(const py::object& scene, const py::object& progress, py::kwargs kwargs) {
  Watch watch(progress);
  std::shared_ptr<const Scene> read;
  RenderOptions options;
  double done = 0;
  const bool is_scene = py::isinstance<PythonScene>(scene);
  if (is_scene) refuse_parse_options(kwargs);
  ParseOptions reading = is_scene ? ParseOptions() : take_parse_options(kwargs);
  set_render_options(options, kwargs);
  try {
    if (is_scene) {
      // A copy, because other threads may change the scene while the lock is released.
      read = std::make_shared<Scene>(scene.cast<const PythonScene&>());
    } else {
      done = kReading;
      watch.set_part(0, done);
      reading.width = options.width;
      reading.height = options.height;
      reading.quality = options.quality;
      const auto path = path_of(scene);
      read = std::make_shared<Scene>(read_scene({path.string(), true}, std::move(reading), watch));
    }
  } catch (const Cancelled&) {
    watch.check(false);
    throw;
  }
  options.build_progress = [&](double fraction) {
    watch.set_part(done, done + kBuilding);
    return watch(fraction);
  };
  RenderResult result;
  {
    const py::gil_scoped_release release;
    result = render(*read, options, [&](double fraction) {
      watch.set_part(done + kBuilding, 1);
      return watch(fraction);
    });
    read.reset();
  }
  watch.check(result.complete);
  return array_of(result, options.colours);
}

void bind_options(py::module_& module) {
  bind_values<Antialiasing>(module, "Antialiasing", "POV-Ray's methods of antialiasing.",
                            Fields<Antialiasing>()
                                .add("method", &Antialiasing::method, "fixed or adaptive: POV-Ray's 1 and 2")
                                .add("threshold", &Antialiasing::threshold, "of differences that count")
                                .add("depth", &Antialiasing::depth, "1 to 9")
                                .add("jitter", &Antialiasing::jitter, "0 to 1")
                                .add("gamma", &Antialiasing::gamma, ""));
  bind_values<CacheConfig>(module, "Cache", "The software cache of each SPE.",
                           Fields<CacheConfig>()
                               .add("ways", &CacheConfig::ways, "a power of two")
                               .add("sets", &CacheConfig::sets, "a power of two")
                               .add("replacement", &CacheConfig::replacement, "random, fifo or lru")
                               .add("enabled", &CacheConfig::enabled, "False: nothing is kept"));
}

} // namespace

void bind_rendering(py::module_& module) {
  bind_options(module);
  module.def(
      "render", &render_once, py::arg("scene"), py::kw_only(), py::arg("progress") = py::none(),
      signed_doc(
          "render", "scene, *, progress=None, " + render_signature() + ", " + parse_signature(),
          "Renders a Scene or a file in POV-Ray's language: a Picture, which is an array of (height, "
          "width, 4), top\nrow first.\n\n"
          "It is of uint8, for display; with colours=True of float32, linear, as rays brought them.\n"
          "progress is called with the finished fraction, 0 to 1; where it returns False, Cancelled is "
          "raised.\n\n" +
              render_listing() + "\nOf a file also:\n\n" + parse_listing())
          .c_str());

  py::class_<GuardedSession, std::shared_ptr<GuardedSession>> session(
      module, "Session",
      signed_doc("Session", "scene, *, " + render_signature(),
                 "A scene on a machine, rendered frame after frame at the cost of what has changed.\n\n"
                 "It has a copy of the scene. Indices are those of the scene's lists.\n\n" +
                     render_listing())
          .c_str());
  const auto def = [&](const char* name, const auto& function, const std::string& parameters, const char* doc,
                       const auto&... more) {
    session.def(name, function, signed_doc(name, "$self" + parameters, doc).c_str(), more...);
    add_method_misfit(session, name, {name, "$self" + parameters});
  };
  session.def(py::init([](const PythonScene& scene, const py::kwargs& kwargs) {
                refuse_parse_options(kwargs);
                RenderOptions options;
                set_render_options(options, kwargs);
                return std::make_shared<GuardedSession>(scene, options);
              }),
              py::arg("scene"), signed_init("scene, *, " + render_signature()).c_str());
  add_init_misfit<GuardedSession>(session, {"Session", "scene, *, " + render_signature()});
  session
      .def_property_readonly(
          "statistics", &GuardedSession::statistics,
          "Of the last whole frame, a dict by the keys of docs/statistics.md; None before.")
      .def_property_readonly(
          "first_hits", &GuardedSession::first_hits,
          "What each pixel of the last whole frame sees first, where first_hits was asked for: a dict of\n"
          "depth (height, width), from where the ray starts; normal (height, width, 3); object (height,\n"
          "width), 1 + the index of its interior, 0 where nothing is.")
      .def_property_readonly("scene", &GuardedSession::scene, "A copy of the scene as it is now.");
  def("render", &GuardedSession::render, ", *, into=None, progress=None",
      "Renders the scene as it is now, as the function render(). into: an array of (height, width, 3 or 4)\n"
      "bytes, which gets pixels when they are finished, and is returned.",
      py::kw_only(), py::arg("into") = py::none(), py::arg("progress") = py::none());
  def("cancel", &GuardedSession::cancel, "",
      "Ends the frame that another thread is rendering, where Cancelled is raised.");
  def("set_camera", &GuardedSession::set_camera, ", camera", "From the next frame on.", py::arg("camera"));
  def(
      "set_light",
      [](GuardedSession& self, Index light, const Light& to) { self.idle().set_light(light, to); },
      ", light, to", "light: an index of Scene.lights.", py::arg("light"), py::arg("to"));
  def(
      "set_material",
      [](GuardedSession& self, Index material, const Material& to) {
        self.idle().set_material(material, to);
      },
      ", material, to", "material: an index of Scene.materials.", py::arg("material"), py::arg("to"));
  def(
      "set_interior",
      [](GuardedSession& self, Index interior, const Interior& to) {
        self.idle().set_interior(interior, to);
      },
      ", interior, to", "interior: an index of Scene.interiors.", py::arg("interior"), py::arg("to"));
  def(
      "set_object",
      [](GuardedSession& self, Index object, const Object& to) { self.idle().set_object(object, to); },
      ", object, to", "object: an index of Scene.objects.", py::arg("object"), py::arg("to"));
  def(
      "set_transform",
      [](GuardedSession& self, Index object, const Transform& to) { self.idle().set_transform(object, to); },
      ", object, to", "object: an index of Scene.objects.", py::arg("object"), py::arg("to"));
  def(
      "set_material_of",
      [](GuardedSession& self, Index object, Index material) {
        self.idle().set_material_of(object, material);
      },
      ", object, material", "Gives an object another material of the scene's, both by their indices.",
      py::arg("object"), py::arg("material"));
  def(
      "show", [](GuardedSession& self, Index object, bool visible) { self.idle().show(object, visible); },
      ", object, visible=True", "Shows or hides an object.", py::arg("object"), py::arg("visible") = true);
  def("replace", &GuardedSession::replace, ", scene", "Takes another scene.", py::arg("scene"));
  def("set_picture", &GuardedSession::set_picture, ", *, " + picture_signature(),
      ("Changes the picture; the scene stays on the machine.\n\n" + picture_listing()).c_str());
}

} // namespace celltrace
