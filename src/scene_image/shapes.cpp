#include "scene_image/shapes.hpp"

#include "celltrace/error.hpp"
#include "geometry/basis.hpp"
#include "geometry/polygons.hpp"
#include "geometry/shape_geometry.hpp"
#include "geometry/data_shapes.hpp"
#include "kernel/accel/object_bounds.hpp"
#include "scene_image/record_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace celltrace {

void write_map(const Transform& map, float (&to)[12]) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      to[row * 4 + column] = static_cast<float>(map.rows[column][row]);
}

namespace {

using namespace kernel;

/// Returns the factor by which a transformation scales everything, or 0 if it does not scale all directions
/// alike.
double uniform_scale(const Transform& t) {
  const double x = glm::length(t.rows[0]);
  const double y = glm::length(t.rows[1]);
  const double z = glm::length(t.rows[2]);
  const double tolerance = 1e-9 * x * x;
  const bool round = std::abs(x - y) <= 1e-9 * x && std::abs(x - z) <= 1e-9 * x &&
                     std::abs(glm::dot(t.rows[0], t.rows[1])) <= tolerance &&
                     std::abs(glm::dot(t.rows[0], t.rows[2])) <= tolerance &&
                     std::abs(glm::dot(t.rows[1], t.rows[2])) <= tolerance;
  return round ? x : 0;
}

Vec3 unit(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : Vec3(0, 1, 0);
}

/// Returns a shape of kind P whose own space `from_own` maps to the object's space.
template <class P> PlacedShape in_own_space(const Object& object, const Transform& from_own) {
  PlacedShape shape;
  shape.kind_and_flags = kPrimitiveKind<P>;
  shape.has_parameters = P::kHasParameters;
  shape.is_bounded = P::kIsBounded;
  write_map(from_own.then(object.transform).inverse(), shape.geometry);
  return shape;
}

PlacedShape nothing() {
  PlacedShape shape;
  shape.is_empty = true;
  return shape;
}

/// Sets the lengths in the world of the first two axes of a box or a cylinder, relative to the third. A shape
/// that is about as thick as it is long needs no such parameters.
void set_proportions(PlacedShape& shape, const Transform& to_world) {
  constexpr double kThin = 100;
  double axis[3];
  for (int i = 0; i < 3; ++i)
    axis[i] = glm::length(to_world.rows[i]);
  if (*std::max_element(axis, axis + 3) <= kThin * *std::min_element(axis, axis + 3)) return;
  shape.has_parameters = true;
  for (int i = 0; i < 2; ++i)
    shape.parameters[i] = static_cast<float>(axis[i] / axis[2] - 1);
}

/// Returns the transformation from the space in which a round shape has height and radius 1: its z axis goes
/// from `base` to `cap`, and its other axes have length `radius`.
Transform along_axis(const Vec3& base, const Vec3& cap, double radius) {
  Transform t;
  complete_basis(unit(cap - base), t.rows[0], t.rows[1]);
  t.rows[0] *= radius;
  t.rows[1] *= radius;
  t.rows[2] = cap - base;
  t.rows[3] = base;
  return t;
}

// One overload of place() for each shape. Spheres that a transformation leaves round stay spheres.

PlacedShape place(const Object& object, const Sphere& sphere) {
  const double radius = std::abs(sphere.radius);
  if (radius == 0) return nothing();
  const double scale = object.transform.is_identity() ? 1 : uniform_scale(object.transform);
  if (scale > 0) {
    PlacedShape shape;
    shape.kind_and_flags = kPrimitiveKind<SpherePrimitive>;
    copy(object.transform.point(sphere.centre), shape.geometry);
    shape.geometry[3] = static_cast<float>(radius * scale);
    const Vec3(&axes)[4] = object.transform.rows;
    copy(axes[0] / scale, shape.geometry + 4);
    copy(axes[1] / scale, shape.geometry + 7);
    shape.geometry[10] = glm::dot(glm::cross(axes[0], axes[1]), axes[2]) > 0 ? 1.0f : -1.0f;
    return shape;
  }
  PlacedShape shape = in_own_space<EllipsoidPrimitive>(object, Transform());
  const Transform inverse = object.transform.inverse();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      const double value = inverse.rows[column][row] - (column == 3 ? sphere.centre[row] : 0);
      shape.geometry[row * 4 + column] = static_cast<float>(value / radius);
    }
  return shape;
}

