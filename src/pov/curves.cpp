#include "pov/curves.hpp"

#include <algorithm>
#include <cmath>

namespace celltrace::pov {

namespace {

using Point = glm::dvec2;

/// Points as near as this are the same, as in POV-Ray.
constexpr double kNear = 1e-10;

bool is_same(const Point& a, const Point& b) {
  return std::fabs(a.x - b.x) < kNear && std::fabs(a.y - b.y) < kNear;
}

/// Returns the curve c[0] + c[1] w + c[2] w^2 + c[3] w^3.
CurveSegment segment(const Point& c0, const Point& c1, const Point& c2 = {0, 0}, const Point& c3 = {0, 0}) {
  return {{c0.x, c1.x, c2.x, c3.x}, {c0.y, c1.y, c2.y, c3.y}};
}
CurveSegment linear(const Point& a, const Point& b) {
  return segment(a, b - a);
}
CurveSegment quadratic(const Point& before, const Point& a, const Point& b) {
  return segment(a, (b - before) * 0.5, (before - a * 2.0 + b) * 0.5);
}
CurveSegment cubic(const Point& before, const Point& a, const Point& b, const Point& after) {
  return segment(a, (b - before) * 0.5, before - a * 2.5 + b * 2.0 - after * 0.5,
                 (after - before) * 0.5 + (a - b) * 1.5);
}
CurveSegment bezier(const Point& a, const Point& b, const Point& c, const Point& d) {
  return segment(a, (b - a) * 3.0, (a - b * 2.0 + c) * 3.0, d - a + (b - c) * 3.0);
}

void check_count(CurveKind kind, std::size_t count, std::size_t of_linear, std::size_t of_quadratic,
                 std::size_t of_cubic, const char* shape, const CurveFails& fail) {
  const auto require = [&](std::size_t least, const char* name) {
    if (count < least)
      fail(std::string("a ") + shape + " with a " + name + " has at least " + std::to_string(least) + " points");
  };
  switch (kind) {
  case CurveKind::linear:
    return require(of_linear, "linear_spline");
  case CurveKind::quadratic:
    return require(of_quadratic, "quadratic_spline");
  case CurveKind::cubic:
    return require(of_cubic, "cubic_spline");
  case CurveKind::bezier:
    if (count == 0 || count % 4 != 0)
      fail(std::string("a ") + shape + " with a bezier_spline has four points for each of its curves");
    return;
  case CurveKind::b_spline:
    fail(std::string("a ") + shape + " has no b_spline");
  }
}

} // namespace

std::vector<CurveSegment> lathe_curve(CurveKind kind, const CurvePoints& p, const CurveFails& fail) {
  check_count(kind, p.size(), 2, 3, 4, "lathe", fail);
  for (std::size_t i = 1; i + 1 < p.size(); ++i)
    if (p[i].x < 0) fail("the points of a lathe are not left of its axis: their first component is not below 0");
  std::vector<CurveSegment> curve;
  switch (kind) {
  case CurveKind::linear:
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
      curve.push_back(linear(p[i], p[i + 1]));
    break;
  case CurveKind::quadratic:
    for (std::size_t i = 0; i + 2 < p.size(); ++i)
      curve.push_back(quadratic(p[i], p[i + 1], p[i + 2]));
    break;
  case CurveKind::cubic:
    for (std::size_t i = 0; i + 3 < p.size(); ++i)
      curve.push_back(cubic(p[i], p[i + 1], p[i + 2], p[i + 3]));
    break;
  default:
    for (std::size_t i = 0; i + 3 < p.size(); i += 4)
      curve.push_back(bezier(p[i], p[i + 1], p[i + 2], p[i + 3]));
  }
  return curve;
}

std::vector<CurveSegment> prism_outline(CurveKind kind, const CurvePoints& given, const CurveFails& fail,
                                        const std::function<void(const char*)>& warn) {
  check_count(kind, given.size(), 3, 5, 6, "prism", fail);
  CurvePoints p = given;
  const auto end = static_cast<std::ptrdiff_t>(p.size());
  std::vector<CurveSegment> outline;
  const auto not_closed = [&] {
    warn("the points of this prism do not return to the first one: there is nothing to see of it");
    outline.clear();
  };
  if (kind == CurveKind::bezier) {
    std::size_t start = 0; // of the loop
    bool is_closed = false;
    for (std::size_t i = 0; i < p.size(); i += 4) {
      if (is_closed) start = i;
      if (i != start && !is_same(p[i - 1], p[i])) {
        not_closed();
        return outline;
      }
      // POV-Ray follows these curves backwards, which decides on which side the normal is.
      outline.insert(outline.begin(), bezier(p[i + 3], p[i + 2], p[i + 1], p[i]));
      is_closed = is_same(p[i + 3], p[start]);
    }
    if (!is_closed) not_closed();
    return outline;
  }
  const std::ptrdiff_t before = kind == CurveKind::linear ? 0 : 1, after = kind == CurveKind::cubic ? 1 : 0;
  const auto at = [&](std::ptrdiff_t i) { return p[static_cast<std::size_t>(i)]; };
  for (std::ptrdiff_t first = before; first < end;) {
    std::ptrdiff_t last = first + 1;
    while (last < end && !is_same(at(last), at(first)))
      ++last;
    if (last + after >= end) {
      if (kind != CurveKind::linear || first + 1 >= end) {
        if (kind != CurveKind::linear) not_closed();
        return outline;
      }
      warn("the points of this prism do not return to the first one, to which a line is added");
      p.push_back(p[static_cast<std::size_t>(first)]);
    }
    for (std::ptrdiff_t i = first; i < last; ++i)
      outline.push_back(kind == CurveKind::linear      ? linear(at(i), at(i + 1))
                        : kind == CurveKind::quadratic ? quadratic(at(i - 1), at(i), at(i + 1))
                                                       : cubic(at(i - 1), at(i), at(i + 1), at(i + 2)));
    first = last + 1 + after + before;
  }
  return outline;
}

std::vector<SurfaceOfRevolution::Piece> sor_pieces(const CurvePoints& p, const CurveFails& fail) {
  if (p.size() < 4) fail("a sor has at least four points");
  for (const Point& point : p)
    if (point.x < 0) fail("the points of a sor are not left of its axis: their first component is not below 0");
  std::vector<SurfaceOfRevolution::Piece> pieces;
  for (std::size_t i = 0; i + 3 < p.size(); ++i) {
    const Point &before = p[i], &low = p[i + 1], &high = p[i + 2], &after = p[i + 3];
    if (!(low.y < high.y)) fail("the points of a sor, but for the first and the last, go upward");
    if (before.y == high.y || low.y == after.y) fail("two points of a sor with one between them have the same height");
    // Hermite's cubic for the squared radius, as a polynomial of y - low.y
    const double length = high.y - low.y;
    const double from = low.x * low.x, to = high.x * high.x;
    const double slope_from = 2 * low.x * (high.x - before.x) / (high.y - before.y),
                 slope_to = 2 * high.x * (after.x - low.x) / (after.y - low.y);
    const double mean = (to - from) / length;
    const double c2 = (3 * mean - 2 * slope_from - slope_to) / length,
                 c3 = (slope_from + slope_to - 2 * mean) / (length * length);
    SurfaceOfRevolution::Piece piece;
    piece.low = low.y;
    piece.high = high.y;
    const double y = low.y;
    piece.square[0] = from - slope_from * y + c2 * y * y - c3 * y * y * y;
    piece.square[1] = slope_from - 2 * c2 * y + 3 * c3 * y * y;
    piece.square[2] = c2 - 3 * c3 * y;
    piece.square[3] = c3;
    for (double& c : piece.square)
      if (std::fabs(c) < kNear) c = 0; // as POV-Ray does
    pieces.push_back(piece);
  }
  return pieces;
}

} // namespace celltrace::pov
