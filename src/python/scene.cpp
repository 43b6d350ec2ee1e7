#include "python/bindings.hpp"
#include "python/options.hpp"
#include "python/reading.hpp"

namespace celltrace {

Scene read_scene(const SceneSource& source, ParseOptions options, Watch& watch) {
  options.progress = [&](std::uint64_t bytes, std::uint64_t total) {
    return watch(total ? static_cast<double>(bytes) / static_cast<double>(total) : 0);
  };
  const py::gil_scoped_release release;
  if (source.is_file) return parse_file(source.text, options);
  return parse_string(source.text, options);
}

namespace {

Scene read(const SceneSource& source, const py::object& progress, py::kwargs& kwargs) {
  ParseOptions options = take_parse_options(kwargs);
  for (const auto& [name, value] : kwargs)
    throw py::type_error("reading has no '" + name.cast<std::string>() + "'");
  Watch watch(progress);
  try {
    return read_scene(source, options, watch);
  } catch (const Cancelled&) {
    watch.check(false);
    throw;
  }
}

/// An index of what there is, or the index of what is added.
template <class T> Index index_of(Scene& scene, const py::object& given, const char* name) {
  if (py::isinstance<T>(given)) return scene.add(given.cast<const T&>());
  if (py::isinstance<py::int_>(given)) return given.cast<Index>();
  throw py::type_error(std::string(name) + ": an index or a " +
                       py::type::of<T>().attr("__name__").template cast<std::string>() + " is wanted");
}

Index add_object(Scene& scene, const py::object& shape, const py::object& material,
                 const py::object& interior, const py::kwargs& kwargs) {
  const py::object placed = py::type::of<Object>()(shape, **kwargs);
  Object object = placed.cast<const Object&>();
  object.material = index_of<Material>(scene, material, "material");
  object.interior = index_of<Interior>(scene, interior, "interior");
  scene.objects.push_back(object);
  return static_cast<Index>(scene.objects.size() - 1);
}

/// A list as a tuple of copies, which is set as a whole.
template <class T>
void bind_list(py::class_<Scene, std::shared_ptr<Scene>>& scene, const char* name,
               std::vector<T> Scene::*list, const char* doc) {
  scene.def_property(
      name, [list](const Scene& self) { return py::tuple(py::cast(self.*list)); },
      [list](Scene& self, std::vector<T> to) { self.*list = std::move(to); }, doc);
}

} // namespace

void bind_scene(py::module_& module) {
  py::class_<Scene, std::shared_ptr<Scene>> scene(
      module, "Scene",
      "What to render: empty, or of POV-Ray's language. Its lists are tuples of values, set as a whole.");
  scene.def(py::init<>())
      .def_static(
          "from_file",
          [](const std::filesystem::path& path, const py::object& progress, py::kwargs kwargs) {
            return read({path.string(), true}, progress, kwargs);
          },
          py::arg("path"), py::kw_only(), py::arg("progress") = py::none(),
          "Reads a file in POV-Ray's language. Raises SceneError where it is wrong.")
      .def_static(
          "from_text",
          [](const std::string& text, const py::object& progress, py::kwargs kwargs) {
            return read({text, false}, progress, kwargs);
          },
          py::arg("text"), py::kw_only(), py::arg("progress") = py::none(),
          "As from_file(), of a text in memory.")
      .def_readwrite("name", &Scene::name, "for messages: the file it came from")
      .def_readwrite("camera", &Scene::camera, "")
      .def_readwrite("background", &Scene::background, "colour")
      .def_readwrite("mirrored_background", &Scene::mirrored_background,
                     "what reflected rays see in place of it in a picture with alpha, without a sky; or None")
      .def_readwrite("background_transparency", &Scene::background_transparency,
                     "share of what is behind a picture with alpha that comes through the background, 0 to 1")
      .def_readwrite("ambient_light", &Scene::ambient_light, "colour")
      .def_readwrite("max_trace_level", &Scene::max_trace_level, "")
      .def_readwrite("adc_bailout", &Scene::adc_bailout, "")
      .def("add", &add_object, py::arg("shape"), py::kw_only(), py::arg("material") = Material(),
           py::arg("interior") = Interior(),
           "Adds an object, and returns its index. material, interior: an index, or one that is added.\n"
           "Further keywords are fields of Object.")
      .def(
          "add_material", [](Scene& self, const Material& material) { return self.add(material); },
          py::arg("material"), "Returns the index.")
      .def(
          "add_interior", [](Scene& self, const Interior& interior) { return self.add(interior); },
          py::arg("interior"), "Returns the index.")
      .def(
          "add_light",
          [](Scene& self, const Light& light) {
            self.lights.push_back(light);
            return self.lights.size() - 1;
          },
          py::arg("light"), "Returns the index.")
      .def(
          "copy", [](const Scene& self) { return Scene(self); }, "Another one, which shares its meshes.")
      .def("__repr__", [](const Scene& self) {
        return "<celltrace.Scene of " + std::to_string(self.objects.size()) + " objects and " +
               std::to_string(self.lights.size()) + " lights>";
      });
  bind_list(scene, "objects", &Scene::objects, "");
  bind_list(scene, "materials", &Scene::materials, "");
  bind_list(scene, "interiors", &Scene::interiors, "");
  bind_list(scene, "lights", &Scene::lights, "");
}

} // namespace celltrace
