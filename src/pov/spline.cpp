#include "pov/spline.hpp"

#include <algorithm>

namespace celltrace::pov {

void Spline::add(double at, const Quantity& value) {
  curvatures_.clear();
  count_ = std::max(count_, value.count);
  const auto place = std::lower_bound(knots_.begin(), knots_.end(), at,
                                      [](const Knot& knot, double number) { return knot.at < number; });
  // A float stands for a vector of two; what a shorter vector lacks is 0.
  Quantity vector = value.is_float() ? value.promoted(2) : value;
  vector.is_colour = false;
  if (place != knots_.end() && place->at == at)
    place->value = vector;
  else
    knots_.insert(place, {at, vector});
}

Quantity Spline::value(double at, Kind other) const {
  const std::size_t last = knots_.size() - 1;
  // Of a cubic one the ends only say how steep it is.
  const std::size_t margin = other == Kind::cubic && last > 0 ? 1 : 0;
  const auto constant = [&](std::size_t knot) { return knots_[knot].value.promoted(count_); };
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

Quantity Spline::linear(std::size_t left, double at) const {
  const Knot &a = knots_[left], &b = knots_[left + 1];
  return a.value.promoted(count_) + (b.value - a.value) * Quantity((at - a.at) / (b.at - a.at));
}

/// The parabola through both knots and the one before; in the first segment, the one behind.
Quantity Spline::quadratic(std::size_t left, double at) const {
  const std::size_t middle = std::max<std::size_t>(left, 1);
  Quantity sum = Quantity(0).promoted(count_);
  for (std::size_t i = middle - 1; i <= middle + 1; ++i) {
    double weight = 1; // Lagrange's
    for (std::size_t j = middle - 1; j <= middle + 1; ++j)
      if (j != i) weight *= (at - knots_[j].at) / (knots_[i].at - knots_[j].at);
    sum = sum + knots_[i].value * Quantity(weight);
  }
  return sum;
}

Quantity Spline::slope(std::size_t left) const {
  const Knot &a = knots_[left], &b = knots_[left + 1];
  return (b.value - a.value) * Quantity(1 / (b.at - a.at));
}

/// Hermite's interpolation; at a knot it is as steep as the segments on both sides are on average.
Quantity Spline::cubic(std::size_t left, double at) const {
  const Knot &a = knots_[left], &b = knots_[left + 1];
  const double width = b.at - a.at, t = (at - a.at) / width;
  const Quantity start = (slope(left - 1) + slope(left)) * Quantity(width / 2);
  const Quantity end = (slope(left) + slope(left + 1)) * Quantity(width / 2);
  return (a.value * Quantity((2 * t - 3) * t * t + 1) + b.value * Quantity((3 - 2 * t) * t * t) +
          start * Quantity(((t - 2) * t + 1) * t) + end * Quantity((t - 1) * t * t))
      .promoted(count_);
}

Quantity Spline::natural(std::size_t left, double at) const {
  if (curvatures_.empty()) curvatures_ = curvatures();
  const Knot &a = knots_[left], &b = knots_[left + 1];
  const double width = b.at - a.at;
  const double t = (at - a.at) / width, u = 1 - t;
  const double square = width * width / 6;
  return a.value.promoted(count_) * Quantity(u) + b.value * Quantity(t) +
         curvatures_[left] * Quantity((u * u * u - u) * square) +
         curvatures_[left + 1] * Quantity((t * t * t - t) * square);
}

/// The tridiagonal system of the natural cubic spline, by Thomas' algorithm.
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
