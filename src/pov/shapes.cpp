#include "pov/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "pov/session.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

namespace {

/// Lengths below this count as zero, as in POV-Ray.
constexpr double kShortest = 1e-10;

struct Parameter {
  const char* name = nullptr;
  bool is_vector = false;
  bool is_optional = false;
};

constexpr Parameter vector(const char* name) {
  return {name, true, false};
}
constexpr Parameter number(const char* name) {
  return {name, false, false};
}
constexpr Parameter optional_number(const char* name) {
  return {name, false, true};
}

/// The arguments of a shape, whose number and types have been checked.
class Arguments {
public:
  Arguments(Session& session, const WrittenShape& written) : session_(session), written_(written) {}

  Vec3 vector(std::size_t i) const { return session_.vector(at(i).value, at(i).where); }
  Vec3 corner(std::size_t i) const { return session_.corner(at(i).value, at(i).where); }
  double number(std::size_t i) const { return session_.number(at(i).value, at(i).where); }
  double number_or(std::size_t i, double otherwise) const {
    return i < written_.arguments.size() ? number(i) : otherwise;
  }
  std::size_t count() const { return written_.arguments.size(); }
  bool is_open() const { return written_.is_open; }
  bool is_conic() const { return written_.is_conic; }
  CurveKind curve() const { return written_.curve.value_or(CurveKind::linear); }
  /// Returns the points from argument `first` on, which have to be as many as argument `count` says.
  CurvePoints points(std::size_t first, const char* shape) const {
    const std::size_t given = written_.arguments.size() - first;
    if (static_cast<double>(given) != std::floor(number(first - 1)))
      session_.fail(written_.where, std::string("this ") + shape + " does not have as many points as it says");
    CurvePoints points;
    for (std::size_t i = first; i < written_.arguments.size(); ++i)
      points.emplace_back(vector(i).x, vector(i).y);
    return points;
  }
  CurveFails fails() const {
    return [this](const std::string& what) { session_.fail(written_.where, what); };
  }
  void require(bool condition, const char* what) const {
    if (!condition) session_.fail(written_.where, what);
  }
  void warn(const char* what) const { session_.diagnostics.warn_once(written_.where, what); }

private:
  const ShapeArgument& at(std::size_t i) const { return written_.arguments[i]; }

  Session& session_;
  const WrittenShape& written_;
};

Shape read_box(const Arguments& a) {
  return Box{{a.corner(0), a.corner(1)}};
}

Shape read_cone(const Arguments& a) {
  const Cone cone{a.vector(0), a.vector(2), a.number(1), a.number(3), a.is_open()};
  a.require(glm::distance(cone.base, cone.cap) >= kShortest, "this cone's ends are the same point");
  return cone;
}

Shape read_cylinder(const Arguments& a) {
  const Cylinder cylinder{a.vector(0), a.vector(1), a.number(2), a.is_open()};
  a.require(glm::distance(cylinder.base, cylinder.cap) >= kShortest,
            "this cylinder's ends are the same point");
  return cylinder;
}

Shape read_disc(const Arguments& a) {
  Disc disc{a.vector(0), a.vector(1), a.number(2), a.number_or(3, 0)};
  if (glm::length(disc.normal) == 0) disc.radius = 0; // makes no ray hit it
  return disc;
}

Shape read_plane(const Arguments& a) {
  const Plane plane{a.vector(0), a.number(1)};
  a.require(glm::length(plane.normal) >= kShortest, "this plane's normal has no direction");
  return plane;
}

/// The largest distance of points from a polygon's plane, and of the two ends of a loop from each other.
constexpr double kNearPoint = 1e-10;

/// Returns whether POV-Ray shows a polygon of these points: none whose corners are nearly on a line, or that
/// is not flat.
bool is_shown(const std::vector<Vec3>& points) {
  constexpr double kLeastCorner = 1e-10;
  const Vec3 start = points.front();
  const Vec3 side = *std::max_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
    return glm::distance(a, start) < glm::distance(b, start);
  }) - start;
  for (const Vec3& point : points) {
    const Vec3 across = glm::cross(side, point - start);
    if (glm::dot(across, across) < kLeastCorner) continue;
    const Vec3 normal = glm::normalize(across);
    return std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
      // Compares with more than the rounding error.
      return std::abs(glm::dot(p - start, normal)) <= kNearPoint + 1e-15 * glm::length(p - start);
    });
  }
  return false;
}

