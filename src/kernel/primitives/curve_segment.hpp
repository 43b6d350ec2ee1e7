// Pieces of plane curves, of which prisms and lathes are made. Kernel dialect.
#pragma once

#include "kernel/primitives/data_shape.hpp"
#include "kernel/primitives/polynomial_roots.hpp"

namespace celltrace::kernel {

/// A piece of a curve: polynomials of w from 0 to 1, and the box around it. Four records each.
struct CurvePiece {
  static constexpr uint32_t kRecords = 4;
  static constexpr uint32_t kMostDegree = 3;

  ShapeDataRecord x, y; ///< coefficients, the constant first
  float end_x, end_y;   ///< the point at w = 1, where the next piece has its first point to the bit
  float middle_x, middle_y, half_x, half_y;

  /// Reads piece `i` of a shape with one record before its pieces.
  template <class Numbers> CurvePiece(const Numbers& numbers, uint32_t i) {
    const uint32_t first = 1 + i * kRecords;
    x = numbers.at(first);
    y = numbers.at(first + 1);
    const ShapeDataRecord end = numbers.at(first + 2), box = numbers.at(first + 3);
    end_x = end.value[0];
    end_y = end.value[1];
    middle_x = box.value[0];
    middle_y = box.value[1];
    half_x = box.value[2];
    half_y = box.value[3];
  }

  template <class Numbers> static uint32_t count(const Numbers& numbers) {
    return (numbers.count() - 1) / kRecords;
  }

  template <class S> static typename S::F at(const ShapeDataRecord& c, const typename S::F& w) {
    using F = typename S::F;
    return ((F(c.value[3]) * w + F(c.value[2])) * w + F(c.value[1])) * w + F(c.value[0]);
  }
  template <class S> static typename S::F slope(const ShapeDataRecord& c, const typename S::F& w) {
    using F = typename S::F;
    return (F(3.0f * c.value[3]) * w + F(2.0f * c.value[2])) * w + F(c.value[1]);
  }
};

/// Returns the points for which a half-line along x crosses the pieces of closed curves an odd number of
/// times. `degree` is that of the pieces. Owner is the shape in whose code module the test is.
template <class Owner, class S, class Numbers>
typename S::M is_within_curves(const typename S::F& x, const typename S::F& y, const Numbers& numbers,
                               uint32_t degree, const typename S::M& lanes) {
  using F = typename S::F;
  using M = typename S::M;
  PolynomialRoots<S, Owner, CurvePiece::kMostDegree> roots;
  roots.degree = degree;
  uint32_t odd = 0;
  const uint32_t pieces = CurvePiece::count(numbers);
  for (uint32_t i = 0; i < pieces; ++i) {
    const CurvePiece piece(numbers, i);
    const M beside = lanes & (S::abs(y - F(piece.middle_y)) <= F(piece.half_y)) &
                     (x <= F(piece.middle_x + piece.half_x));
    if (beside.bits() == 0) continue;
    roots.c[0] = F(piece.y.value[0]) - y;
    for (uint32_t k = 1; k <= degree; ++k)
      roots.c[k] = F(piece.y.value[k]);
    roots.set_end(F(piece.end_y) - y);
    roots.find(F(0.0f), F(1.0f), beside, M::none(), [&](const F& w, const M& found) {
      odd ^= (found & (CurvePiece::at<S>(piece.x, w) > x)).bits();
      return false;
    });
  }
  return M::from_bits(odd);
}

} // namespace celltrace::kernel
