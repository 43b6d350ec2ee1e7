#include "geometry/polynomial.hpp"

#include <cstddef>

namespace celltrace {

namespace {

double polynomial(const std::vector<double>& c, double t) {
  double value = 0;
  for (std::size_t i = c.size(); i-- > 0;)
    value = value * t + c[i];
  return value;
}

} // namespace

std::vector<double> roots(const std::vector<double>& c, double from, double to) {
  if (c.size() < 2) return {};
  // Between two roots of the derivative there is at most one root.
  std::vector<double> derivative;
  for (std::size_t i = 1; i < c.size(); ++i)
    derivative.push_back(static_cast<double>(i) * c[i]);
  std::vector<double> ends = roots(derivative, from, to);
  ends.push_back(to);
  std::vector<double> result;
  double low = from;
  for (const double end : ends) {
    double high = end;
    const double at_low = polynomial(c, low), at_high = polynomial(c, high);
    if (at_low == 0 || at_low * at_high < 0) {
      double inside = low;
      for (int step = 0; step < 200 && at_low != 0; ++step) {
        const double middle = (inside + high) / 2;
        if (middle == inside || middle == high) break;
        (polynomial(c, middle) * at_low > 0 ? inside : high) = middle;
      }
      result.push_back(inside);
    }
    low = end;
  }
  return result;
}

} // namespace celltrace