/// Returns a polygon; a loop ends where it returns to its first point.
Shape read_polygon(const Arguments& a) {
  a.require(a.number(0) >= 3, "a polygon has at least three points");
  a.require(static_cast<double>(a.count() - 1) == std::floor(a.number(0)),
            "this polygon does not have as many points as it says");
  std::vector<Vec3> points;
  for (std::size_t i = 1; i < a.count(); ++i)
    points.push_back(a.vector(i));
  auto polygon = std::make_shared<Polygon>();
  if (!is_shown(points)) return std::shared_ptr<const Polygon>(polygon);
  const auto is_same = [](const Vec3& p, const Vec3& q) {
    const Vec3 apart = glm::abs(p - q);
    return apart.x < kNearPoint && apart.y < kNearPoint && apart.z < kNearPoint;
  };
  bool is_closed = true;
  for (const Vec3& point : points) {
    if (is_closed) {
      polygon->loops.push_back({point});
      is_closed = false;
    } else if (is_same(point, polygon->loops.back().front())) {
      is_closed = true;
    } else {
      polygon->loops.back().push_back(point);
    }
  }
  if (!is_closed) a.warn("this polygon does not come back to the point where its last loop begins");
  return std::shared_ptr<const Polygon>(polygon);
}

Shape read_lathe(const Arguments& a) {
  auto lathe = std::make_shared<Lathe>();
  lathe->curve = lathe_curve(a.curve(), a.points(1, "lathe"), a.fails());
  return std::shared_ptr<const Lathe>(lathe);
}

Shape read_prism(const Arguments& a) {
  auto prism = std::make_shared<Prism>();
  prism->bottom = std::min(a.number(0), a.number(1));
  prism->top = std::max(a.number(0), a.number(1));
  prism->is_conic = a.is_conic();
  prism->open = a.is_open();
  prism->outline = prism_outline(a.curve(), a.points(3, "prism"), a.fails(), [&](const char* what) { a.warn(what); });
  if (prism->outline.empty()) return Sphere{{0, 0, 0}, 0};
  return std::shared_ptr<const Prism>(prism);
}

Shape read_sor(const Arguments& a) {
  auto sor = std::make_shared<SurfaceOfRevolution>();
  sor->open = a.is_open();
  sor->pieces = sor_pieces(a.points(1, "sor"), a.fails());
  return std::shared_ptr<const SurfaceOfRevolution>(sor);
}

Shape read_quadric(const Arguments& a) {
  return Quadric{a.vector(0), a.vector(1), a.vector(2), a.number(3)};
}

Shape read_sphere(const Arguments& a) {
  return Sphere{a.vector(0), a.number(1)};
}

Shape read_superellipsoid(const Arguments& a) {
  const Vec3 exponents = a.vector(0);
  if (exponents.y < 0) {
    a.warn("there is nothing to see of a superellipsoid whose second exponent is negative");
    return Sphere{{0, 0, 0}, 0};
  }
  a.require(exponents.x >= 0, "a superellipsoid's first exponent must not be negative");
  return Superellipsoid{exponents.x, exponents.y};
}

Shape read_torus(const Arguments& a) {
  return Torus{a.number(0), a.number(1)};
}

constexpr std::size_t kMostParameters = 4;
constexpr bool kCanBeOpen = true;
constexpr bool kHasCurve = true;

struct ShapeForm {
  const char* name;
  Parameter parameters[kMostParameters]; ///< optional ones come last
  Shape (*read)(const Arguments&);
  bool can_be_open = false;
  const char* vectors = nullptr; ///< name of further vectors, of which any number may follow
  bool has_curve = false;        ///< may begin with the kind of its curve
  bool is_swept = false;         ///< may begin with `linear_sweep` or `conic_sweep`

  std::size_t most() const {
    return static_cast<std::size_t>(
        std::count_if(parameters, parameters + kMostParameters, [](const Parameter& p) { return p.name; }));
  }
  std::size_t fewest() const {
    return static_cast<std::size_t>(
        std::count_if(parameters, parameters + kMostParameters,
                      [](const Parameter& p) { return p.name && !p.is_optional; }));
  }
};

constexpr ShapeForm kShapes[] = {
    {"box", {vector("corner"), vector("corner")}, read_box},
    {"cone", {vector("base"), number("radius"), vector("cap"), number("radius")}, read_cone, kCanBeOpen},
    {"cylinder", {vector("base"), vector("cap"), number("radius")}, read_cylinder, kCanBeOpen},
    {"disc",
     {vector("centre"), vector("normal"), number("radius"), optional_number("hole radius")},
     read_disc},
    {"lathe", {number("count")}, read_lathe, false, "point", kHasCurve},
    {"plane", {vector("normal"), number("distance")}, read_plane},
    {"polygon", {number("count")}, read_polygon, false, "point"},
    {"prism",
     {number("height"), number("height"), number("count")},
     read_prism,
     kCanBeOpen,
     "point",
     kHasCurve,
     true},
    {"quadric", {vector("squares"), vector("products"), vector("linear"), number("constant")}, read_quadric},
    {"sor", {number("count")}, read_sor, kCanBeOpen, "point"},
    {"sphere", {vector("centre"), number("radius")}, read_sphere},
    {"superellipsoid", {vector("east-west, north-south")}, read_superellipsoid},
    {"torus", {number("major radius"), number("minor radius")}, read_torus},
};

