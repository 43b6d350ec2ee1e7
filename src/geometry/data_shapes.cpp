#include "geometry/data_shapes.hpp"

#include "geometry/polynomial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace celltrace {

namespace {

/// Coefficients of the powers 0 to 3.
using Powers4 = std::array<double, 4>;

double at(const Powers4& c, double w) {
  return ((c[3] * w + c[2]) * w + c[1]) * w + c[0];
}
double slope_at(const Powers4& c, double w) {
  return (3 * c[3] * w + 2 * c[2]) * w + c[1];
}

/// Adds the values of a polynomial at both ends and at its extremes between them.
void widen(const Powers4& c, double& least, double& greatest) {
  const auto add = [&](double w) {
    if (!(w >= 0 && w <= 1)) return;
    least = std::min(least, at(c, w));
    greatest = std::max(greatest, at(c, w));
  };
  add(0);
  add(1);
  const double a = 3 * c[3], b = 2 * c[2];
  if (a == 0) {
    if (b != 0) add(-c[1] / b);
    return;
  }
  const double root = b * b - 4 * a * c[1];
  if (root < 0) return;
  for (const double sign : {-1.0, 1.0})
    add((-b + sign * std::sqrt(root)) / (2 * a));
}

Transform scaled_axes(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& origin) {
  Transform t;
  t.rows[0] = x;
  t.rows[1] = y;
  t.rows[2] = z;
  t.rows[3] = origin;
  return t;
}

/// Returns the box of a component's field.
Extent extent_of(const Blob::Component& component) {
  const Vec3* rows = component.transform.rows;
  Vec3 half;
  for (int i = 0; i < 3; ++i)
    half[i] = std::fabs(component.radius) * glm::length(Vec3(rows[0][i], rows[1][i], rows[2][i]));
  const Vec3 a = component.transform.point(component.a), b = component.transform.point(component.b);
  return {glm::min(a, b) - half, glm::max(a, b) + half};
}

double greatest_square(const SurfaceOfRevolution& sor) {
  double least = 0, greatest = 0;
  for (const SurfaceOfRevolution::Piece& piece : sor.pieces) {
    const double length = piece.high - piece.low;
    const auto& c = piece.square;
    const Powers4 shifted = {((c[3] * piece.low + c[2]) * piece.low + c[1]) * piece.low + c[0],
                               ((3 * c[3] * piece.low + 2 * c[2]) * piece.low + c[1]) * length,
                               (3 * c[3] * piece.low + c[2]) * length * length, c[3] * length * length * length};
    widen(shifted, least, greatest);
  }
  return greatest;
}

/// Returns the frame of a shape around the y axis; flat ones get some height.
std::optional<Transform> frame_around_y(double radius, double bottom, double top) {
  if (!(radius > 0)) return std::nullopt;
  const double height = top - bottom > 1e-6 * radius ? top - bottom : radius;
  return scaled_axes({radius, 0, 0}, {0, 0, radius}, {0, height, 0}, {0, bottom, 0});
}

} // namespace

CurveBounds CurveBounds::of(const CurveSegment& segment) {
  CurveBounds bounds{segment.x[0], segment.x[0], segment.y[0], segment.y[0]};
  widen(segment.x, bounds.min_x, bounds.max_x);
  widen(segment.y, bounds.min_y, bounds.max_y);
  return bounds;
}
CurveBounds CurveBounds::of(const std::vector<CurveSegment>& segments) {
  CurveBounds all = of(segments.front());
  for (const CurveSegment& segment : segments) {
    const CurveBounds b = of(segment);
    all = {std::min(all.min_x, b.min_x), std::max(all.max_x, b.max_x), std::min(all.min_y, b.min_y),
           std::max(all.max_y, b.max_y)};
  }
  return all;
}

int degree_of(const std::vector<CurveSegment>& segments) {
  int degree = 1;
  for (const CurveSegment& segment : segments)
    for (int k = 2; k <= 3; ++k)
      if (segment.x[k] != 0 || segment.y[k] != 0) degree = std::max(degree, k);
  return degree;
}

