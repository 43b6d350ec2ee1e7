#include "python/mesh.hpp"

#include "python/arrays.hpp"
#include "python/bindings.hpp"
#include "python/misfit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace celltrace {

namespace {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// Returns `given` as rows of three indices into the array named `of`, which has `count` rows. Throws
/// ValueError if it is something else.
Indices index_rows(const py::object& given, std::size_t count, const std::string& name,
                   const std::string& of) {
  const auto array = py::array::ensure(given);
  if (!array) throw py::value_error(name + ": has to be an array");
  check_shape(array, {-1, 3}, name);
  if (array.dtype().kind() != 'i' && array.dtype().kind() != 'u')
    throw py::value_error(name + ": has to be of whole numbers");
  Indices indices = Indices::ensure(array);
  const std::int64_t* begin = indices.data();
  const auto wrong = std::find_if(begin, begin + indices.size(), [&](std::int64_t index) {
    return index < 0 || index >= static_cast<std::int64_t>(std::min<std::size_t>(count, kNoIndex));
  });
  if (wrong != begin + indices.size())
    throw py::value_error(name + ": row " + std::to_string((wrong - begin) / 3) + " has the index " +
                          std::to_string(*wrong) + ", and " + of + " has " + std::to_string(count) + " rows");
  return indices;
}

/// Returns an array of numbers. Throws ValueError if `given` cannot become one.
Floats floats_of(const py::object& given, const std::string& name) {
  Floats floats = py::isinstance<py::str>(given) ? Floats() : Floats::ensure(given);
  if (!floats || py::isinstance<py::str>(given))
    throw py::value_error(name + ": has to be an array of numbers, in rows of one length");
  return floats;
}
std::optional<Floats> floats_or_none(const py::object& given, const std::string& name) {
  if (given.is_none()) return std::nullopt;
  return floats_of(given, name);
}

std::vector<Vec3f> vector_rows(const Floats& given, const std::string& name) {
  check_shape(given, {-1, 3}, name);
  const auto* first = reinterpret_cast<const Vec3f*>(given.data());
  return {first, first + given.shape(0)};
}
static_assert(sizeof(Vec3f) == 3 * sizeof(float));

void set_rows(Mesh& mesh, Index (Mesh::Triangle::*corners)[3], const Indices& rows) {
  auto next = rows.data();
  for (Mesh::Triangle& triangle : mesh.triangles)
    for (Index& corner : triangle.*corners)
      corner = static_cast<Index>(*next++);
}

bool is_finite(const Vec3f& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool is_finite(const Vec2f& v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}

/// Rows that are not finite: take() replaces them and says which they are, or throws ValueError if they are
/// not allowed.
class Holes {
public:
  explicit Holes(bool are_allowed) : are_allowed_(are_allowed) {}

  template <class Row> std::vector<bool> take(std::vector<Row>& rows, const std::string& name) const {
    std::vector<bool> is_hole;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (is_finite(rows[i])) continue;
      if (!are_allowed_)
        throw py::value_error(name + ": row " + std::to_string(i) +
                              " is not finite (skip_nan=True leaves out faces with such corners)");
      is_hole.resize(rows.size());
      is_hole[i] = true;
    }
    if (is_hole.empty()) return is_hole;
    // Stand in with an existing row, because unused rows count for a mesh's bounds, too.
    const auto first = std::find(is_hole.begin(), is_hole.end(), false);
    const Row stand_in = first == is_hole.end() ? Row(0) : rows[first - is_hole.begin()];
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (is_hole[i]) rows[i] = stand_in;
    return is_hole;
  }

private:
  bool are_allowed_;
};

/// Removes the triangles with a corner in `holes`.
void remove(Mesh& mesh, Index (Mesh::Triangle::*corners)[3], const std::vector<bool>& holes) {
  if (holes.empty()) return;
  std::erase_if(mesh.triangles, [&](const Mesh::Triangle& triangle) {
    const auto& corner = triangle.*corners;
    return holes[corner[0]] || holes[corner[1]] || holes[corner[2]];
  });
}

/// Sets surface coordinates at the corners of triangles from those of the vertices.
void set_coordinates(Mesh& mesh, const std::vector<Vec2f>& of_vertices) {
  mesh.coordinates.clear();
  mesh.coordinates.reserve(mesh.triangles.size());
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    Mesh::Coordinates& coordinates = mesh.coordinates.emplace_back();
    for (int i = 0; i < 3; ++i)
      coordinates.corner[i] = of_vertices[triangle.vertex[i]];
  }
}

