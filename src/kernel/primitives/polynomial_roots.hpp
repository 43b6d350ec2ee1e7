// Roots of polynomials in one variable. Kernel dialect.
#pragma once

#include "kernel/math.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// Finds the roots of polynomials, one in each lane, of one degree of at most kMost, for the shape Owner, in
/// whose code module the search is. Between two roots of its
/// derivative a polynomial has at most one root. Therefore the search begins with the derivative of degree
/// 1, and the roots of each derivative divide the range for the next one; there is no recursion.
template <class S, class Owner, uint32_t kMost> class PolynomialRoots {
public:
  using F = typename S::F;
  using M = typename S::M;

  F c[kMost + 1];      ///< coefficients, the constant first
  F place[kMost + 2];  ///< room for the search
  F slope[kMost + 1];  ///< room for the search
  uint32_t degree = 0;

  /// Sets the value at `high`, which otherwise is computed: where two pieces of a curve meet, their values
  /// then have the same sign.
  void set_end(const F& value) {
    end_ = value;
    has_end_ = true;
  }
  void clear_end() { has_end_ = false; }

  F at(const F& x) const { return horner(c, degree, x); }
  F slope_at(const F& x) const {
    F f, df;
    both(c, degree, x, f, df);
    return df;
  }

  /// Returns the lanes whose constant is greater than all other terms can be for |x| <= `reach`, so that they
  /// have no roots there.
  M surely_none(const F& reach) const {
    F rest(0.0f);
    for (uint32_t k = degree; k > 0; --k)
      rest = (rest + S::abs(c[k])) * reach;
    return S::abs(c[0]) > rest * F(1.0001f);
  }

  /// Calls visit(root, lanes) for the roots between `low` and `high`, of which each lane gets its own in
  /// ascending order, until it returns true. In lanes of `begins_on_root` there is a root at `low`, which is
  /// not found again: the sign behind it is that of the derivative.
  template <class Visit>
  void find(const F& low, const F& high, const M& lanes, const M& begins_on_root, const Visit& visit) {
    place[0] = low;
    place[1] = high;
    for (uint32_t d = 1; d < degree; ++d) {
      differentiate(degree - d);
      F a = place[0], f_a = horner(slope, d, a);
      for (uint32_t i = 0; i < d; ++i) {
        const F b = place[i + 1], f_b = horner(slope, d, b);
        place[i + 1] = root_between(slope, d, a, b, f_a, changes(f_a, f_b) & lanes, kInnerSteps);
        a = b;
        f_a = f_b;
      }
      place[d + 1] = high;
    }
    F a = place[0];
    F f_a = S::select(begins_on_root, slope_at(a), at(a));
    for (uint32_t i = 0; i < degree; ++i) {
      const F b = place[i + 1];
      const F f_b = has_end_ && i + 1 == degree ? end_ : at(b);
      const M found = changes(f_a, f_b) & lanes;
      if (found.bits() != 0 && visit(root_between(c, degree, a, b, f_a, found, kSteps), found)) return;
      a = b;
      f_a = f_b;
    }
  }

private:
  static constexpr uint32_t kInnerSteps = 12, kSteps = 24;

  static M changes(const F& a, const F& b) {
    const M below_a = a < F(0.0f), below_b = b < F(0.0f);
    return (below_a & !below_b) | (below_b & !below_a);
  }
  static F horner(const F* p, uint32_t degree, const F& x) {
    F f = p[degree];
    for (uint32_t k = degree; k-- > 0;)
      f = f * x + p[k];
    return f;
  }
  static void both(const F* p, uint32_t degree, const F& x, F& f, F& df) {
    f = p[degree];
    df = F(0.0f);
    for (uint32_t k = degree; k-- > 0;) {
      df = df * x + f;
      f = f * x + p[k];
    }
  }
  /// Sets `slope` to the derivative of `order`, divided by the factorial of `order`.
  void differentiate(uint32_t order) {
    float binomial = 1.0f;
    for (uint32_t k = 0; k + order <= degree; ++k) {
      slope[k] = c[k + order] * F(binomial);
      binomial = binomial * static_cast<float>(k + order + 1) / static_cast<float>(k + 1);
    }
  }
  /// Returns the root between a and b in `lanes`, where the sign changes, and b in the other lanes. Takes
  /// Newton's steps, and halves the range where such a step would leave it.
  static F root_between(const F* p, uint32_t degree, const F& a, const F& b, const F& f_a, const M& lanes,
                        uint32_t steps) {
    if (lanes.bits() == 0) return b;
    const M falls = !(f_a < F(0.0f));
    F low = a, high = b, x = (a + b) * F(0.5f);
    M done = !lanes;
    for (uint32_t step = 0; step < steps; ++step) {
      F f, df;
      both(p, degree, x, f, df);
      const M is_before = (falls & (f >= F(0.0f))) | ((!falls) & (f < F(0.0f)));
      low = S::select(is_before, x, low);
      high = S::select(is_before, high, x);
      const F newton = x - f / S::select(S::abs(df) > F(1e-30f), df, F(1e-30f));
      const M stays = (newton >= low) & (newton <= high);
      const F next = S::select(stays, newton, (low + high) * F(0.5f));
      const M is_close = S::abs(next - x) <= S::abs(next) * F(3e-7f) + F(1e-12f);
      x = S::select(done, x, next);
      done = done | is_close;
      if ((!done).bits() == 0) break;
    }
    return S::select(lanes, x, b);
  }

  F end_;
  bool has_end_ = false;
};

} // namespace celltrace::kernel
