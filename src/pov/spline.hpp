// Splines as they are declared: vectors at numbers, and the interpolation between them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pov/location.hpp"
#include "pov/quantity.hpp"

namespace celltrace::pov {

struct Session;

class Spline {
public:
  enum class Kind { linear, quadratic, cubic, natural };

  Kind kind = Kind::linear;

  /// Adds a knot, or replaces the one at the same number.
  void add(double at, const Quantity& value);
  std::size_t size() const { return knots_.size(); }
  /// Returns the number of components of the longest vector, at least 2.
  int components() const { return count_; }

  /// Returns a vector with as many components as the longest knot. There must be a knot. Beyond its ends a
  /// spline is constant; a cubic one goes from its second knot to its last but one only.
  Quantity value(double at) const { return value(at, kind); }
  /// Returns the value that a spline of another kind would have.
  Quantity value(double at, Kind other) const;

private:
  struct Knot {
    double at;
    Quantity value;
  };
  template <class Component> Quantity vector_of(Component component) const;
  Quantity linear(std::size_t left, double at) const;
  Quantity quadratic(std::size_t left, double at) const;
  Quantity cubic(std::size_t left, double at) const;
  Quantity natural(std::size_t left, double at) const;
  /// Returns the second derivatives at the knots, 0 at both ends.
  std::vector<Quantity> curvatures() const;
  Quantity slope(std::size_t left) const;

  std::vector<Knot> knots_; // ascending
  int count_ = 2;           // number of components
  mutable std::vector<Quantity> curvatures_;
};
using SplinePtr = std::shared_ptr<const Spline>;

} // namespace celltrace::pov