double scale_of(const Polynomial& polynomial) {
  const int n = polynomial.degree;
  std::vector<double> greatest(static_cast<std::size_t>(n) + 1, 0.0);
  std::size_t next = 0;
  for (int i = n; i >= 0; --i)
    for (int j = n - i; j >= 0; --j)
      for (int k = n - i - j; k >= 0; --k) {
        double& of_degree = greatest[static_cast<std::size_t>(i + j + k)];
        of_degree = std::max(of_degree, std::fabs(polynomial.coefficients.at(next++)));
      }
  int top = n;
  while (top > 0 && greatest[static_cast<std::size_t>(top)] == 0)
    --top;
  double scale = 0;
  for (int k = 0; k < top; ++k)
    if (greatest[static_cast<std::size_t>(k)] > 0)
      scale = std::max(scale, std::pow(greatest[static_cast<std::size_t>(k)] / greatest[static_cast<std::size_t>(top)],
                                       1.0 / (top - k)));
  constexpr double kMargin = 4;
  return std::clamp(kMargin * scale, 1e-3, 1e6);
}

std::optional<Transform> frame_of(const Prism& prism) {
  if (prism.outline.empty() || prism.bottom == prism.top) return std::nullopt;
  const CurveBounds b = CurveBounds::of(prism.outline);
  if (!(b.max_x > b.min_x) || !(b.max_y > b.min_y)) return std::nullopt;
  if (!prism.is_conic)
    return scaled_axes({0.5 * (b.max_x - b.min_x), 0, 0}, {0, 0, 0.5 * (b.max_y - b.min_y)},
                       {0, prism.top - prism.bottom, 0},
                       {0.5 * (b.min_x + b.max_x), prism.bottom, 0.5 * (b.min_y + b.max_y)});
  const double height = std::fabs(prism.top) >= std::fabs(prism.bottom) ? prism.top : prism.bottom;
  const double x = std::max(std::fabs(b.min_x), std::fabs(b.max_x)),
               z = std::max(std::fabs(b.min_y), std::fabs(b.max_y));
  return scaled_axes({x * height, 0, 0}, {0, 0, z * height}, {0, height, 0}, Vec3(0));
}

float lower_end_of(const Prism& prism) {
  if (!prism.is_conic) return 0;
  const bool is_top_wider = std::fabs(prism.top) >= std::fabs(prism.bottom);
  return static_cast<float>(is_top_wider ? prism.bottom / prism.top : prism.top / prism.bottom);
}

std::optional<Transform> frame_of(const Lathe& lathe) {
  if (lathe.curve.empty()) return std::nullopt;
  const CurveBounds b = CurveBounds::of(lathe.curve);
  return frame_around_y(std::max(std::fabs(b.min_x), std::fabs(b.max_x)), b.min_y, b.max_y);
}

std::optional<Transform> frame_of(const SurfaceOfRevolution& sor) {
  if (sor.pieces.empty()) return std::nullopt;
  return frame_around_y(std::sqrt(greatest_square(sor)), sor.pieces.front().low, sor.pieces.back().high);
}

std::optional<Transform> frame_of(const Blob& blob) {
  const Extent box = geometry::extent_of(blob);
  const Vec3 half = 0.5 * (box.max - box.min);
  const double largest = std::max({half.x, half.y, half.z});
  if (!(largest > 0)) return std::nullopt;
  const Vec3 size = glm::max(half * 1.0001, Vec3(1e-6 * largest));
  return scaled_axes({size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}, 0.5 * (box.min + box.max));
}

} // namespace celltrace

