// The surface of revolution: around the z axis of its space, from z = 0 to z = 1, with a radius of at most 1.
// The squared radius is a polynomial of z, piece by piece. Kernel dialect.
#pragma once

#include "kernel/primitives/data_shape.hpp"
#include "kernel/primitives/polynomial_roots.hpp"

namespace celltrace::kernel {

/// The first record has 1 if the surface is open, and the squared radii of the ends, low and high. Each piece
/// has two records: the coefficients of its polynomial of z, and the heights of its ends.
struct SorPrimitive : DataPrimitive<SorPrimitive> {
  static constexpr const char* kName = "sor";

  static constexpr CodeModule module() { return modules::kRevolved; }

  template <class S, class Numbers>
  static void intersect_data(const LocalRays<S>& rays, const Numbers& numbers, NearestCrossing<S>& nearest) {
    using F = typename S::F;
    using M = typename S::M;
    const ShapeDataRecord head = numbers.at(0);
    const F zero(0.0f), one(1.0f);
    const V3<S>& d = rays.direction;
    const F steep = finite_inverse<S>(d.z);
    if (head.value[0] == 0.0f)
      for (uint32_t end = 0; end < 2; ++end) {
        constexpr float kLeastSquare = 1e-4f; // POV-Ray shows no smaller ends
        if (head.value[1 + end] <= kLeastSquare * head.value[3]) continue;
        const F t = (F(static_cast<float>(end)) - rays.origin.z) * steep;
        const F x = rays.origin.x + d.x * t, y = rays.origin.y + d.y * t;
        nearest.offer_apart(rays, t, (S::abs(d.z) > F(1e-10f)) & (x * x + y * y <= F(head.value[1 + end])),
                            {zero, zero, F(end == 0 ? -1.0f : 1.0f)});
      }
    // Distances s are from the point of the ray nearest to the axis.
    const F run = d.x * d.x + d.y * d.y;
    const M is_level = run > F(1e-20f);
    const F middle = S::select(is_level, -(rays.origin.x * d.x + rays.origin.y * d.y) / S::max(run, F(1e-20f)), zero);
    const V3<S> o = rays.origin + d * middle;
    const F off = o.x * o.x + o.y * o.y;
    M lanes = off <= F(1.0001f);
    if (lanes.bits() == 0) return;
    const F half = S::select(is_level, S::sqrt(S::max(F(1.0001f) - off, zero) / S::max(run, F(1e-20f))), F(1e20f));
    const M rises = S::abs(d.z) > F(1e-10f);
    PolynomialRoots<S, SorPrimitive, 3> roots;
    roots.degree = 3;
    for (uint32_t i = 1; i + 1 < numbers.count(); i += 2) {
      const ShapeDataRecord c = numbers.at(i), ends = numbers.at(i + 1);
      const F at_low = (F(ends.value[0]) - o.z) * steep, at_high = (F(ends.value[1]) - o.z) * steep;
      F enter = S::max(S::min(at_low, at_high), -half), leave = S::min(S::max(at_low, at_high), half);
      const M stays = (o.z >= F(ends.value[0])) & (o.z < F(ends.value[1])) & !rises;
      enter = S::select(rises, enter, -half);
      leave = S::select(rises, leave, half);
      const M some = lanes & (rises | stays) & (enter <= leave) & (leave + middle > nearest.after);
      if (some.bits() == 0) continue;
      // The polynomial of s = enter + w * (leave - enter)
      const F length = leave - enter;
      const F z = o.z + d.z * enter, dz = d.z * length;
      const F c1(c.value[1]), c2(c.value[2]), c3(c.value[3]);
      roots.c[0] = ((c3 * z + c2) * z + c1) * z + F(c.value[0]) - (off + run * enter * enter);
      roots.c[1] = ((F(3.0f) * c3 * z + F(2.0f) * c2) * z + c1) * dz - F(2.0f) * run * enter * length;
      roots.c[2] = (F(3.0f) * c3 * z + c2) * dz * dz - run * length * length;
      roots.c[3] = c3 * dz * dz * dz;
      roots.find(zero, one, some, M::none(), [&](const F& w, const M& found) {
        const F s = enter + w * length;
        const F at_z = o.z + d.z * s;
        const F slope = (F(3.0f) * c3 * at_z + F(2.0f) * c2) * at_z + c1;
        nearest.offer_apart(rays, s + middle, found, {o.x + d.x * s, o.y + d.y * s, slope * F(-0.5f)});
        return false;
      });
    }
  }

  template <class S, class Numbers> static typename S::M inside_data(const V3<S>& p, const Numbers& numbers) {
    using F = typename S::F;
    const F square = p.x * p.x + p.y * p.y;
    auto inside = S::M::none();
    for (uint32_t i = 1; i + 1 < numbers.count(); i += 2) {
      const ShapeDataRecord c = numbers.at(i), ends = numbers.at(i + 1);
      const F radius = ((F(c.value[3]) * p.z + F(c.value[2])) * p.z + F(c.value[1])) * p.z + F(c.value[0]);
      inside = inside | ((p.z >= F(ends.value[0])) & (p.z <= F(ends.value[1])) & (square <= radius));
    }
    return inside;
  }

  static LocalBounds local_bounds(float) { return {0.0f, 1.0f, 1.0f, false}; }
};

} // namespace celltrace::kernel