/// Returns the syntax of the shape for messages.
std::string form(const ShapeForm& shape) {
  std::string text = std::string(shape.name) + " { ";
  for (std::size_t i = 0; i < shape.most(); ++i) {
    const Parameter& parameter = shape.parameters[i];
    const std::string name = parameter.is_vector ? '<' + std::string(parameter.name) + '>' : parameter.name;
    const std::string item = (i > 0 ? ", " : "") + name;
    text += parameter.is_optional ? '[' + item + ']' : item;
  }
  if (shape.vectors) text += ", <" + std::string(shape.vectors) + ">, ...";
  return text + (shape.can_be_open ? " [open] }" : " }");
}

[[noreturn]] void fail(const Session& session, const Location& where, const ShapeForm& shape,
                       const std::string& found) {
  session.fail(where, "expected '" + form(shape) + "', found " + found);
}

void check_arguments(const Session& session, const ShapeForm& shape, const WrittenShape& written) {
  const std::size_t count = written.arguments.size();
  if (count < shape.fewest() || (count > shape.most() && !shape.vectors))
    fail(session, written.where, shape, std::to_string(count) + (count == 1 ? " argument" : " arguments"));
  for (std::size_t i = 0; i < std::min(count, shape.most()); ++i) {
    const auto& [value, where] = written.arguments[i];
    const Parameter& parameter = shape.parameters[i];
    if (!parameter.is_vector && !value.is_float())
      fail(session, where, shape, std::string(kind_name(value)) + " as " + parameter.name);
  }
  // A comma may stand in front of an optional argument that is missing, but not after the last possible one.
  if (written.comma && count >= shape.most()) session.fail(*written.comma, "unexpected ','");
  if ((written.curve && !shape.has_curve) || (written.is_swept && !shape.is_swept))
    session.fail(written.where, std::string("a ") + shape.name + " does not begin with a kind of curve or sweep");
  if (written.is_open && !shape.can_be_open)
    session.fail(written.where, std::string("a ") + shape.name + " cannot be open");
}

/// Returns whether all numbers are finite; corners of boxes may be infinite.
bool is_somewhere(const ShapeForm& shape, const WrittenShape& written) {
  const bool has_corners = shape.read == read_box;
  return std::all_of(written.arguments.begin(), written.arguments.end(), [&](const ShapeArgument& argument) {
    const auto& v = argument.value.v;
    return argument.value.is_finite() ||
           (has_corners && std::none_of(v.begin(), v.end(), [](double c) { return std::isnan(c); }));
  });
}

} // namespace

bool has_option(int shape) {
  return kShapes[shape].fewest() != kShapes[shape].most();
}

std::vector<const char*> shape_names() {
  std::vector<const char*> names;
  std::transform(std::begin(kShapes), std::end(kShapes), std::back_inserter(names),
                 [](const ShapeForm& shape) { return shape.name; });
  return names;
}

bool is_complete(int shape, std::size_t count) {
  const ShapeForm& form = kShapes[shape];
  const bool takes_vector = count < form.most() ? form.parameters[count].is_vector : form.vectors != nullptr;
  return count >= form.fewest() && !takes_vector;
}

namespace {

/// Returns a component of a blob, as a blob of its own. Its strength may be its last argument.
Shape read_component(Session& session, WrittenShape written) {
  const ShapeForm& shape = kShapes[written.number];
  if (shape.read != read_sphere && shape.read != read_cylinder)
    session.fail(written.where, "a component of a blob is a sphere or a cylinder");
  Blob::Component component;
  if (written.arguments.size() == shape.most() + 1) {
    component.strength = session.number(written.arguments.back().value, written.arguments.back().where);
    written.arguments.pop_back();
  }
  check_arguments(session, shape, written);
  const Arguments a(session, written);
  component.a = a.vector(0);
  const bool is_ball = shape.read == read_sphere;
  component.b = is_ball ? component.a : a.vector(1);
  component.radius = a.number(is_ball ? 1 : 2);
  if (!is_ball)
    a.require(glm::distance(component.a, component.b) >= kShortest, "this cylinder's ends are the same point");
  a.require(component.radius > 0, "the radius of a blob's component is above 0");
  auto blob = std::make_shared<Blob>();
  blob->components.push_back(component);
  return std::shared_ptr<const Blob>(blob);
}

} // namespace

Shape read_shape(Session& session, const WrittenShape& written) {
  if (written.is_component) return read_component(session, written);
  const ShapeForm& shape = kShapes[written.number];
  check_arguments(session, shape, written);
  if (!is_somewhere(shape, written)) {
    session.diagnostics.warn_once(written.where,
                                  "there is nothing to see of this object: a number of it is not finite");
    return Sphere{{0, 0, 0}, 0};
  }
  return shape.read(Arguments(session, written));
}

bool is_invisible(const Shape& shape) {
  if (const Sphere* sphere = std::get_if<Sphere>(&shape)) return sphere->radius <= 0;
  if (const Torus* torus = std::get_if<Torus>(&shape))
    return torus->major_radius <= 0 || torus->minor_radius <= 0;
  return false;
}

} // namespace celltrace::pov