namespace celltrace::geometry {

namespace {

using Coefficients = std::vector<double>;

Coefficients times(const Coefficients& a, const Coefficients& b) {
  Coefficients product(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      product[i + j] += a[i] * b[j];
  return product;
}
void add(Coefficients& to, const Coefficients& other, double factor = 1) {
  if (to.size() < other.size()) to.resize(other.size(), 0.0);
  for (std::size_t i = 0; i < other.size(); ++i)
    to[i] += factor * other[i];
}
Coefficients of_curve(const Powers4& c) {
  return {c.begin(), c.end()};
}

/// Removes the highest powers whose coefficients are 0.
Coefficients trimmed(Coefficients c) {
  while (c.size() > 1 && c.back() == 0)
    c.pop_back();
  return c;
}

double value_of(const Polynomial& polynomial, const Vec3& p, Vec3& slope) {
  const int n = polynomial.degree;
  const double* next = polynomial.coefficients.data();
  double f = 0;
  slope = Vec3(0);
  for (int i = n; i >= 0; --i) {
    double f_y = 0, y_by_y = 0, y_by_z = 0;
    for (int j = n - i; j >= 0; --j) {
      double f_z = 0, z_by_z = 0;
      for (int k = n - i - j; k >= 0; --k) {
        z_by_z = z_by_z * p.z + f_z;
        f_z = f_z * p.z + *next++;
      }
      y_by_z = y_by_z * p.y + z_by_z;
      y_by_y = y_by_y * p.y + f_y;
      f_y = f_y * p.y + f_z;
    }
    slope.z = slope.z * p.x + y_by_z;
    slope.y = slope.y * p.x + y_by_y;
    slope.x = slope.x * p.x + f;
    f = f * p.x + f_y;
  }
  return f;
}

/// Returns the polynomial along a ray, whose points are from + along * s.
Coefficients along_ray(const Polynomial& polynomial, const Vec3& from, const Vec3& along) {
  const int n = polynomial.degree;
  const Coefficients x = {from.x, along.x}, y = {from.y, along.y}, z = {from.z, along.z};
  const double* next = polynomial.coefficients.data();
  Coefficients in_x = {0};
  for (int i = n; i >= 0; --i) {
    Coefficients in_y = {0};
    for (int j = n - i; j >= 0; --j) {
      Coefficients in_z = {0};
      for (int k = n - i - j; k >= 0; --k) {
        in_z = times(in_z, z);
        in_z[0] += *next++;
      }
      in_y = times(in_y, y);
      add(in_y, in_z);
    }
    in_x = times(in_x, x);
    add(in_x, in_y);
  }
  in_x.resize(static_cast<std::size_t>(n) + 1);
  return in_x;
}

/// Returns whether a half-line along x crosses curves an odd number of times.
bool is_within(const std::vector<CurveSegment>& outline, double x, double y) {
  bool is_in = false;
  for (const CurveSegment& segment : outline) {
    Coefficients c = of_curve(segment.y);
    c[0] -= y;
    for (const double w : roots(trimmed(c), 0, 1))
      if (w < 1 && celltrace::at(segment.x, w) > x) is_in = !is_in;
  }
  return is_in;
}

constexpr double kFarthest = 1e7; ///< POV-Ray's greatest distance of a hit

} // namespace

void find_crossings(const Polynomial& polynomial, const Ray& ray, Crossings& found) {
  // x is 0 where the ray is nearest to the origin; beyond 1, -1/x takes its place.
  const double length = glm::length(ray.direction), scale = scale_of(polynomial);
  const Vec3 d = ray.direction / length;
  const double middle = -glm::dot(ray.origin, d);
  Coefficients c = along_ray(polynomial, ray.origin + d * middle, d * scale);
  const auto take = [&](double x) {
    const double t = (x * scale + middle) / length;
    Vec3 slope;
    value_of(polynomial, ray.at(t), slope);
    found.push_back({t, slope});
  };
  for (const double x : roots(trimmed(c), -1, 1))
    take(x);
  std::reverse(c.begin(), c.end());
  for (std::size_t k = 1; k < c.size(); k += 2)
    c[k] = -c[k];
  const double least = scale / kFarthest;
  for (const double z : roots(trimmed(c), -1, -least))
    take(-1 / z);
  for (const double z : roots(trimmed(c), least, 1))
    take(-1 / z);
}
bool is_inside(const Polynomial& polynomial, const Vec3& point) {
  constexpr double kTolerance = 1e-4;
  Vec3 slope;
  return value_of(polynomial, point, slope) < kTolerance;
}
Extent extent_of(const Polynomial&) {
  return Extent::everywhere();
}

void find_crossings(const Prism& prism, const Ray& ray, Crossings& found) {
  const Vec3 &o = ray.origin, &d = ray.direction;
  if (!prism.open && d.y != 0)
    for (const double height : {prism.bottom, prism.top}) {
      if (prism.is_conic && height == 0) continue;
      const double t = (height - o.y) / d.y, size = prism.is_conic ? height : 1;
      const Vec3 p = ray.at(t);
      if (is_within(prism.outline, p.x / size, p.z / size))
        found.push_back({t, {0, 1, 0}}); // at both ends, as POV-Ray has it
    }
  // The ray and the axis, or the apex, span a plane, which crosses the outline.
  double x = -d.z, z = d.x, constant = d.z * o.x - d.x * o.z;
  if (prism.is_conic) {
    const Vec3 across = glm::cross(Vec3(o.x, o.z, o.y), Vec3(d.x, d.z, d.y));
    x = across.x;
    z = across.y;
    constant = across.z;
  }
  for (const CurveSegment& segment : prism.outline) {
    Coefficients c = {constant};
    add(c, of_curve(segment.x), x);
    add(c, of_curve(segment.y), z);
    for (const double w : roots(trimmed(c), 0, 1)) {
      const double cx = celltrace::at(segment.x, w), cz = celltrace::at(segment.y, w);
      const double run_x = prism.is_conic ? d.x - cx * d.y : d.x, run_z = prism.is_conic ? d.z - cz * d.y : d.z;
      const double to_x = prism.is_conic ? cx * o.y - o.x : cx - o.x, to_z = prism.is_conic ? cz * o.y - o.z : cz - o.z;
      const double square = run_x * run_x + run_z * run_z;
      if (square == 0) continue;
      const double t = (run_x * to_x + run_z * to_z) / square, height = o.y + d.y * t;
      if (height < prism.bottom || height > prism.top) continue;
      const double out_x = slope_at(segment.y, w), out_z = -slope_at(segment.x, w);
      found.push_back({t, {out_x, prism.is_conic ? -(cx * out_x + cz * out_z) : 0, out_z}});
    }
  }
}
bool is_inside(const Prism& prism, const Vec3& p) {
  if (p.y < prism.bottom || p.y >= prism.top || (prism.is_conic && p.y == 0)) return false;
  const double size = prism.is_conic ? p.y : 1;
  return is_within(prism.outline, p.x / size, p.z / size);
}
Extent extent_of(const Prism& prism) {
  const CurveBounds b = CurveBounds::of(prism.outline);
  if (!prism.is_conic) return {{b.min_x, prism.bottom, b.min_y}, {b.max_x, prism.top, b.max_y}};
  std::vector<Vec3> corners;
  for (const double height : {prism.bottom, prism.top})
    for (const double x : {b.min_x, b.max_x})
      for (const double z : {b.min_y, b.max_y})
        corners.push_back({x * height, height, z * height});
  return Extent::around(corners);
}

void find_crossings(const Lathe& lathe, const Ray& ray, Crossings& found) {
  const double length = glm::length(ray.direction);
  const Vec3 d = ray.direction / length;
  const double run = d.x * d.x + d.z * d.z;
  if (run == 0) return;
  const double middle = -(ray.origin.x * d.x + ray.origin.z * d.z) / run;
  const Vec3 o = ray.origin + d * middle;
  const double off = o.x * o.x + o.z * o.z;
  constexpr double kTilt = 1e-5;
  const double tilted = std::fabs(d.y) < kTilt ? std::copysign(kTilt, d.y) : d.y;
  for (const CurveSegment& segment : lathe.curve) {
    Coefficients height = of_curve(segment.y);
    height[0] -= o.y;
    Coefficients c = {tilted * tilted * off};
    add(c, times(height, height), run);
    add(c, times(of_curve(segment.x), of_curve(segment.x)), -tilted * tilted);
    for (double w : roots(trimmed(c), 0, 1)) {
      double s = (celltrace::at(segment.y, w) - o.y) / tilted;
      for (int step = 0; step < 4; ++step) {
        const double x = celltrace::at(segment.x, w), dx = slope_at(segment.x, w), dy = slope_at(segment.y, w);
        const double f = off + run * s * s - x * x, g = o.y + d.y * s - celltrace::at(segment.y, w);
        const double f_s = 2 * run * s, f_w = -2 * x * dx, determinant = f_w * d.y + f_s * dy;
        if (determinant == 0) break;
        s -= (f_w * g + f * dy) / determinant;
        w -= (d.y * f - f_s * g) / determinant;
      }
      const Vec3 p = o + d * s;
      const double radius = celltrace::at(segment.x, w);
      const bool is_on_axis = radius <= 1e-10;
      const double turned = is_on_axis ? 0 : slope_at(segment.y, w) / radius;
      found.push_back({(s + middle) / length,
                       {p.x * turned, is_on_axis ? 1 : -slope_at(segment.x, w), p.z * turned}});
    }
  }
}
bool is_inside(const Lathe& lathe, const Vec3& p) {
  const CurveBounds b = CurveBounds::of(lathe.curve);
  const double radius = std::sqrt(p.x * p.x + p.z * p.z);
  return radius >= b.min_x && radius <= b.max_x && is_within(lathe.curve, radius, p.y);
}
Extent extent_of(const Lathe& lathe) {
  const CurveBounds b = CurveBounds::of(lathe.curve);
  return {{-b.max_x, b.min_y, -b.max_x}, {b.max_x, b.max_y, b.max_x}};
}

double square_at(const SurfaceOfRevolution::Piece& piece, double y) {
  return celltrace::at(piece.square, y);
}
void find_crossings(const SurfaceOfRevolution& sor, const Ray& ray, Crossings& found) {
  const Vec3 &o = ray.origin, &d = ray.direction;
  if (!sor.open && d.y != 0)
    for (const bool is_top : {false, true}) {
      const SurfaceOfRevolution::Piece& piece = is_top ? sor.pieces.back() : sor.pieces.front();
      const double height = is_top ? piece.high : piece.low, square = square_at(piece, height);
      const double t = (height - o.y) / d.y;
      const Vec3 p = ray.at(t);
      if (square > 1e-4 && p.x * p.x + p.z * p.z <= square) found.push_back({t, {0, is_top ? 1 : -1, 0}});
    }
  const double reach = 1.001 * std::sqrt(greatest_square(sor)), run = d.x * d.x + d.z * d.z;
  const double middle = run > 0 ? -(o.x * d.x + o.z * d.z) / run : 0;
  const double half = run > 0 ? reach / std::sqrt(run) : kFarthest;
  for (const SurfaceOfRevolution::Piece& piece : sor.pieces) {
    double enter = middle - half, leave = middle + half;
    if (d.y != 0) {
      const double a = (piece.low - o.y) / d.y, b = (piece.high - o.y) / d.y;
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    } else if (o.y < piece.low || o.y >= piece.high) {
      continue;
    }
    if (enter > leave) continue;
    const Coefficients y = {o.y, d.y};
    Coefficients c = {piece.square[3]};
    for (int k = 2; k >= 0; --k) {
      c = times(c, y);
      c[0] += piece.square[k];
    }
    add(c, {o.x * o.x + o.z * o.z, 2 * (o.x * d.x + o.z * d.z), run}, -1);
    for (const double t : roots(trimmed(c), enter, leave)) {
      const Vec3 p = ray.at(t);
      found.push_back({t, {p.x, -0.5 * slope_at(piece.square, p.y), p.z}});
    }
  }
}
bool is_inside(const SurfaceOfRevolution& sor, const Vec3& p) {
  return std::any_of(sor.pieces.begin(), sor.pieces.end(), [&](const SurfaceOfRevolution::Piece& piece) {
    return p.y >= piece.low && p.y <= piece.high && p.x * p.x + p.z * p.z <= square_at(piece, p.y);
  });
}
Extent extent_of(const SurfaceOfRevolution& sor) {
  const double radius = std::sqrt(greatest_square(sor));
  return {{-radius, sor.pieces.front().low, -radius}, {radius, sor.pieces.back().high, radius}};
}

namespace {

/// Returns the squared distance of a point from a component's point or line, as a share of its squared radius.
double square_of(const Blob::Component& component, const Vec3& p, Vec3* slope) {
  const Transform to_component = component.transform.inverse();
  const Vec3 q = to_component.point(p), line = component.b - component.a;
  const double square = glm::dot(line, line);
  const double along = square > 0 ? std::clamp(glm::dot(q - component.a, line) / square, 0.0, 1.0) : 0;
  const Vec3 off = (q - component.a - line * along) / component.radius;
  if (slope != nullptr) *slope = component.transform.normal(off / component.radius);
  return glm::dot(off, off);
}
double field_at(const Blob& blob, const Vec3& p, Vec3* slope = nullptr) {
  double sum = 0;
  for (const Blob::Component& component : blob.components) {
    Vec3 off;
    const double left = 1 - square_of(component, p, &off);
    if (left <= 0) continue;
    sum += component.strength * left * left;
    if (slope != nullptr) *slope += off * (component.strength * left);
  }
  return sum;
}

} // namespace

void find_crossings(const Blob& blob, const Ray& ray, Crossings& found) {
  // Between places where a component's field begins, ends, or goes from a line's side to its end, the sum of
  // fields is one polynomial of the distance.
  struct Part {
    double enter, leave;
    Coefficients square; ///< squared distance from the component, as a share of its squared radius
    double strength;
  };
  std::vector<Part> parts;
  std::vector<double> places;
  for (const Blob::Component& component : blob.components) {
    const Transform to_component = component.transform.inverse();
    const Vec3 o = (to_component.point(ray.origin) - component.a) / component.radius,
               d = to_component.direction(ray.direction) / component.radius;
    const Vec3 line = (component.b - component.a) / component.radius;
    const double length = glm::length(line);
    const Vec3 axis = length > 0 ? line / length : Vec3(0);
    const double height = glm::dot(o, axis), rise = glm::dot(d, axis);
    const auto add_part = [&](const Vec3& from, const Vec3& along, double low, double high) {
      const double a = glm::dot(along, along), b = glm::dot(from, along), c = glm::dot(from, from);
      Part part{-kFarthest, kFarthest, {c, 2 * b, a}, component.strength};
      if (a > 0) {
        const double root = b * b - a * (c - 1);
        if (root <= 0) return;
        part.enter = (-b - std::sqrt(root)) / a;
        part.leave = (-b + std::sqrt(root)) / a;
      } else if (c >= 1) {
        return;
      }
      if (rise != 0) {
        const double first = (low - height) / rise, second = (high - height) / rise;
        part.enter = std::max(part.enter, std::min(first, second));
        part.leave = std::min(part.leave, std::max(first, second));
      } else if (height < low || height >= high) {
        return;
      }
      if (part.enter >= part.leave) return;
      places.push_back(part.enter);
      places.push_back(part.leave);
      parts.push_back(part);
    };
    if (length == 0) {
      add_part(o, d, -kFarthest, kFarthest);
      continue;
    }
    add_part(o - axis * height, d - axis * rise, 0, length);
    add_part(o, d, -kFarthest, 0);
    add_part(o - line, d, length, kFarthest);
  }
  std::sort(places.begin(), places.end());
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double from = places[i], to = places[i + 1], middle = 0.5 * (from + to);
    if (!(from < to)) continue;
    Coefficients sum = {-blob.threshold};
    for (const Part& part : parts) {
      if (middle < part.enter || middle > part.leave) continue;
      Coefficients left = {1 - part.square[0], -part.square[1], -part.square[2]};
      add(sum, times(left, left), part.strength);
    }
    for (const double t : roots(trimmed(sum), from, to)) {
      Vec3 slope(0);
      field_at(blob, ray.at(t), &slope);
      found.push_back({t, slope});
    }
  }
}
bool is_inside(const Blob& blob, const Vec3& p) {
  constexpr double kTolerance = 1e-6;
  return field_at(blob, p) > blob.threshold - kTolerance;
}
/// Returns the box of the components with positive strength, as POV-Ray does.
Extent extent_of(const Blob& blob) {
  std::optional<Extent> all;
  for (const Blob::Component& component : blob.components) {
    if (component.strength <= 0) continue;
    const Extent box = celltrace::extent_of(component);
    all = all ? all->joined(box) : box;
  }
  return all.value_or(Extent{});
}

} // namespace celltrace::geometry
