// Places, shapes and objects.
#include "python/arrays.hpp"
#include "python/bindings.hpp"
#include "python/fields.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace celltrace {

namespace {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// Whole numbers from 0 to below `count`, in rows of three. Throws ValueError.
Indices index_rows(const py::array& given, std::size_t count, const std::string& name) {
  check_shape(given, {-1, 3}, name);
  if (given.dtype().kind() != 'i' && given.dtype().kind() != 'u')
    throw py::value_error(name + ": has to be of whole numbers");
  Indices indices = Indices::ensure(given);
  const std::int64_t* begin = indices.data();
  const auto wrong = std::find_if(begin, begin + indices.size(), [&](std::int64_t index) {
    return index < 0 || index >= static_cast<std::int64_t>(std::min<std::size_t>(count, kNoIndex));
  });
  if (wrong != begin + indices.size())
    throw py::value_error(name + ": " + std::to_string(*wrong) + " is none of " + std::to_string(count) +
                          " there are");
  return indices;
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

std::shared_ptr<Mesh> make_mesh(const Floats& vertices, const py::array& triangles,
                                const std::optional<Floats>& normals,
                                const std::optional<py::array>& normal_indices,
                                const std::optional<Floats>& uv, const Vec3& inside_vector) {
  auto mesh = std::make_shared<Mesh>();
  mesh->vertices = vector_rows(vertices, "vertices");
  const Indices corners = index_rows(triangles, mesh->vertices.size(), "triangles");
  const auto count = static_cast<std::size_t>(corners.shape(0));
  mesh->triangles.resize(count);
  set_rows(*mesh, &Mesh::Triangle::vertex, corners);
  if (normals) {
    mesh->normals = vector_rows(*normals, "normals");
    const Indices rows = index_rows(normal_indices ? *normal_indices : triangles, mesh->normals.size(),
                                    normal_indices ? "normal_indices" : "normals");
    if (static_cast<std::size_t>(rows.shape(0)) != count)
      throw py::value_error("normal_indices: as many rows as triangles are wanted");
    set_rows(*mesh, &Mesh::Triangle::normal, rows);
  }
  if (uv) {
    check_shape(*uv, {static_cast<int>(mesh->vertices.size()), 2}, "uv");
    for (const Mesh::Triangle& triangle : mesh->triangles) {
      Mesh::Coordinates& coordinates = mesh->coordinates.emplace_back();
      for (int i = 0; i < 3; ++i)
        coordinates.corner[i] = {uv->at(triangle.vertex[i], 0), uv->at(triangle.vertex[i], 1)};
    }
  }
  mesh->inside_vector = inside_vector;
  return mesh;
}

/// What of a mesh's lists an array shows, without copying; it keeps the mesh alive.
template <class T>
py::array rows_of(const py::object& mesh, const T* first, std::size_t count, std::size_t bytes) {
  py::array_t<T> rows({static_cast<py::ssize_t>(count), py::ssize_t{3}},
                      {static_cast<py::ssize_t>(bytes), static_cast<py::ssize_t>(sizeof(T))}, first, mesh);
  rows.attr("setflags")(py::arg("write") = false);
  return rows;
}

void bind_mesh(py::module_& module) {
  py::class_<Mesh, std::shared_ptr<Mesh>>(
      module, "Mesh", "Triangles with shared vertices, of NumPy's arrays. Any number of objects may have it.")
      .def(py::init(&make_mesh), py::arg("vertices"), py::arg("triangles"), py::kw_only(),
           py::arg("normals") = py::none(), py::arg("normal_indices") = py::none(),
           py::arg("uv") = py::none(), py::arg("inside_vector") = Vec3(0),
           "vertices: (n, 3). triangles: (m, 3), indices of vertices. normals: (k, 3), for smooth surfaces; "
           "of the\n"
           "vertices, unless normal_indices, (m, 3), says otherwise. uv: (n, 2), surface coordinates of "
           "vertices.\n"
           "inside_vector: a direction by which points inside are found, for CSG.")
      .def_property_readonly(
          "vertices",
          [](const py::object& self) {
            const auto& rows = self.cast<const Mesh&>().vertices;
            return rows_of(self, rows.empty() ? nullptr : &rows[0].x, rows.size(), sizeof(Vec3f));
          },
          "(n, 3), read-only")
      .def_property_readonly(
          "triangles",
          [](const py::object& self) {
            const auto& rows = self.cast<const Mesh&>().triangles;
            return rows_of(self, rows.empty() ? nullptr : rows[0].vertex, rows.size(),
                           sizeof(Mesh::Triangle));
          },
          "(m, 3), read-only")
      .def("__repr__", [](const Mesh& self) {
        return "<celltrace.Mesh of " + std::to_string(self.vertices.size()) + " vertices and " +
               std::to_string(self.triangles.size()) + " triangles>";
      });
}

Transform transform_of(const Doubles& rows) {
  check_shape(rows, {4, 3}, "rows");
  Transform made;
  for (int i = 0; i < 4; ++i)
    made.rows[i] = {rows.at(i, 0), rows.at(i, 1), rows.at(i, 2)};
  return made;
}

py::array_t<double> rows_of(const Transform& transform) {
  py::array_t<double> rows({4, 3});
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j)
      rows.mutable_at(i, j) = transform.rows[i][j];
  return rows;
}

void bind_transform(py::module_& module) {
  py::class_<Transform>(
      module, "Transform",
      "An affine transformation as POV-Ray writes it: p times the first three rows, plus the\n"
      "fourth.")
      .def(py::init<>())
      .def(py::init(&transform_of), py::arg("rows"), "Of an array of shape (4, 3).")
      .def_static("translate", &Transform::translate, py::arg("offset"))
      .def_static("rotate", &Transform::rotate, py::arg("degrees"),
                  "About x, then y, then z, in degrees, left-handed.")
      .def_static("scale", &Transform::scale, py::arg("factors"))
      .def("then", &Transform::then, py::arg("next"), "First this one, then the next.")
      .def("inverse", &Transform::inverse)
      .def("point", &Transform::point, py::arg("point"), "Where it takes a point.")
      .def_property_readonly(
          "rows", [](const Transform& self) { return rows_of(self); }, "(4, 3)")
      .def(
          "__eq__",
          [](const Transform& self, const Transform& other) {
            return std::equal(self.rows, self.rows + 4, other.rows);
          },
          py::is_operator())
      .def("__repr__", [](const Transform& self) {
        return "Transform(" + py::repr(rows_of(self).attr("tolist")()).cast<std::string>() + ")";
      });
}

} // namespace

