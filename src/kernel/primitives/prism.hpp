// The prism: a solid with the same cross-section at all heights, from z = 0 to z = 1 of its space, or one
// whose cross-section grows with z up to z = 1. The cross-section at z = 1 is within the square from -1 to 1.
// Kernel dialect.
#pragma once

#include "kernel/primitives/curve_segment.hpp"

namespace celltrace::kernel {

/// The first record has the degree of the outline's pieces; 1 if the prism is conic; 1 if it has no ends; and
/// the height of its lower end. The pieces follow.
struct PrismPrimitive : DataPrimitive<PrismPrimitive> {
  static constexpr const char* kName = "prism";

  static constexpr CodeModule module() { return modules::kPrisms; }

  /// The first record's numbers.
  struct Form {
    uint32_t degree;
    bool is_conic, is_open;
    float low;

    explicit Form(const ShapeDataRecord& r)
        : degree(static_cast<uint32_t>(r.value[0])), is_conic(r.value[1] != 0.0f), is_open(r.value[2] != 0.0f),
          low(r.value[3]) {}
  };

  template <class S, class Numbers>
  static void intersect_data(const LocalRays<S>& rays, const Numbers& numbers, NearestCrossing<S>& nearest) {
    using F = typename S::F;
    using M = typename S::M;
    const Form form(numbers.at(0));
    const V3<S>&o = rays.origin, &d = rays.direction;
    const F zero(0.0f), one(1.0f), low(form.low);
    if (!form.is_open) {
      for (uint32_t end = 0; end < 2; ++end) {
        const float height = end == 0 ? form.low : 1.0f;
        if (form.is_conic && height == 0.0f) continue;
        const F t = (F(height) - o.z) * finite_inverse<S>(d.z);
        const F size(form.is_conic ? 1.0f / height : 1.0f);
        const F x = (o.x + d.x * t) * size, y = (o.y + d.y * t) * size;
        const M lanes = (S::abs(d.z) > F(1e-10f)) & (t > nearest.after) & (t < nearest.t) & (S::abs(x) <= one) &
                        (S::abs(y) <= one);
        if (lanes.bits() == 0) continue;
        // In a statement of its own: the order of evaluation would change modelled cycles.
        const M within = is_within_curves<PrismPrimitive, S>(x, y, numbers, form.degree, lanes);
        nearest.offer_apart(rays, t, within, {zero, zero, F(end == 0 ? -1.0f : 1.0f)});
      }
    }
    // A ray and the axis, or the apex, span a plane; the ray crosses the side where the plane crosses the
    // outline. The plane's equation is across.x x + across.y y + across.z = 0.
    V3<S> across;
    if (form.is_conic)
      across = cross<S>(o, d);
    else
      across = {-d.y, d.x, d.y * o.x - d.x * o.y};
    PolynomialRoots<S, PrismPrimitive, CurvePiece::kMostDegree> roots;
    roots.degree = form.degree;
    const uint32_t pieces = CurvePiece::count(numbers);
    for (uint32_t i = 0; i < pieces; ++i) {
      const CurvePiece piece(numbers, i);
      const F off = across.x * F(piece.middle_x) + across.y * F(piece.middle_y) + across.z;
      const F reach = S::abs(across.x) * F(piece.half_x) + S::abs(across.y) * F(piece.half_y);
      const M near = S::abs(off) <= reach * F(1.0001f) + F(1e-6f) * S::abs(across.z);
      if (near.bits() == 0) continue;
      for (uint32_t k = 0; k <= form.degree; ++k)
        roots.c[k] = across.x * F(piece.x.value[k]) + across.y * F(piece.y.value[k]);
      roots.c[0] = roots.c[0] + across.z;
      roots.set_end(across.x * F(piece.end_x) + across.y * F(piece.end_y) + across.z);
      roots.find(zero, one, near, M::none(), [&](const F& w, const M& found) {
        const F x = CurvePiece::at<S>(piece.x, w), y = CurvePiece::at<S>(piece.y, w);
        const F run_x = form.is_conic ? d.x - x * d.z : d.x, run_y = form.is_conic ? d.y - y * d.z : d.y;
        const F to_x = form.is_conic ? x * o.z - o.x : x - o.x, to_y = form.is_conic ? y * o.z - o.y : y - o.y;
        const F square = run_x * run_x + run_y * run_y;
        const F t = (run_x * to_x + run_y * to_y) / S::max(square, F(1e-30f));
        const F z = o.z + d.z * t;
        const F out_x = CurvePiece::slope<S>(piece.y, w), out_y = -CurvePiece::slope<S>(piece.x, w);
        const F out_z = form.is_conic ? -(x * out_x + y * out_y) : zero;
        nearest.offer_apart(rays, t, found & (square > zero) & (z >= low) & (z <= one), {out_x, out_y, out_z});
        return false;
      });
    }
  }

  template <class S, class Numbers> static typename S::M inside_data(const V3<S>& p, const Numbers& numbers) {
    using F = typename S::F;
    const Form form(numbers.at(0));
    const F size = form.is_conic ? F(1.0f) / S::select(S::abs(p.z) > F(1e-20f), p.z, F(1e-20f)) : F(1.0f);
    const auto lanes = (p.z >= F(form.low)) & (p.z < F(1.0f));
    if (lanes.bits() == 0) return lanes;
    return is_within_curves<PrismPrimitive, S>(p.x * size, p.y * size, numbers, form.degree, lanes);
  }

  /// Returns the bounds of the whole space of a conic prism, which may reach below 0.
  static LocalBounds local_bounds(float low) { return {low, 1.0f, 1.0f, true}; }
};

} // namespace celltrace::kernel
