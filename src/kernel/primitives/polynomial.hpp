// The polynomial: the surface where a polynomial of x, y and z is 0. Values below 0 are inside. Kernel dialect.
#pragma once

#include "kernel/primitives/data_shape.hpp"
#include "kernel/primitives/plane.hpp"
#include "kernel/primitives/polynomial_roots.hpp"

namespace celltrace::kernel {

/// The first record has the degree and the polynomial's scale, a distance from the origin beyond which its
/// terms of the highest degree prevail. The coefficients follow, four a record, in the order of Polynomial.
struct PolynomialPrimitive : DataPrimitive<PolynomialPrimitive> {
  static constexpr const char* kName = "polynomial";
  static constexpr bool kIsBounded = false;
  static constexpr uint32_t kMostDegree = 35;

  static constexpr CodeModule module() { return modules::kPolynomials; }

  /// Reads coefficients one after another.
  template <class Numbers> class Coefficients {
  public:
    explicit Coefficients(const Numbers& numbers) : numbers_(numbers) {}
    float next() {
      if ((next_ & 3) == 0) record_ = numbers_.at(1 + (next_ >> 2));
      return record_.value[next_++ & 3];
    }

  private:
    const Numbers& numbers_;
    ShapeDataRecord record_;
    uint32_t next_ = 0;
  };

  /// Multiplies p, of a degree that grows by 1, by from + along x.
  template <class F>
  [[gnu::always_inline]] static void multiply(F* p, uint32_t& degree, const F& from, const F& along) {
    p[degree + 1] = p[degree] * along;
    for (uint32_t k = degree; k > 0; --k)
      p[k] = p[k] * from + p[k - 1] * along;
    p[0] = p[0] * from;
    ++degree;
  }

  /// Sets the coefficients of the polynomial along rays from `from` along `along`: Horner's scheme in x, in y
  /// for each power of x, and in z for each power of y.
  template <class S, class Numbers>
  static void restrict_to(const V3<S>& from, const V3<S>& along, const Numbers& numbers,
                          PolynomialRoots<S, PolynomialPrimitive, kMostDegree>& roots) {
    using F = typename S::F;
    Coefficients<Numbers> coefficients(numbers);
    const uint32_t n = roots.degree;
    F* const in_x = roots.c;
    F* const in_y = roots.place;
    F* const in_z = roots.slope;
    for (uint32_t k = 0; k <= n; ++k)
      in_x[k] = F(0.0f);
    uint32_t degree_x = 0;
    for (uint32_t i = n + 1; i-- > 0;) {
      uint32_t degree_y = 0;
      in_y[0] = F(0.0f);
      for (uint32_t j = n - i + 1; j-- > 0;) {
        uint32_t degree_z = 0;
        in_z[0] = F(coefficients.next());
        for (uint32_t k = n - i - j; k-- > 0;) {
          multiply(in_z, degree_z, from.z, along.z);
          in_z[0] = in_z[0] + F(coefficients.next());
        }
        if (j < n - i) multiply(in_y, degree_y, from.y, along.y);
        for (uint32_t k = 0; k <= degree_z; ++k)
          in_y[k] = k <= degree_y ? in_y[k] + in_z[k] : in_z[k];
        degree_y = degree_z;
      }
      if (i < n) multiply(in_x, degree_x, from.x, along.x);
      for (uint32_t k = 0; k <= degree_y; ++k)
        in_x[k] = k <= degree_x ? in_x[k] + in_y[k] : in_y[k];
      degree_x = degree_y;
    }
  }

  /// Returns the polynomial at points, and its gradient, by the same scheme.
  template <class S, class Numbers>
  static typename S::F value(const V3<S>& p, const Numbers& numbers, uint32_t n, V3<S>& gradient) {
    using F = typename S::F;
    Coefficients<Numbers> coefficients(numbers);
    const F zero(0.0f);
    F f = zero;
    gradient = {zero, zero, zero};
    for (uint32_t i = n + 1; i-- > 0;) {
      F f_y = zero, y_by_y = zero, y_by_z = zero;
      for (uint32_t j = n - i + 1; j-- > 0;) {
        F f_z = zero, z_by_z = zero;
        for (uint32_t k = n - i - j + 1; k-- > 0;) {
          z_by_z = z_by_z * p.z + f_z;
          f_z = f_z * p.z + F(coefficients.next());
        }
        y_by_z = y_by_z * p.y + z_by_z;
        y_by_y = y_by_y * p.y + f_y;
        f_y = f_y * p.y + f_z;
      }
      gradient.z = gradient.z * p.x + y_by_z;
      gradient.y = gradient.y * p.x + y_by_y;
      gradient.x = gradient.x * p.x + f;
      f = f * p.x + f_y;
    }
    return f;
  }

