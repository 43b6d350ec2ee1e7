#include "celltrace/load.hpp"
#include "python/bindings.hpp"
#include "python/extent.hpp"
#include "python/misfit.hpp"
#include "python/options.hpp"
#include "python/reading.hpp"

#include <pybind11/numpy.h>

#include <algorithm>

namespace celltrace {

Scene read_scene(const SceneSource& source, ParseOptions options, Watch& watch) {
  options.progress = [&](std::uint64_t bytes, std::uint64_t total) {
    return watch(total ? static_cast<double>(bytes) / static_cast<double>(total) : 0);
  };
  const py::gil_scoped_release release;
  if (source.is_file) return load_scene(source.text, options);
  return parse_string(source.text, options);
}

namespace {

PythonScene read(const SceneSource& source, const py::object& progress, py::kwargs& kwargs) {
  ParseOptions options = take_parse_options(kwargs);
  for (const auto& [name, value] : kwargs)
    throw py::type_error("reading a scene has no '" + name.cast<std::string>() + "'");
  Watch watch(progress);
  try {
    return read_scene(source, options, watch);
  } catch (const Cancelled&) {
    watch.check(false);
    throw;
  }
}

/// Returns an existing index that is passed, or the index of a value that is added.
template <class T> Index index_of(PythonScene& scene, const py::object& given, const char* name) {
  if (py::isinstance<T>(given)) return scene.add(given.cast<const T&>());
  if (py::isinstance<py::int_>(given)) return given.cast<Index>();
  throw py::type_error(std::string(name) + ": an index or a " +
                       py::type::of<T>().attr("__name__").template cast<std::string>() + " is wanted");
}

Index add_object(PythonScene& scene, const py::object& shape, const py::object& material,
                 const py::object& interior, const py::kwargs& kwargs);

/// Adds an object. If an earlier object has the same mesh and material, uses its materials.
Index add_coloured(PythonScene& scene, const PythonMesh& mesh, const py::object& material,
                   const py::object& interior, const py::kwargs& kwargs) {
  const bool is_index = py::isinstance<py::int_>(material);
  if (!is_index && !py::isinstance<Material>(material))
    throw py::type_error("material: an index or a Material is wanted");
  if (is_index && material.cast<Index>() >= scene.materials.size())
    throw py::value_error("material: there is none of this index");
  const Material like = is_index ? scene.materials[material.cast<Index>()] : material.cast<const Material&>();
  auto& placed = scene.placed_colours;
  auto found = std::find_if(placed.begin(), placed.end(), [&](const PlacedColours& candidate) {
    return candidate.of == mesh.mesh && candidate.material == like;
  });
  if (found == placed.end()) {
    const ColouredObject made = add_colours(scene, mesh, like);
    found = placed.insert(found, {mesh.mesh, like, made.mesh, made.material});
  }
  return add_object(scene, py::cast(PythonMesh{found->mesh}), py::int_(found->index), interior, kwargs);
}

Index add_object(PythonScene& scene, const py::object& shape, const py::object& material,
                 const py::object& interior, const py::kwargs& kwargs) {
  if (py::isinstance<PythonMesh>(shape) && shape.cast<const PythonMesh&>().colours)
    return add_coloured(scene, shape.cast<const PythonMesh&>(), material, interior, kwargs);
  const py::object placed = py::type::of<Object>()(shape, **kwargs);
  Object object = placed.cast<const Object&>();
  object.material = index_of<Material>(scene, material, "material");
  object.interior = index_of<Interior>(scene, interior, "interior");
  scene.objects.push_back(object);
  return static_cast<Index>(scene.objects.size() - 1);
}

/// Binds a list as a tuple of copies, which can be set as a whole.
template <class T>
void bind_list(py::class_<PythonScene, std::shared_ptr<PythonScene>>& scene, const char* name,
               std::vector<T> Scene::*list, const char* doc) {
  scene.def_property(
      name, [list](const PythonScene& self) { return py::tuple(py::cast(self.*list)); },
      [list, name, doc](PythonScene& self, const py::object& to) {
        self.*list = value_of<std::vector<T>>(to, name, doc);
        self.placed_colours.clear(); // indices may have changed
      },
      doc);
}

/// Binds a member that can be set.
template <class T>
void bind_member(py::class_<PythonScene, std::shared_ptr<PythonScene>>& scene, const char* name,
                 T Scene::*member, const char* doc) {
  scene.def_property(
      name, [member](const PythonScene& self) { return self.*member; },
      [member, name, doc](PythonScene& self, const py::object& to) {
        self.*member = value_of<T>(to, name, doc);
      },
      doc);
}

/// Returns points around all bounded objects, as an array.
py::array_t<double> points_of(const PythonScene& scene) {
  const std::vector<Vec3> points = points_around(scene);
  py::array_t<double> rows({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int j = 0; j < 3; ++j)
      rows.mutable_at(static_cast<py::ssize_t>(i), j) = points[i][j];
  return rows;
}

} // namespace

void bind_scene(py::module_& module) {
  module.def("_points", &points_of, py::arg("scene"));
  py::class_<PythonScene, std::shared_ptr<PythonScene>> scene(
      module, "Scene",
      signed_doc("Scene", "",
                 "What to render: empty, or of POV-Ray's language. Its lists are tuples of values, set as a "
                 "whole.")
          .c_str());
  const auto def = [&](const char* name, const auto& function, const std::string& parameters,
                       const std::string& doc, const auto&... more) {
    scene.def(name, function, signed_doc(name, "$self" + parameters, doc).c_str(), more...);
    add_method_misfit(scene, name, {name, "$self" + parameters});
  };
  const auto reader = [&](const char* name, const auto& function, const char* from, const char* doc) {
    scene.def_static(
        name, function, py::arg(from), py::kw_only(), py::arg("progress") = py::none(),
        signed_doc(name, std::string(from) + ", *, progress=None, " + parse_signature(),
                   std::string(doc) +
                       " progress is called with the finished\nfraction, 0 to 1; where it returns "
                       "False, Cancelled is raised.\n\n" +
                       parse_listing())
            .c_str());
    add_misfit([&](auto... last) { scene.def_static(name, last...); },
               {name, std::string(from) + ", *, progress=None, " + parse_signature()});
  };
  scene.def(py::init<>(), signed_init("").c_str());
  reader(
      "from_file",
      [](const std::filesystem::path& path, const py::object& progress, py::kwargs kwargs) {
        return read({path.string(), true}, progress, kwargs);
      },
      "path", "Reads a file in POV-Ray's language. Raises SceneError where it is wrong.");
  reader(
      "from_text",
      [](const std::string& text, const py::object& progress, py::kwargs kwargs) {
        return read({text, false}, progress, kwargs);
      },
      "text", "As from_file(), of a text in memory.");
  bind_member(scene, "name", &Scene::name, "for messages: the file it came from");
  bind_member(scene, "camera", &Scene::camera, "a Camera");
  bind_member(scene, "background", &Scene::background, "colour");
  bind_member(scene, "mirrored_background", &Scene::mirrored_background,
              "what reflected rays see in place of it in a picture with alpha, without a sky; or None");
  bind_member(scene, "background_transparency", &Scene::background_transparency,
              "share of what is behind a picture with alpha that comes through the background, 0 to 1");
  bind_member(scene, "ambient_light", &Scene::ambient_light, "colour");
  bind_member(scene, "max_trace_level", &Scene::max_trace_level, "how often rays are reflected or refracted");
  bind_member(scene, "adc_bailout", &Scene::adc_bailout, "rays that count for less than this are not traced");
  scene.def("__repr__", [](const PythonScene& self) {
    return "<celltrace.Scene of " + std::to_string(self.objects.size()) + " objects and " +
           std::to_string(self.lights.size()) + " lights>";
  });
  def("add", &add_object,
      ", shape, *, material=..., interior=..., transform=..., no_shadow=False, no_image=False, "
      "no_reflection=False, is_hidden=False, inverse=False, is_lit_through=False",
      "Adds an object, and returns its index. material, interior: an index, or one that is added. Further\n"
      "keywords are fields of Object.",
      py::arg("shape"), py::kw_only(), py::arg("material") = Material(), py::arg("interior") = Interior());
  def(
      "add_material", [](PythonScene& self, const Material& material) { return self.add(material); },
      ", material", "Returns the index.", py::arg("material"));
  def(
      "add_interior", [](PythonScene& self, const Interior& interior) { return self.add(interior); },
      ", interior", "Returns the index.", py::arg("interior"));
  def(
      "add_light",
      [](PythonScene& self, const Light& light) {
        self.lights.push_back(light);
        return self.lights.size() - 1;
      },
      ", light", "Returns the index.", py::arg("light"));
  def(
      "copy", [](const PythonScene& self) { return PythonScene(self); }, "",
      "Another one, which shares its meshes.");
  scene
      .def(
          py::pickle([](const PythonScene& self) { return py::bytes(to_bytes(self)); },
                     [](const py::bytes& state) { return from_bytes<PythonScene>(std::string_view(state)); }))
      .def("__copy__", [](const PythonScene& self) { return PythonScene(self); })
      .def("__deepcopy__", [](const PythonScene& self, const py::object&) { return PythonScene(self); });
  bind_list(scene, "objects", &Scene::objects, "a tuple of Object");
  bind_list(scene, "materials", &Scene::materials, "a tuple of Material");
  bind_list(scene, "interiors", &Scene::interiors, "a tuple of Interior");
  bind_list(scene, "lights", &Scene::lights, "a tuple of Light");
}

} // namespace celltrace