/// Returns the places of values in a colour map, as surface coordinates.
std::vector<Vec2f> map_places(const Floats& values, const std::optional<std::pair<double, double>>& range) {
  const float* first = values.data();
  const std::size_t count = static_cast<std::size_t>(values.size());
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < count; ++i)
    if (std::isfinite(first[i])) {
      low = std::min(low, double{first[i]});
      high = std::max(high, double{first[i]});
    }
  if (range) std::tie(low, high) = *range;
  if (range && !(low < high)) throw py::value_error("value_range: has to be (low, high)");
  std::vector<Vec2f> places;
  places.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    double part = high > low ? std::clamp((double{first[i]} - low) / (high - low), 0.0, 1.0) : 0.5;
    if (!std::isfinite(first[i])) part = first[i]; // kept for Holes
    places.emplace_back(static_cast<float>(kFirstOfMap + (kLastOfMap - kFirstOfMap) * part), 0.0f);
  }
  return places;
}

std::vector<Vec3> colour_rows(const py::array_t<double>& rows) {
  std::vector<Vec3> colours;
  for (py::ssize_t i = 0; i < rows.shape(0); ++i)
    colours.emplace_back(rows.at(i, 0), rows.at(i, 1), rows.at(i, 2));
  return colours;
}

/// The keywords that colour a mesh.
struct Colouring {
  std::optional<Floats> colours, values;
  py::object colour_map;
  std::optional<std::pair<double, double>> value_range;
};