PlacedShape place(const Object& object, const Plane& plane) {
  Transform own;
  own.rows[2] = unit(plane.normal);
  complete_basis(own.rows[2], own.rows[0], own.rows[1]);
  own.rows[3] = own.rows[2] * plane.distance;
  PlacedShape shape = in_own_space<PlanePrimitive>(object, own);
  // Distances from the plane are in the world's units, whatever the transformation scales.
  const Vec3 normal = object.transform.normal(unit(plane.normal));
  const double length = glm::length(normal);
  if (length > 0) {
    const Vec3 n = normal / length;
    const double d = glm::dot(n, object.transform.point(own.rows[3]));
    copy(n, shape.geometry + 8);
    shape.geometry[11] = static_cast<float>(-d);
  }
  return shape;
}

PlacedShape place(const Object& object, const Disc& disc) {
  // An edge as far away as this is never visible, and single precision can hold its square.
  constexpr double kFarthestEdge = 1e12;
  if (disc.radius == 0 || std::abs(disc.hole_radius) >= std::abs(disc.radius)) return nothing();
  const double radius = std::min(std::abs(disc.radius), kFarthestEdge);
  Transform own;
  const Vec3 normal = unit(disc.normal);
  complete_basis(normal, own.rows[0], own.rows[1]);
  own.rows[0] *= radius;
  own.rows[1] *= radius;
  own.rows[2] = normal * radius;
  own.rows[3] = disc.centre;
  PlacedShape shape = in_own_space<DiscPrimitive>(object, own);
  shape.parameters[0] = static_cast<float>(std::abs(disc.hole_radius) / radius);
  return shape;
}

PlacedShape place(const Object& object, const Box& box) {
  if (box.corner[0] == box.corner[1]) return nothing();
  Vec3 low = glm::min(box.corner[0], box.corner[1]), high = glm::max(box.corner[0], box.corner[1]);
  Vec3 scale, middle(0);
  for (int i = 0; i < 3; ++i)
    scale[i] = glm::length(object.transform.rows[i]);
  constexpr double kFarthest = 1e12; // up to here, double precision is exact to less than a unit
  const double away = glm::length(object.transform.rows[3]);
  if (away > double{kMaxHitDistance} && away < kFarthest) middle = object.transform.inverse().point(Vec3(0));
  for (int i = 0; i < 3; ++i) {
    // Clamps sides that no ray reaches, since they would take precision from the opposite side.
    const double reach = 2 * double{kMaxHitDistance} / scale[i];
    low[i] = glm::clamp(low[i], middle[i] - reach, middle[i] + reach);
    high[i] = glm::clamp(high[i], middle[i] - reach, middle[i] + reach);
  }
  const Vec3 half = 0.5 * (high - low);
  const double largest = std::max({half.x, half.y, half.z});
  Transform own;
  for (int i = 0; i < 3; ++i) {
    // A flat box becomes slightly thick, since both of its sides may be seen.
    const double least = half[i] == 0 ? std::min(1e-6 * largest, 1e-4 / scale[i]) : 1e-12 * largest;
    own.rows[i][i] = std::max(half[i], least);
  }
  own.rows[3] = 0.5 * (low + high);
  PlacedShape shape = in_own_space<BoxPrimitive>(object, own);
  set_proportions(shape, own.then(object.transform));
  return shape;
}

PlacedShape place(const Object& object, const Cylinder& cylinder) {
  if (cylinder.radius == 0 || cylinder.base == cylinder.cap) return nothing();
  const Transform own = along_axis(cylinder.base, cylinder.cap, std::abs(cylinder.radius));
  PlacedShape shape = in_own_space<CylinderPrimitive>(object, own);
  if (cylinder.open) shape.kind_and_flags |= object_flag::open;
  set_proportions(shape, own.then(object.transform));
  return shape;
}