void bind_geometry(py::module_& module) {
  bind_transform(module);
  bind_mesh(module);
  bind_values<Sphere>(module, "Sphere", "A sphere.",
                      Fields<Sphere>().add("centre", &Sphere::centre, "").add("radius", &Sphere::radius, ""));
  bind_values<Plane>(module, "Plane", "Infinite; the side that the normal points away from is inside.",
                     Fields<Plane>()
                         .add("normal", &Plane::normal, "of any length")
                         .add("distance", &Plane::distance, "of the origin, along the normal"));
  bind_values<Disc>(module, "Disc", "Flat and round, with a hole.",
                    Fields<Disc>()
                        .add("centre", &Disc::centre, "")
                        .add("normal", &Disc::normal, "of any length")
                        .add("radius", &Disc::radius, "")
                        .add("hole_radius", &Disc::hole_radius, ""));
  bind_values<Box>(module, "Box", "From one corner to the opposite one.",
                   Fields<Box>()
                       .add(
                           "corner", [](Box& box) -> Vec3& { return box.corner[0]; }, "")
                       .add(
                           "opposite", [](Box& box) -> Vec3& { return box.corner[1]; }, ""));
  bind_values<Cylinder>(module, "Cylinder", "A cylinder between the middles of its ends.",
                        Fields<Cylinder>()
                            .add("base", &Cylinder::base, "")
                            .add("cap", &Cylinder::cap, "")
                            .add("radius", &Cylinder::radius, "")
                            .add("open", &Cylinder::open, "without the ends"));
  bind_values<Cone>(module, "Cone", "A cone, also cut off, between the middles of its ends.",
                    Fields<Cone>()
                        .add("base", &Cone::base, "")
                        .add("cap", &Cone::cap, "")
                        .add("base_radius", &Cone::base_radius, "")
                        .add("cap_radius", &Cone::cap_radius, "")
                        .add("open", &Cone::open, "without the ends"));
  bind_values<Torus>(
      module, "Torus", "A ring around the y axis.",
      Fields<Torus>()
          .add("major_radius", &Torus::major_radius, "from the centre to the middle of the tube")
          .add("minor_radius", &Torus::minor_radius, "of the tube"));
  bind_values<Quadric>(
      module, "Quadric",
      "Where square . (xx, yy, zz) + mixed . (xy, xz, yz) + linear . (x, y, z) + constant is 0.",
      Fields<Quadric>()
          .add("square", &Quadric::square, "")
          .add("mixed", &Quadric::mixed, "")
          .add("linear", &Quadric::linear, "")
          .add("constant", &Quadric::constant, ""));
  bind_values<Superellipsoid>(module, "Superellipsoid",
                              "Where (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) is 1, of exponents e and n.",
                              Fields<Superellipsoid>()
                                  .add("east_west", &Superellipsoid::east_west, "e")
                                  .add("north_south", &Superellipsoid::north_south, "n"));
  bind_values<Polygon>(module, "Polygon",
                       "Flat, of closed loops of points in one plane; a loop in another one is a hole.",
                       Fields<Polygon>().add("loops", &Polygon::loops, "lists of points"));
  // Declared before it is described: objects and CSG have each other.
  auto csg = Fields<Csg>().add("operation", &Csg::operation, "union, merge, intersection or difference");
  bind_values<Object>(
      module, "Object", "A shape, placed. Materials and interiors are indices of the scene's.",
      Fields<Object>()
          .add("shape", &Object::shape, "a shape, Mesh or Csg")
          .add("transform", &Object::transform, "")
          .add("material", &Object::material, "of a CSG: means nothing, its parts have their own")
          .add("interior", &Object::interior, "likewise")
          .add("no_shadow", &Object::no_shadow, "")
          .add("no_image", &Object::no_image, "seen in mirrors alone")
          .add("no_reflection", &Object::no_reflection, "seen in no mirror")
          .add("is_hidden", &Object::is_hidden, "neither seen nor in the way of light")
          .add("inverse", &Object::inverse, "inside and outside change places")
          .add("is_lit_through", &Object::is_lit_through, "light on the other side counts, too"));
  bind_values<Csg>(module, "Csg", "Constructive solid geometry, of objects.",
                   csg.add("parts", &Csg::parts, "objects, placed in the space of the CSG"));
}

} // namespace celltrace