std::shared_ptr<const MeshColours> colour(Mesh& mesh, const Colouring& given, const Holes& holes) {
  if (!given.colours && !given.values) {
    if (!given.colour_map.is_none() || given.value_range)
      throw py::type_error("colour_map and value_range: are for values");
    return nullptr;
  }
  const auto count = static_cast<int>(mesh.vertices.size());
  const py::module_ helpers = py::module_::import("celltrace._colours");
  MeshColours made;
  if (given.values) {
    if (given.colours) throw py::type_error("colours, values: one of them");
    check_shape(*given.values, {count}, "values");
    made.map = colour_rows(helpers.attr("map_colours")(given.colour_map).cast<py::array_t<double>>());
    std::vector<Vec2f> places = map_places(*given.values, given.value_range);
    remove(mesh, &Mesh::Triangle::vertex, holes.take(places, "values"));
    set_coordinates(mesh, places);
    return std::make_shared<MeshColours>(std::move(made));
  }
  check_shape(*given.colours, {count, 3}, "colours");
  std::vector<Vec3f> rows = vector_rows(*given.colours, "colours");
  remove(mesh, &Mesh::Triangle::vertex, holes.take(rows, "colours"));
  const py::tuple few = helpers.attr("palette")(*given.colours);
  made.palette = colour_rows(few[0].cast<py::array_t<double>>());
  const auto index = few[1].cast<Indices>();
  for (Mesh::Triangle& triangle : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      triangle.material[i] = static_cast<Index>(index.at(triangle.vertex[i]));
  return std::make_shared<MeshColours>(std::move(made));
}

PythonMesh make_mesh(const py::object& vertices_given, const py::object& triangles,
                     const py::object& normals_given, const py::object& normal_indices,
                     const py::object& uv_given, const Vec3& inside_vector, const py::object& colours_given,
                     const py::object& values_given, const py::object& colour_map,
                     const std::optional<std::pair<double, double>>& value_range, bool skip_nan) {
  const Floats vertices = floats_of(vertices_given, "vertices");
  const std::optional<Floats> normals = floats_or_none(normals_given, "normals"),
                              uv = floats_or_none(uv_given, "uv"),
                              colours = floats_or_none(colours_given, "colours"),
                              values = floats_or_none(values_given, "values");
  auto mesh = std::make_shared<Mesh>();
  const Holes holes(skip_nan);
  mesh->vertices = vector_rows(vertices, "vertices");
  const Indices corners = index_rows(triangles, mesh->vertices.size(), "triangles", "vertices");
  mesh->triangles.resize(static_cast<std::size_t>(corners.shape(0)));
  set_rows(*mesh, &Mesh::Triangle::vertex, corners);
  if (normals) {
    mesh->normals = vector_rows(*normals, "normals");
    if (normal_indices.is_none()) {
      if (mesh->normals.size() != mesh->vertices.size())
        throw py::value_error("normals: has " + std::to_string(mesh->normals.size()) +
                              " rows, and vertices has " + std::to_string(mesh->vertices.size()) +
                              "; there has to be one for each vertex, unless normal_indices says which");
      set_rows(*mesh, &Mesh::Triangle::normal, corners);
    } else {
      const Indices rows = index_rows(normal_indices, mesh->normals.size(), "normal_indices", "normals");
      if (rows.shape(0) != corners.shape(0))
        throw py::value_error("normal_indices: has " + std::to_string(rows.shape(0)) +
                              " rows, and triangles has " + std::to_string(corners.shape(0)));
      set_rows(*mesh, &Mesh::Triangle::normal, rows);
    }
    remove(*mesh, &Mesh::Triangle::normal, holes.take(mesh->normals, "normals"));
  } else if (!normal_indices.is_none()) {
    throw py::type_error("normal_indices: there are no normals");
  }
  remove(*mesh, &Mesh::Triangle::vertex, holes.take(mesh->vertices, "vertices"));
  if (uv && values) throw py::type_error("uv, values: one of them");
  auto with_colours = colour(*mesh, {colours, values, colour_map, value_range}, holes);
  if (uv) {
    check_shape(*uv, {static_cast<int>(mesh->vertices.size()), 2}, "uv");
    std::vector<Vec2f> rows;
    for (py::ssize_t i = 0; i < uv->shape(0); ++i)
      rows.emplace_back(uv->at(i, 0), uv->at(i, 1));
    remove(*mesh, &Mesh::Triangle::vertex, holes.take(rows, "uv"));
    set_coordinates(*mesh, rows);
  }
  mesh->inside_vector = inside_vector;
  return {std::move(mesh), std::move(with_colours)};
}

/// Returns an array that shows a list of a mesh without copying it, and keeps the mesh alive.
template <class T>
py::array rows_of(const py::object& mesh, const T* first, std::size_t count, std::size_t bytes) {
  py::array_t<T> rows({static_cast<py::ssize_t>(count), py::ssize_t{3}},
                      {static_cast<py::ssize_t>(bytes), static_cast<py::ssize_t>(sizeof(T))}, first, mesh);
  rows.attr("setflags")(py::arg("write") = false);
  return rows;
}

/// Returns a pigment of one colour, with the transparency of another one.
Pigment pigment_of(const Vec3& colour, const Pigment& like) {
  return {colour, like.filter, like.transmit};
}

} // namespace

ColouredObject add_colours(Scene& scene, const PythonMesh& given, const Material& material) {
  if (material.map || material.below || material.inside)
    throw py::value_error(
        "material: of a mesh with colours has to be without layers, texture maps and interior textures");
  Material made = material;
  if (!given.colours->map.empty()) {
    auto map = std::make_shared<PatternMap<Pigment>>();
    map->pattern.kind = pattern::Gradient{{1, 0, 0}};
    map->pattern.uv_mapping = true;
    const std::vector<Vec3>& colours = given.colours->map;
    for (std::size_t i = 0; i < colours.size(); ++i) {
      const double part =
          colours.size() > 1 ? static_cast<double>(i) / static_cast<double>(colours.size() - 1) : 0;
      map->entries.push_back(
          {kFirstOfMap + (kLastOfMap - kFirstOfMap) * part, pigment_of(colours[i], material.pigment)});
    }
    made.pigment.map = std::move(map);
    return {given.mesh, scene.add(made)};
  }
  const auto first = static_cast<Index>(scene.materials.size());
  for (const Vec3& colour : given.colours->palette) {
    made.pigment = pigment_of(colour, material.pigment);
    scene.add(made);
  }
  auto mesh = std::make_shared<Mesh>(*given.mesh);
  for (Mesh::Triangle& triangle : mesh->triangles)
    for (Index& corner : triangle.material)
      corner += first;
  return {std::move(mesh), first};
}