PlacedShape place(const Object& object, const Cone& cone) {
  double small = std::abs(cone.base_radius), large = std::abs(cone.cap_radius);
  Vec3 from = cone.base, to = cone.cap;
  if (small > large) {
    std::swap(small, large);
    std::swap(from, to);
  }
  if (small == large) return place(object, Cylinder{cone.base, cone.cap, large, cone.open});
  if (from == to) return nothing();
  PlacedShape shape = in_own_space<ConePrimitive>(object, along_axis(from, to, large));
  shape.parameters[0] = static_cast<float>(small / large);
  shape.parameters[1] = static_cast<float>((large - small) / large);
  if (cone.open) shape.kind_and_flags |= object_flag::open;
  return shape;
}

PlacedShape place(const Object& object, const Torus& torus) {
  const double major = std::abs(torus.major_radius), minor = std::abs(torus.minor_radius);
  if (minor == 0) return nothing();
  if (major == 0) return place(object, Sphere{Vec3(0), minor});
  Transform own;
  own.rows[0] = Vec3(0, 0, major);
  own.rows[1] = Vec3(major, 0, 0);
  own.rows[2] = Vec3(0, major, 0);
  PlacedShape shape = in_own_space<TorusPrimitive>(object, own);
  shape.parameters[0] = static_cast<float>(minor / major);
  return shape;
}

/// Makes a symmetric matrix diagonal, by Jacobi rotations, and sets `axes` to the directions that become
/// axes. The diagonal then has the factors of the squares along these axes.
void diagonalise(double (&m)[3][3], Vec3 (&axes)[3]) {
  for (int i = 0; i < 3; ++i)
    axes[i] = Vec3(i == 0, i == 1, i == 2);
  for (int turn = 0; turn < 48; ++turn) {
    const int p = turn % 3 == 2 ? 1 : 0, q = turn % 3 == 0 ? 1 : 2;
    if (m[p][q] == 0) continue;
    const double angle = 0.5 * std::atan2(2 * m[p][q], m[q][q] - m[p][p]);
    const double c = std::cos(angle), s = std::sin(angle);
    for (int i = 0; i < 3; ++i) {
      const double a = m[i][p], b = m[i][q];
      m[i][p] = c * a - s * b;
      m[i][q] = s * a + c * b;
    }
    for (int i = 0; i < 3; ++i) {
      const double a = m[p][i], b = m[q][i];
      m[p][i] = c * a - s * b;
      m[q][i] = s * a + c * b;
    }
    const Vec3 first = axes[p];
    axes[p] = c * first - s * axes[q];
    axes[q] = s * first + c * axes[q];
  }
}

struct CurvedAxis {
  Vec3 direction;
  double square; ///< factor of the square of the coordinate along the axis
};

/// Returns an ellipsoid that goes through (0, 0, 0), in a space with this point as its origin, so that no
/// digits are lost however large the ellipsoid is. In this space it is a sphere of diameter 1 below the
/// origin.
PlacedShape place_about_surface(const Object& object, const std::vector<CurvedAxis>& axes,
                                const Vec3& linear) {
  // If all squares have equal factors, the z axis of this space points out of the ellipsoid.
  Vec3 out(0), across[2];
  for (int i = 0; i < 3; ++i)
    out[i] = glm::dot(linear, axes[i].direction) / std::sqrt(axes[i].square);
  const double diameter = glm::length(out);
  out /= diameter;
  complete_basis(out, across[0], across[1]);
  const Vec3 rows[3] = {across[0], across[1], out};
  Transform own;
  for (int row = 0; row < 3; ++row) {
    own.rows[row] = Vec3(0);
    for (int i = 0; i < 3; ++i)
      own.rows[row] += axes[i].direction * (rows[row][i] * diameter / std::sqrt(axes[i].square));
  }
  PlacedShape shape = in_own_space<QuadricPrimitive>(object, own);
  shape.parameters[0] = QuadricPrimitive::code(1, 1, 1, 1, 0);
  return shape;
}