  template <class S, class Numbers>
  static void intersect_data(const LocalRays<S>& rays, const Numbers& numbers, NearestCrossing<S>& nearest) {
    using F = typename S::F;
    using M = typename S::M;
    const ShapeDataRecord head = numbers.at(0);
    const F scale(head.value[1]), one(1.0f);
    // x is 0 where the ray is nearest to the origin, and 1 a scale farther.
    const F length = S::sqrt(dot<S>(rays.direction, rays.direction));
    const V3<S> d = rays.direction * (one / S::max(length, F(1e-30f)));
    const F middle = -dot<S>(rays.origin, d);
    const V3<S> o = rays.origin + d * middle;
    PolynomialRoots<S, PolynomialPrimitive, kMostDegree> roots;
    const auto n = static_cast<uint32_t>(head.value[0]);
    roots.degree = n;
    restrict_to<S>(o, d * scale, numbers, roots);
    const F to_x = one / scale;
    const F begin = (rays.after() * length - middle) * to_x;
    const M continues = rays.starts_here | (rays.after() > F(0.0f));
    M open = M::all();
    const auto take = [&](const F& x, const M& lanes) {
      const F t = (x * scale + middle) / length;
      const M mine = lanes & open;
      nearest.offer(t, mine, {t, t, t});
      open = open & !nearest.hit;
      return open.bits() == 0;
    };
    // Far away x gives way to -1/x, which is between -1 and 1 there and grows with x.
    const auto turn = [&] {
      for (uint32_t k = 0; 2 * k < n; ++k) {
        const F c = roots.c[k];
        roots.c[k] = roots.c[n - k];
        roots.c[n - k] = c;
      }
      for (uint32_t k = 1; k <= n; k += 2)
        roots.c[k] = -roots.c[k];
    };
    const auto search_far = [&](const F& low, const F& high, const M& lanes, const M& on_root) {
      const M some = lanes & open & !(roots.surely_none(one) & !on_root);
      if (some.bits() == 0) return;
      roots.find(low, high, some, on_root,
                 [&](const F& x, const M& found) { return take(-one / S::select(S::abs(x) > F(1e-20f), x, F(1e-20f)), found); });
    };
    const M begins_before = begin < -one;
    if (begins_before.bits() != 0) {
      turn();
      const F low = -one / S::min(begin, -one);
      search_far(S::select(begins_before, low, one), one, begins_before, continues & begins_before);
      turn();
      if (n % 2 == 1) // turning twice changes all signs
        for (uint32_t k = 0; k <= n; ++k)
          roots.c[k] = -roots.c[k];
    }
    const M begins_within = (begin < one) & open;
    if (begins_within.bits() != 0)
      roots.find(S::min(S::max(begin, -one), one), one, begins_within, continues & !begins_before, take);
    if (open.bits() != 0) {
      turn();
      const M begins_beyond = begin > one;
      const F low = S::select(begins_beyond, -one / S::max(begin, one), -one);
      search_far(low, F(-1e-7f), open, continues & begins_beyond);
    }
    V3<S> gradient;
    value<S>(rays.origin + rays.direction * S::select(nearest.hit, nearest.t, F(0.0f)), numbers, n, gradient);
    nearest.normal = gradient;
  }

  template <class S, class Numbers> static typename S::M inside_data(const V3<S>& p, const Numbers& numbers) {
    constexpr float kTolerance = 1e-4f; // as in POV-Ray
    V3<S> gradient;
    const auto n = static_cast<uint32_t>(numbers.at(0).value[0]);
    return value<S>(p, numbers, n, gradient) < typename S::F(kTolerance);
  }

  /// Returns unlimited bounds: polynomials are not in the BVH, unless CSG bounds them.
  static LocalBounds local_bounds(float) {
    constexpr float kUnbounded = PlanePrimitive::kUnboundedRadius;
    return {-kUnbounded, kUnbounded, kUnbounded, true};
  }
};

} // namespace celltrace::kernel
