// The blob: the surface around points and lines where their fields add up to a threshold. The blob lies in the
// cube from -1 to 1 of its space. Kernel dialect.
#pragma once

#include "kernel/primitives/data_shape.hpp"
#include "kernel/primitives/polynomial_roots.hpp"

namespace celltrace::kernel {

/// An element of a blob, in a space of its own in which its field ends at distance 1. Four records: the map
/// to this space, row by row, then strength, kind, and the length of a line.
struct BlobElement {
  static constexpr uint32_t kRecords = 4;
  /// The field of a line is that of a cylinder around z from 0 to the length, and of two half balls: one
  /// below its start, and one above its end, at which the element's space then begins.
  enum Kind : uint32_t { ball = 0, cylinder = 1, lower_half = 2, upper_half = 3 };

  float map[12];
  float strength, length;
  uint32_t kind;

  template <class Numbers> BlobElement(const Numbers& numbers, uint32_t i) {
    const uint32_t first = 1 + i * kRecords;
    for (uint32_t row = 0; row < 3; ++row) {
      const ShapeDataRecord r = numbers.at(first + row);
      for (uint32_t column = 0; column < 4; ++column)
        map[row * 4 + column] = r.value[column];
    }
    const ShapeDataRecord last = numbers.at(first + 3);
    strength = last.value[0];
    kind = static_cast<uint32_t>(last.value[1]);
    length = last.value[2];
  }
};

/// The first record has the threshold; the elements follow.
struct BlobPrimitive : DataPrimitive<BlobPrimitive> {
  static constexpr const char* kName = "blob";
  /// POV-Ray finds no crossings nearer than this to a ray's origin.
  static constexpr float kLeastDistance = 0.01f;

  static constexpr CodeModule module() { return modules::kBlobs; }

  /// The part of each ray in which an element's field is not 0, and its squared distance there as a
  /// polynomial.
  template <class S> struct Reach {
    using F = typename S::F;
    F enter, leave; ///< leave < enter: nowhere
    F square[3];

    Reach(const BlobElement& element, const V3<S>& o, const V3<S>& d) {
      const F zero(0.0f), one(1.0f);
      const V3<S> from = to_local<S>(element.map, o, 1.0f), along = to_local<S>(element.map, d, 0.0f);
      const bool is_cylinder = element.kind == BlobElement::cylinder;
      F a = along.x * along.x + along.y * along.y, b = from.x * along.x + from.y * along.y;
      F c = from.x * from.x + from.y * from.y;
      if (!is_cylinder) {
        a = a + along.z * along.z;
        b = b + from.z * along.z;
        c = c + from.z * from.z;
      }
      square[0] = c;
      square[1] = F(2.0f) * b;
      square[2] = a;
      const F inverse = one / S::max(a, F(1e-12f));
      const F root = b * b - a * (c - one);
      const F half = S::sqrt(S::max(root, zero)) * inverse, middle = -b * inverse;
      const auto is_along = a <= F(1e-12f); // to the axis of a cylinder
      enter = S::select(is_along, F(-1e10f), middle - half);
      leave = S::select(is_along, F(1e10f), middle + half);
      const auto misses = (is_along & (c >= one)) | ((root <= zero) & !is_along);
      if (element.kind != BlobElement::ball) {
        const F steep = finite_inverse<S>(along.z);
        const F at_zero = -from.z * steep;
        const auto rises = along.z > zero;
        if (is_cylinder) {
          const F at_end = (F(element.length) - from.z) * steep;
          enter = S::max(enter, S::min(at_zero, at_end));
          leave = S::min(leave, S::max(at_zero, at_end));
        } else {
          // A ray that rises leaves the lower half, and enters the upper one.
          const auto enters = element.kind == BlobElement::upper_half ? rises : !rises;
          enter = S::select(enters, S::max(enter, at_zero), enter);
          leave = S::select(enters, leave, S::min(leave, at_zero));
        }
      }
      leave = S::select(misses, enter - one, leave);
    }
  };

  /// The elements that some rays of a packet reach, or all from `rest` on.
  struct Selection {
    static constexpr uint32_t kMost = 256;
    uint32_t count = 0, rest;
    uint16_t element[kMost];

    uint32_t size(uint32_t elements) const { return count + (elements - rest); }
    uint32_t at(uint32_t i) const { return i < count ? element[i] : rest + (i - count); }
  };