/// Returns a quadric in a space with the quadric's own axes, in which its squares have factors of 1, 0 or -1.
PlacedShape place(const Object& object, const Quadric& quadric) {
  double m[3][3] = {{quadric.square.x, quadric.mixed.x / 2, quadric.mixed.y / 2},
                    {quadric.mixed.x / 2, quadric.square.y, quadric.mixed.z / 2},
                    {quadric.mixed.y / 2, quadric.mixed.z / 2, quadric.square.z}};
  Vec3 axes[3];
  diagonalise(m, axes);
  const double largest = std::max({std::abs(m[0][0]), std::abs(m[1][1]), std::abs(m[2][2])});
  // Axes whose squares have factors are curved, and come first. The middle along a curved axis is where the
  // linear term vanishes.
  std::vector<CurvedAxis> curved, straight;
  for (int i = 0; i < 3; ++i)
    (std::abs(m[i][i]) > 1e-9 * largest ? curved : straight).push_back({axes[i], m[i][i]});
  const bool is_ellipsoid =
      std::all_of(curved.begin(), curved.end(), [](const CurvedAxis& axis) { return axis.square > 0; });
  if (curved.size() == 3 && is_ellipsoid && quadric.constant == 0 && quadric.linear != Vec3(0))
    return place_about_surface(object, curved, quadric.linear);
  Vec3 middle(0), linear = quadric.linear;
  double constant = quadric.constant;
  for (const CurvedAxis& axis : curved) {
    const double along = glm::dot(quadric.linear, axis.direction);
    middle -= axis.direction * (along / (2 * axis.square));
    constant -= along * along / (4 * axis.square);
    linear -= axis.direction * along;
  }
  const double slope = straight.empty() ? 0 : glm::length(linear);
  const bool has_slope = slope > 1e-9 * std::max(largest, glm::length(quadric.linear));
  if (has_slope) {
    const Vec3 up = linear / slope;
    if (straight.size() == 3) complete_basis(up, straight[0].direction, straight[1].direction);
    if (straight.size() == 2) straight[0].direction = glm::cross(curved[0].direction, up);
    straight.back().direction = up;
    middle -= up * (constant / slope);
    constant = 0;
  } else if (curved.empty() || std::abs(constant) <= 1e-12 * largest) {
    if (curved.empty()) return nothing();
    constant = 0;
  }
  const double unit = has_slope ? slope : constant != 0 ? std::abs(constant) : largest;
  Transform own;
  int factors[3] = {0, 0, 0};
  int next = 0;
  for (const CurvedAxis& axis : curved) {
    own.rows[next] = axis.direction * std::sqrt(unit / std::abs(axis.square));
    factors[next++] = axis.square > 0 ? 1 : -1;
  }
  for (const CurvedAxis& axis : straight)
    own.rows[next++] = axis.direction;
  own.rows[3] = middle;
  const int sign = constant > 0 ? 1 : constant < 0 ? -1 : 0;
  if (factors[0] + factors[1] + factors[2] == 3 && sign < 0) {
    PlacedShape ellipsoid = in_own_space<EllipsoidPrimitive>(object, own);
    ellipsoid.kind_and_flags |= object_flag::flat_map;
    return ellipsoid;
  }
  PlacedShape shape = in_own_space<QuadricPrimitive>(object, own);
  shape.parameters[0] = QuadricPrimitive::code(factors[0], factors[1], factors[2], has_slope, sign);
  return shape;
}

PlacedShape place(const Object& object, const Superellipsoid& s) {
  PlacedShape shape = in_own_space<SuperellipsoidPrimitive>(object, Transform());
  const auto [across, along] = geometry::powers_of(s);
  shape.parameters[0] = static_cast<float>(across);
  shape.parameters[1] = static_cast<float>(along);
  return shape;
}

PlacedShape place(const Object& object, const std::shared_ptr<const Polygon>& polygon) {
  const std::optional<Transform> frame = frame_of(*polygon);
  return frame ? in_own_space<PolygonPrimitive>(object, *frame) : nothing();
}

PlacedShape place(const Object& object, const std::shared_ptr<const Polynomial>&) {
  return in_own_space<PolynomialPrimitive>(object, Transform());
}
PlacedShape place(const Object& object, const std::shared_ptr<const Prism>& prism) {
  const std::optional<Transform> frame = frame_of(*prism);
  if (!frame) return nothing();
  PlacedShape shape = in_own_space<PrismPrimitive>(object, *frame);
  shape.parameters[0] = lower_end_of(*prism);
  return shape;
}
PlacedShape place(const Object& object, const std::shared_ptr<const Lathe>& lathe) {
  const std::optional<Transform> frame = frame_of(*lathe);
  return frame ? in_own_space<LathePrimitive>(object, *frame) : nothing();
}
PlacedShape place(const Object& object, const std::shared_ptr<const SurfaceOfRevolution>& sor) {
  const std::optional<Transform> frame = frame_of(*sor);
  return frame ? in_own_space<SorPrimitive>(object, *frame) : nothing();
}
PlacedShape place(const Object& object, const std::shared_ptr<const Blob>& blob) {
  const std::optional<Transform> frame = frame_of(*blob);
  return frame ? in_own_space<BlobPrimitive>(object, *frame) : nothing();
}

