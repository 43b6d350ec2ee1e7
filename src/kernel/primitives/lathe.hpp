// The lathe: the surface that a curve leaves behind when it turns around the z axis of its space. The curve
// lies between z = 0 and z = 1, at most 1 from the axis. Kernel dialect.
#pragma once

#include "kernel/primitives/curve_segment.hpp"

namespace celltrace::kernel {

/// The first record has the degree of the curve's pieces, and the squares of the smallest and greatest radius.
/// The pieces follow: x is the distance from the axis, and y the height.
struct LathePrimitive : DataPrimitive<LathePrimitive> {
  static constexpr const char* kName = "lathe";
  static constexpr uint32_t kMostDegree = 2 * CurvePiece::kMostDegree;

  static constexpr CodeModule module() { return modules::kLathes; }

  template <class S, class Numbers>
  static void intersect_data(const LocalRays<S>& rays, const Numbers& numbers, NearestCrossing<S>& nearest) {
    using F = typename S::F;
    using M = typename S::M;
    const F zero(0.0f), one(1.0f);
    const auto degree = static_cast<uint32_t>(numbers.at(0).value[0]);
    // Distances s are from the point of the ray nearest to the axis, along a direction of length 1.
    const F length = S::sqrt(dot<S>(rays.direction, rays.direction));
    const V3<S> d = rays.direction * (one / S::max(length, F(1e-30f)));
    const F run = d.x * d.x + d.y * d.y;
    const F middle = -(rays.origin.x * d.x + rays.origin.y * d.y) / S::max(run, F(1e-12f));
    const V3<S> o = rays.origin + d * middle;
    const F off = o.x * o.x + o.y * o.y;
    // The equation of level rays has double roots: a slight tilt parts them, and is taken back afterwards.
    constexpr float kTilt = 1e-3f;
    const F tilted = S::select(S::abs(d.z) < F(kTilt), S::select(d.z < zero, F(-kTilt), F(kTilt)), d.z);
    PolynomialRoots<S, LathePrimitive, kMostDegree> roots;
    roots.degree = 2 * degree;
    const uint32_t pieces = CurvePiece::count(numbers);
    for (uint32_t i = 0; i < pieces; ++i) {
      const CurvePiece piece(numbers, i);
      const float most = piece.middle_x + piece.half_x, outer = most * most * 1.0001f + 1e-9f;
      const F half = S::sqrt(S::max(F(outer) - off, zero) / S::max(run, F(1e-12f)));
      const F lowest = o.z - S::abs(d.z) * half, highest = o.z + S::abs(d.z) * half;
      const M near = (off <= F(outer)) & (lowest <= F(piece.middle_y + piece.half_y + 1e-5f)) &
                     (highest >= F(piece.middle_y - piece.half_y - 1e-5f));
      if (near.bits() == 0) continue;
      // run (Z - z)^2 + tilted^2 (off - X^2) = 0, where the ray is at height Z and X from the axis
      const F square = tilted * tilted;
      F height[CurvePiece::kMostDegree + 1];
      for (uint32_t k = 0; k <= degree; ++k)
        height[k] = F(piece.y.value[k]);
      height[0] = height[0] - o.z;
      for (uint32_t k = 0; k <= 2 * degree; ++k) {
        F sum = k == 0 ? square * off : zero;
        for (uint32_t j = k > degree ? k - degree : 0; j <= k && j <= degree; ++j)
          sum = sum + run * height[j] * height[k - j] -
                square * F(piece.x.value[j] * piece.x.value[k - j]);
        roots.c[k] = sum;
      }
      const F end = F(piece.end_y) - o.z;
      roots.set_end(run * end * end + square * (off - F(piece.end_x * piece.end_x)));
      roots.find(zero, one, near, M::none(), [&](const F& root, const M& found) {
        F w = root;
        F s = (CurvePiece::at<S>(piece.y, w) - o.z) / tilted;
        // Newton's steps for both unknowns: s and w are exact also where the polynomial is flat.
        for (uint32_t step = 0; step < 3; ++step) {
          const F x = CurvePiece::at<S>(piece.x, w), dx = CurvePiece::slope<S>(piece.x, w);
          const F dy = CurvePiece::slope<S>(piece.y, w);
          const F f = off + run * s * s - x * x, g = o.z + d.z * s - CurvePiece::at<S>(piece.y, w);
          const F f_s = F(2.0f) * run * s, f_w = F(-2.0f) * x * dx;
          const F determinant = f_w * d.z + f_s * dy;
          const M is_regular = S::abs(determinant) > F(1e-12f);
          const F inverse = one / S::select(is_regular, determinant, one);
          const F step_s = (f_w * g + f * dy) * inverse, step_w = (d.z * f - f_s * g) * inverse;
          const M goes = is_regular & (S::abs(step_s) < F(0.05f)) & (S::abs(step_w) < F(0.05f));
          s = S::select(goes, s - step_s, s);
          w = S::select(goes, w - step_w, w);
        }
        const F x = o.x + d.x * s, y = o.y + d.y * s;
        const F radius = CurvePiece::at<S>(piece.x, w), dx = CurvePiece::slope<S>(piece.x, w);
        const F dy = CurvePiece::slope<S>(piece.y, w);
        const M on_axis = radius <= F(1e-10f);
        const F turned = S::select(on_axis, zero, dy / S::max(radius, F(1e-10f)));
        nearest.offer_apart(rays, (s + middle) / length, found,
                            {x * turned, y * turned, S::select(on_axis, one, -dx)});
        return false;
      });
    }
  }

  /// As in POV-Ray, points nearer to the axis than all of the curve are outside.
  template <class S, class Numbers> static typename S::M inside_data(const V3<S>& p, const Numbers& numbers) {
    using F = typename S::F;
    const ShapeDataRecord head = numbers.at(0);
    const F square = p.x * p.x + p.y * p.y;
    const auto lanes = (square >= F(head.value[1])) & (square <= F(head.value[2]));
    if (lanes.bits() == 0) return lanes;
    return is_within_curves<LathePrimitive, S>(S::sqrt(square), p.z, numbers, static_cast<uint32_t>(head.value[0]), lanes);
  }

  static LocalBounds local_bounds(float) { return {0.0f, 1.0f, 1.0f, false}; }
};

} // namespace celltrace::kernel
