// Binds places, shapes except meshes, and objects.
#include "python/arrays.hpp"
#include "python/bindings.hpp"
#include "python/misfit.hpp"

#include <algorithm>

namespace celltrace {

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

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
  py::class_<Transform> transform(
      module, "Transform",
      signed_doc("Transform", "rows=...",
                 "An affine transformation as POV-Ray writes it: p times the first three rows, plus the\n"
                 "fourth, of an array of shape (4, 3). Without rows it is the one that changes nothing.")
          .c_str());
  const auto def_static = [&](const char* name, const auto& function, const char* parameter,
                              const char* doc) {
    transform.def_static(name, function, py::arg(parameter), signed_doc(name, parameter, doc).c_str());
    add_misfit([&](auto... last) { transform.def_static(name, last...); }, {name, parameter});
  };
  def_static("translate", &Transform::translate, "offset", "Moves by an offset.");
  def_static("rotate", &Transform::rotate, "degrees", "About x, then y, then z, in degrees, left-handed.");
  def_static("scale", &Transform::scale, "factors", "A factor for each axis, or one for all.");
  bind_pickle<Transform>(transform);
  transform.def(py::init<>(), signed_init("rows=...").c_str())
      .def(py::init(&transform_of), py::arg("rows"))
      .def("then", &Transform::then, py::arg("next"),
           signed_doc("then", "$self, next", "First this one, then the next.").c_str())
      .def("inverse", &Transform::inverse,
           signed_doc("inverse", "$self", "The one that undoes it. Raises InputError if there is none.")
               .c_str())
      .def("point", &Transform::point, py::arg("point"),
           signed_doc("point", "$self, point", "Where it takes a point.").c_str())
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
  bind_values<Polynomial>(module, "Polynomial", "Where a polynomial of x, y and z is 0; inside where it is below.",
                          Fields<Polynomial>()
                              .add("degree", &Polynomial::degree, "2 to 35")
                              .add("coefficients", &Polynomial::coefficients,
                                   "of x^i y^j z^k, by falling i, then j, then k; the constant is last"));
  bind_values<CurveSegment>(module, "CurveSegment", "A piece of a plane curve, for w from 0 to 1.",
                            Fields<CurveSegment>()
                                .add("x", &CurveSegment::x, "four coefficients of the powers of w")
                                .add("y", &CurveSegment::y, "four coefficients of the powers of w"));
  bind_values<Prism>(module, "Prism", "A cross-section in x and z, from one height to another.",
                     Fields<Prism>()
                         .add("outline", &Prism::outline, "closed loops of CurveSegments")
                         .add("bottom", &Prism::bottom, "")
                         .add("top", &Prism::top, "")
                         .add("is_conic", &Prism::is_conic, "the cross-section grows with the height")
                         .add("open", &Prism::open, "without the ends"));
  bind_values<Lathe>(module, "Lathe", "A curve turned around the y axis.",
                     Fields<Lathe>().add("curve", &Lathe::curve, "CurveSegments; x is the distance from the axis"));
  bind_values<SurfaceOfRevolution::Piece>(
      module, "SorPiece", "A part of a SurfaceOfRevolution between two heights.",
      Fields<SurfaceOfRevolution::Piece>()
          .add("low", &SurfaceOfRevolution::Piece::low, "")
          .add("high", &SurfaceOfRevolution::Piece::high, "")
          .add("square", &SurfaceOfRevolution::Piece::square, "squared radius: coefficients of the powers of y"));
  bind_values<SurfaceOfRevolution>(module, "SurfaceOfRevolution", "A solid around the y axis, piece by piece.",
                                   Fields<SurfaceOfRevolution>()
                                       .add("pieces", &SurfaceOfRevolution::pieces, "SorPieces, from the lowest up")
                                       .add("open", &SurfaceOfRevolution::open, "without the ends"));
  bind_values<Blob::Component>(module, "BlobComponent", "A field around a point, or around a line.",
                               Fields<Blob::Component>()
                                   .add("a", &Blob::Component::a, "")
                                   .add("b", &Blob::Component::b, "equal to a for a point")
                                   .add("radius", &Blob::Component::radius, "")
                                   .add("strength", &Blob::Component::strength, "")
                                   .add("transform", &Blob::Component::transform, ""));
  bind_values<Blob>(module, "Blob", "Where fields add up to a threshold.",
                    Fields<Blob>()
                        .add("threshold", &Blob::threshold, "")
                        .add("components", &Blob::components, "BlobComponents"));
  // Declared before it is described, because objects and CSG refer to each other.
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