PlacedShape place(const Object&, const std::shared_ptr<const Mesh>&) {
  return nothing();
}
PlacedShape place(const Object&, const std::shared_ptr<const Csg>&) {
  return nothing();
}

// The numbers of each shape, for validate_shape().

std::vector<double> numbers(std::initializer_list<Vec3> vectors, std::initializer_list<double> scalars) {
  std::vector<double> all(scalars);
  for (const Vec3& v : vectors)
    all.insert(all.end(), {v.x, v.y, v.z});
  return all;
}
std::vector<double> numbers_of(const Sphere& s) {
  return numbers({s.centre}, {s.radius});
}
std::vector<double> numbers_of(const Plane& p) {
  return numbers({p.normal}, {p.distance});
}
std::vector<double> numbers_of(const Disc& d) {
  return numbers({d.centre, d.normal}, {d.radius, d.hole_radius});
}
std::vector<double> numbers_of(const Box& b) {
  return numbers({b.corner[0], b.corner[1]}, {});
}
std::vector<double> numbers_of(const Cylinder& c) {
  return numbers({c.base, c.cap}, {c.radius});
}
std::vector<double> numbers_of(const Cone& c) {
  return numbers({c.base, c.cap}, {c.base_radius, c.cap_radius});
}
std::vector<double> numbers_of(const Torus& t) {
  return numbers({}, {t.major_radius, t.minor_radius});
}
std::vector<double> numbers_of(const Quadric& q) {
  return numbers({q.square, q.mixed, q.linear}, {q.constant});
}
std::vector<double> numbers_of(const Superellipsoid& s) {
  return numbers({}, {s.east_west, s.north_south});
}
std::vector<double> numbers_of(const std::shared_ptr<const Polygon>& polygon) {
  std::vector<double> all;
  for (const std::vector<Vec3>& loop : polygon->loops)
    for (const Vec3& point : loop)
      all.insert(all.end(), {point.x, point.y, point.z});
  return all;
}
std::vector<double> numbers_of(const std::shared_ptr<const Polynomial>& polynomial) {
  return polynomial->coefficients;
}
void add_curve(const std::vector<CurveSegment>& curve, std::vector<double>& all) {
  for (const CurveSegment& segment : curve) {
    all.insert(all.end(), segment.x.begin(), segment.x.end());
    all.insert(all.end(), segment.y.begin(), segment.y.end());
  }
}
std::vector<double> numbers_of(const std::shared_ptr<const Prism>& prism) {
  std::vector<double> all = {prism->bottom, prism->top};
  add_curve(prism->outline, all);
  return all;
}
std::vector<double> numbers_of(const std::shared_ptr<const Lathe>& lathe) {
  std::vector<double> all;
  add_curve(lathe->curve, all);
  return all;
}
std::vector<double> numbers_of(const std::shared_ptr<const SurfaceOfRevolution>& sor) {
  std::vector<double> all;
  for (const SurfaceOfRevolution::Piece& piece : sor->pieces) {
    all.insert(all.end(), {piece.low, piece.high});
    all.insert(all.end(), piece.square.begin(), piece.square.end());
  }
  return all;
}
std::vector<double> numbers_of(const std::shared_ptr<const Blob>& blob) {
  std::vector<double> all = {blob->threshold};
  for (const Blob::Component& c : blob->components) {
    const std::vector<double> own = numbers({c.a, c.b, c.transform.rows[0], c.transform.rows[1],
                                             c.transform.rows[2], c.transform.rows[3]},
                                            {c.radius, c.strength});
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}
std::vector<double> numbers_of(const std::shared_ptr<const Mesh>&) {
  return {};
}
std::vector<double> numbers_of(const std::shared_ptr<const Csg>&) {
  return {};
}

} // namespace