void bind_mesh(py::module_& module) {
  const std::string parameters =
      "vertices, triangles, *, normals=None, normal_indices=None, uv=None, inside_vector=0, colours=None, "
      "values=None, colour_map=None, value_range=None, skip_nan=False";
  py::class_<PythonMesh, std::shared_ptr<PythonMesh>> mesh(
      module, "Mesh",
      signed_doc(
          "Mesh", parameters,
          "Triangles with shared vertices, of NumPy's arrays. Any number of objects may have it.\n\n"
          "    vertices: (n, 3)\n"
          "    triangles: (m, 3), indices of vertices\n"
          "    normals: (n, 3), for smooth surfaces; (k, 3) with normal_indices\n"
          "    normal_indices: (m, 3), the normals at the corners of triangles\n"
          "    uv: (n, 2), surface coordinates of vertices\n"
          "    inside_vector: a direction by which points inside are found, for CSG\n"
          "    colours: (n, 3), linear, as srgb() makes them: Scene.add() gives each its material, with the\n"
          "        finish of the object's. Of more than 4,096 different ones similar ones become one.\n"
          "    values: (n), numbers that colour_map makes colours of, between the vertices as well\n"
          "    colour_map: a name or map of matplotlib's, a function of an array of 0 to 1, or an array of\n"
          "        (k, 3), at most 256; sRGB. None: viridis\n"
          "    value_range: (low, high), what is 0 and 1 of the map; None: the least and greatest values\n"
          "    skip_nan: leave out the faces with a corner whose place, normal or value is not a number")
          .c_str());
  bind_pickle<PythonMesh>(mesh);
  mesh.def(py::init(&make_mesh), py::arg("vertices"), py::arg("triangles"), py::kw_only(),
           py::arg("normals") = py::none(), py::arg("normal_indices") = py::none(),
           py::arg("uv") = py::none(), py::arg("inside_vector") = Vec3(0), py::arg("colours") = py::none(),
           py::arg("values") = py::none(), py::arg("colour_map") = py::none(),
           py::arg("value_range") = py::none(), py::arg("skip_nan") = false, signed_init(parameters).c_str());
  add_init_misfit<PythonMesh>(mesh, {"Mesh", parameters});
  mesh.def_property_readonly(
          "vertices",
          [](const py::object& self) {
            const auto& rows = self.cast<const PythonMesh&>().mesh->vertices;
            return rows_of(self, rows.empty() ? nullptr : &rows[0].x, rows.size(), sizeof(Vec3f));
          },
          "(n, 3), read-only")
      .def_property_readonly(
          "triangles",
          [](const py::object& self) {
            const auto& rows = self.cast<const PythonMesh&>().mesh->triangles;
            return rows_of(self, rows.empty() ? nullptr : rows[0].vertex, rows.size(),
                           sizeof(Mesh::Triangle));
          },
          "(m, 3), read-only")
      .def(
          "__eq__",
          [](const PythonMesh& self, const PythonMesh& other) {
            return self.mesh == other.mesh && self.colours == other.colours;
          },
          py::is_operator())
      .def("__hash__", [](const PythonMesh& self) { return std::hash<const void*>()(self.mesh.get()); })
      .def("__repr__", [](const PythonMesh& self) {
        return "<celltrace.Mesh of " + std::to_string(self.mesh->vertices.size()) + " vertices and " +
               std::to_string(self.mesh->triangles.size()) + " triangles>";
      });
}

} // namespace celltrace
