// Polynomials in double precision.
#pragma once

#include <vector>

namespace celltrace {

/// Returns the real roots in a range, ascending. `c` are the coefficients of t to the power 0, 1, ...
std::vector<double> roots(const std::vector<double>& c, double from, double to);

} // namespace celltrace