kernel::Aabb PlacedShape::bounds() const {
  ObjectRecord record{};
  record.kind_and_flags = kind_and_flags;
  std::copy(geometry, geometry + 12, record.geometry);
  ExtraRecord extra{};
  std::copy(parameters, parameters + 2, extra.value);
  return bounding_box(record, extra);
}

PlacedShape place_shape(const Object& object) {
  return std::visit([&](const auto& shape) { return place(object, shape); }, object.shape);
}

bool has_boundary(const PlacedShape& shape) {
  const std::uint32_t kind = shape.kind_and_flags & object_flag::kind_mask;
  return !shape.is_empty &&
         (kind == kPrimitiveKind<CylinderPrimitive> || kind == kPrimitiveKind<ConePrimitive> ||
          kind == kPrimitiveKind<PlanePrimitive> || kind == kPrimitiveKind<BoxPrimitive>);
}

PlacedShape with_boundary(const PlacedShape& shape, const Eye& eye) {
  if (!has_boundary(shape)) return shape;
  const std::uint32_t kind = shape.kind_and_flags & object_flag::kind_mask;
  const bool is_round = kind == kPrimitiveKind<CylinderPrimitive> || kind == kPrimitiveKind<ConePrimitive>;
  // The error of a point grows with its coordinates and with those of the ray's origin. Objects farther away
  // than `far_away` are so small in the picture that their boundary does not matter.
  const Vec3 start = eye.start_of_boundaries();
  const double far_away = 100 + 4 * glm::length(start);
  Vec3 reach = glm::abs(start);
  if (shape.is_bounded) {
    const kernel::Aabb box = shape.bounds();
    for (int i = 0; i < 3; ++i)
      reach[i] += std::min<double>(std::max(std::abs(box.min[i]), std::abs(box.max[i])), far_away);
  }
  PlacedShape solid = shape;
  float* const map = solid.geometry;
  const auto error = [&](int row) { // error of a coordinate in the shape's own space
    constexpr double kRounding = 4e-7;
    double sum = std::abs(map[row * 4 + 3]);
    for (int i = 0; i < 3; ++i)
      sum += std::abs(map[row * 4 + i]) * reach[i];
    return sum * kRounding;
  };
  const auto scale = [&](int row, double factor) {
    for (int i = 0; i < 4; ++i)
      map[row * 4 + i] = static_cast<float>(map[row * 4 + i] * factor);
  };
  const double errors[3] = {error(0), error(1), error(2)};
  const double across = std::max(errors[0], errors[1]), along = std::min(errors[2], 0.25);
  if (kind == kPrimitiveKind<PlanePrimitive>) {
    map[11] = static_cast<float>(map[11] - errors[2]);
  } else if (kind == kPrimitiveKind<BoxPrimitive>) {
    for (int row = 0; row < 3; ++row)
      scale(row, 1 / (1 + errors[row]));
  } else if (is_round) {
    // An error along a cone's axis also changes its radius. Open shapes become larger, because their boundary
    // is inside.
    const double sign = (shape.kind_and_flags & object_flag::open) != 0 ? -1 : 1;
    const double narrower =
        sign * std::min(across + (kind == kPrimitiveKind<ConePrimitive> ? 2 * along : 0), 0.5);
    scale(0, 1 + narrower);
    scale(1, 1 + narrower);
    map[11] = static_cast<float>(map[11] - sign * along);
    scale(2, 1 / (1 - sign * 2 * along));
  }
  return solid;
}

bool has_bounds(const Object& object) {
  // Most kinds of shapes always have bounds, so that there is no need to place the shape.
  if (std::holds_alternative<Plane>(object.shape) ||
      std::holds_alternative<std::shared_ptr<const Polynomial>>(object.shape))
    return false;
  return !std::holds_alternative<Quadric>(object.shape) || place_shape(object).is_bounded;
}

void validate_shape(const Object& object, const std::string& name) {
  const std::vector<double> all =
      std::visit([](const auto& shape) { return numbers_of(shape); }, object.shape);
  if (!std::all_of(all.begin(), all.end(), [](double x) { return std::isfinite(x); }))
    throw InputError(name + " has a number that is not finite");
}

} // namespace celltrace
