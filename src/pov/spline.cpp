#include "pov/spline.hpp"

#include <algorithm>
#include <cmath>

namespace celltrace::pov {

void Spline::add(double at, const Quantity& value) {
  curvatures_.clear();
  count_ = std::max(count_, value.count);
  const auto place = std::lower_bound(knots_.begin(), knots_.end(), at,
                                      [](const Knot& knot, double number) { return knot.at < number; });
  // A float becomes a vector of two; missing components are 0.
  Quantity vector = value.is_float() ? value.promoted(2) : value;
  vector.is_colour = false;
  if (place != knots_.end() && place->at == at)
    place->value = vector;
  else
    knots_.insert(place, {at, vector});
}

Quantity Spline::value(double at, Kind other) const {
  const std::size_t last = knots_.size() - 1;
  // The ends of a cubic spline only set its slope.
  const std::size_t margin = other == Kind::cubic && last > 0 ? 1 : 0;
  const auto constant = [&](std::size_t knot) { return knots_[knot].value.promoted(count_); };
  // The value for NaN is POV-Ray's.
  if (std::isnan(at)) return other == Kind::cubic ? constant(margin) : Quantity(at).promoted(count_);
  if (last < 2 * margin) return linear(0, (knots_[0].at + knots_[1].at) / 2);
  if (at <= knots_[margin].at) return constant(margin);
  if (at >= knots_[last - margin].at) return constant(last - margin);
  const auto right = std::upper_bound(knots_.begin(), knots_.end(), at,
                                      [](double number, const Knot& knot) { return number < knot.at; });
  const auto left = static_cast<std::size_t>(right - knots_.begin()) - 1;
  switch (other) {
  case Kind::linear:
    return linear(left, at);
  case Kind::quadratic:
    return last < 2 ? linear(left, at) : quadratic(left, at);
  case Kind::cubic:
    return cubic(left, at);
  case Kind::natural:
    return natural(left, at);
  }
  return constant(left);
}

/// Returns a vector, calculated component by component.
template <class Component> Quantity Spline::vector_of(Component component) const {
  Quantity result;
  result.count = count_;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i)
    result.v[i] = component(i);
  return result;
}

Quantity Spline::linear(std::size_t left, double at) const {
  const Knot &a = knots_[left], &b = knots_[left + 1];
  const double share = (at - a.at) / (b.at - a.at);
  return vector_of([&](std::size_t i) { return a.value.v[i] + (b.value.v[i] - a.value.v[i]) * share; });
}

/// Returns a point on the parabola through the knots of the segment and the one before it; in the first
/// segment, the one after it.
Quantity Spline::quadratic(std::size_t left, double at) const {
  const std::size_t first = std::max<std::size_t>(left, 1) - 1;
  const Knot* const knots = &knots_[first];
  double weights[3]; // Lagrange's weights
  for (std::size_t i = 0; i < 3; ++i) {
    weights[i] = 1;
    for (std::size_t j = 0; j < 3; ++j)
      if (j != i) weights[i] *= (at - knots[j].at) / (knots[i].at - knots[j].at);
  }
  return vector_of([&](std::size_t i) {
    return 0 + knots[0].value.v[i] * weights[0] + knots[1].value.v[i] * weights[1] +
           knots[2].value.v[i] * weights[2];
  });
}

Quantity Spline::slope(std::size_t left) const {
  const Knot &a = knots_[left], &b = knots_[left + 1];
  const double inverse_width = 1 / (b.at - a.at);
  return vector_of([&](std::size_t i) { return (b.value.v[i] - a.value.v[i]) * inverse_width; });
}

/// Interpolates by Hermite's formula; the slope at a knot is the mean of the segments on both sides.
Quantity Spline::cubic(std::size_t left, double at) const {
  const Knot &a = knots_[left], &b = knots_[left + 1];
  const double width = b.at - a.at, t = (at - a.at) / width, half = width / 2;
  const Quantity before = slope(left - 1), here = slope(left), behind = slope(left + 1);
  const double of_a = (2 * t - 3) * t * t + 1, of_b = (3 - 2 * t) * t * t;
  const double of_start = ((t - 2) * t + 1) * t, of_end = (t - 1) * t * t;
  return vector_of([&](std::size_t i) {
    const double start = (before.v[i] + here.v[i]) * half, end = (here.v[i] + behind.v[i]) * half;
    return a.value.v[i] * of_a + b.value.v[i] * of_b + start * of_start + end * of_end;
  });
}

Quantity Spline::natural(std::size_t left, double at) const {
  if (curvatures_.empty()) curvatures_ = curvatures();
  const Knot &a = knots_[left], &b = knots_[left + 1];
  const double width = b.at - a.at;
  const double t = (at - a.at) / width, u = 1 - t;
  const double square = width * width / 6;
  const double of_left = (u * u * u - u) * square, of_right = (t * t * t - t) * square;
  const Quantity &bend = curvatures_[left], &next_bend = curvatures_[left + 1];
  return vector_of([&](std::size_t i) {
    return a.value.v[i] * u + b.value.v[i] * t + bend.v[i] * of_left + next_bend.v[i] * of_right;
  });
}

/// Solves the tridiagonal system of the natural cubic spline by Thomas' algorithm.
std::vector<Quantity> Spline::curvatures() const {
  const std::size_t count = knots_.size();
  std::vector<Quantity> result(count, Quantity(0).promoted(count_));
  std::vector<double> ratio(count, 0);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double before = knots_[i].at - knots_[i - 1].at, behind = knots_[i + 1].at - knots_[i].at;
    const double pivot = 2 * (before + behind) - before * ratio[i - 1];
    ratio[i] = behind / pivot;
    result[i] =
        ((slope(i) - slope(i - 1)) * Quantity(6) - result[i - 1] * Quantity(before)) * Quantity(1 / pivot);
  }
  for (std::size_t i = count - 1; i-- > 1;)
    result[i] = result[i] - result[i + 1] * Quantity(ratio[i]);
  return result;
}

} // namespace celltrace::pov