  template <class S, class Numbers>
  static void intersect_data(const LocalRays<S>& rays, const Numbers& numbers, NearestCrossing<S>& nearest) {
    using F = typename S::F;
    using M = typename S::M;
    const F zero(0.0f), one(1.0f);
    const F threshold(numbers.at(0).value[0]);
    const uint32_t elements = (numbers.count() - 1) / BlobElement::kRecords;
    const F length = S::sqrt(dot<S>(rays.direction, rays.direction));
    const V3<S> d = rays.direction * (one / S::max(length, F(1e-30f)));
    const F middle = -dot<S>(rays.origin, d);
    const V3<S> o = rays.origin + d * middle;
    const F least(kLeastDistance);
    const F begin = S::max(rays.after(), least) * length - middle;
    const F limit = S::min(rays.limit() * length, F(1e10f)) - middle;
    const M continues = rays.after() > least;

    Selection selection;
    M lanes = M::none();
    selection.rest = elements;
    for (uint32_t i = 0; i < elements; ++i) {
      const Reach<S> reach(BlobElement(numbers, i), o, d);
      const M reached = (reach.leave > S::max(reach.enter, begin)) & (reach.enter < limit);
      if (reached.bits() == 0) continue;
      lanes = lanes | reached;
      if (selection.count == Selection::kMost) {
        selection.rest = i;
        break;
      }
      selection.element[selection.count++] = static_cast<uint16_t>(i);
    }
    if (selection.rest != elements) lanes = M::all();
    const uint32_t size = selection.size(elements);
    PolynomialRoots<S, BlobPrimitive, 4> roots;
    roots.degree = 4;
    F from = begin;
    bool is_first = true;
    // From one place on the ray where some element's field begins or ends to the next such place, the sum of
    // fields is one polynomial.
    for (uint32_t step = 0; step <= 2 * size && lanes.bits() != 0; ++step) {
      F sum[5] = {-threshold, zero, zero, zero, zero};
      F most = zero, to(1e10f);
      for (uint32_t i = 0; i < size; ++i) {
        const BlobElement element(numbers, selection.at(i));
        const Reach<S> reach(element, o, d);
        const M exists = reach.leave > reach.enter;
        const M is_ahead = exists & (reach.enter > from), is_here = exists & !is_ahead & (reach.leave > from);
        to = S::select(is_ahead, S::min(to, reach.enter), S::select(is_here, S::min(to, reach.leave), to));
        if (is_here.bits() == 0) continue;
        const F strength = S::select(is_here, F(element.strength), zero);
        most = most + S::max(strength, zero);
        const F e = one - reach.square[0], f = reach.square[1], g = reach.square[2];
        sum[0] = sum[0] + strength * e * e;
        sum[1] = sum[1] - strength * F(2.0f) * e * f;
        sum[2] = sum[2] + strength * (f * f - F(2.0f) * e * g);
        sum[3] = sum[3] + strength * F(2.0f) * f * g;
        sum[4] = sum[4] + strength * g * g;
      }
      const M searched = lanes & (most > threshold) & (to < F(1e10f));
      if (searched.bits() != 0) {
        // In the polynomial of w, s = from + w (to - from): its coefficients do not cancel.
        const F span = S::select(searched, to - from, one);
        shift(sum, S::select(searched, from, zero));
        F power = one;
        for (uint32_t k = 0; k <= 4; ++k) {
          roots.c[k] = sum[k] * power;
          power = power * span;
        }
        M found_here = M::none();
        roots.find(zero, one, searched, is_first ? continues : M::none(), [&](const F& w, const M& found) {
          const F t = (from + w * span + middle) / length;
          const M mine = found & !found_here & (t > nearest.after);
          nearest.offer(t, mine, {t, t, t});
          found_here = found_here | mine;
          return (searched & !found_here).bits() == 0;
        });
        lanes = lanes & !found_here;
      }
      lanes = lanes & (to < limit);
      from = to;
      is_first = false;
    }
    if (nearest.hit.bits() == 0) return;
    const V3<S> p = rays.origin + rays.direction * S::select(nearest.hit, nearest.t, zero);
    V3<S> gradient = {zero, zero, zero};
    for (uint32_t i = 0; i < size; ++i)
      add_field<S>(BlobElement(numbers, selection.at(i)), p, &gradient);
    nearest.normal = gradient;
  }

  /// Returns the field of an element at points. Adds its slope, outward, to `gradient` if it is not null.
  template <class S>
  static typename S::F add_field(const BlobElement& element, const V3<S>& p, V3<S>* gradient) {
    using F = typename S::F;
    const F zero(0.0f);
    V3<S> q = to_local<S>(element.map, p, 1.0f);
    auto reached = S::M::all();
    if (element.kind == BlobElement::cylinder) {
      reached = (q.z >= zero) & (q.z <= F(element.length));
      q.z = zero;
    }
    if (element.kind == BlobElement::lower_half) reached = q.z < zero;
    if (element.kind == BlobElement::upper_half) reached = q.z > zero;
    const F left = F(1.0f) - dot<S>(q, q);
    const F share = S::select(reached & (left > zero), F(element.strength) * left, zero);
    if (gradient != nullptr) {
      const float* const m = element.map;
      *gradient = *gradient + V3<S>{F(m[0]) * q.x + F(m[4]) * q.y + F(m[8]) * q.z,
                                    F(m[1]) * q.x + F(m[5]) * q.y + F(m[9]) * q.z,
                                    F(m[2]) * q.x + F(m[6]) * q.y + F(m[10]) * q.z} *
                                 share;
    }
    return share * left;
  }

  template <class S, class Numbers> static typename S::M inside_data(const V3<S>& p, const Numbers& numbers) {
    using F = typename S::F;
    constexpr float kTolerance = 1e-6f; // as in POV-Ray
    F sum(0.0f);
    const uint32_t elements = (numbers.count() - 1) / BlobElement::kRecords;
    for (uint32_t i = 0; i < elements; ++i)
      sum = sum + add_field<S>(BlobElement(numbers, i), p, nullptr);
    return sum > F(numbers.at(0).value[0] - kTolerance);
  }

  static LocalBounds local_bounds(float) { return {-1.0f, 1.0f, 1.0f, true}; }

private:
  /// Turns a polynomial of s into that of s - `by`.
  template <class F> static void shift(F (&c)[5], const F& by) {
    for (uint32_t i = 0; i < 4; ++i)
      for (uint32_t k = 4; k-- > i;)
        c[k] = c[k] + c[k + 1] * by;
  }
};

} // namespace celltrace::kernel
