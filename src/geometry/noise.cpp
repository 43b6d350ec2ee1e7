#include "geometry/noise.hpp"

#include "geometry/pattern_tables.hpp"
#include "kernel/textures/noise_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace celltrace {

namespace {

using kernel::noise::kHash;
using kernel::noise::kLattice;
using kernel::noise::kPeriod;

/// Limit on coordinates: POV-Ray's lattice numbers overflow above it.
constexpr double kFarthestInteger = 2147483647.0;

double near_enough(double coordinate) {
  return std::isfinite(coordinate) ? std::clamp(coordinate, -kFarthestInteger, kFarthestInteger) : 0;
}

/// The cell around a point.
struct Cell {
  std::uint32_t lattice[3][2];
  double from[3][2];   ///< distances from the lattice planes below and above
  double weight[3][2]; ///< weights of these planes

  Cell(const Vec3& p, double offset, std::uint32_t period) {
    for (int axis = 0; axis < 3; ++axis) {
      const double coordinate = near_enough(p[axis]) + offset;
      const double below = std::floor(coordinate);
      lattice[axis][0] = static_cast<std::uint32_t>(static_cast<std::int64_t>(below)) & (period - 1);
      lattice[axis][1] = (lattice[axis][0] + 1) & (period - 1);
      const double a = coordinate - below;
      from[axis][0] = a;
      from[axis][1] = a - 1;
      weight[axis][1] = a * a * (3 - 2 * a);
      weight[axis][0] = 1 - weight[axis][1];
    }
  }
};

/// Returns the index in table() of the first number for a corner of the cell.
std::uint32_t place(const Cell& cell, int x, int y, int z) {
  const std::uint32_t in_row = kHash.entry[cell.lattice[0][x]];
  const std::uint32_t in_column = kHash.entry[in_row ^ cell.lattice[1][y]];
  return kHash.entry[in_column ^ cell.lattice[2][z]] & 255u;
}

/// Returns a number of kLattice as the double nearest to its decimal, which has six significant digits.
double table_value(std::uint32_t entry) {
  const double value = kLattice[entry];
  if (value == 0) return 0;
  const double digits = std::pow(10, 5 - std::floor(std::log10(std::fabs(value))));
  return std::round(value * digits) / digits;
}

const std::array<double, 267>& table() {
  static const std::array<double, 267> values = [] {
    std::array<double, 267> result{};
    for (std::uint32_t i = 0; i < result.size(); ++i)
      result[i] = table_value(i);
    return result;
  }();
  return values;
}

double corner(const Cell& cell, int x, int y, int z, std::uint32_t first) {
  const auto& t = table();
  const std::uint32_t m = place(cell, x, y, z) + first;
  return (cell.weight[0][x] * cell.weight[1][y]) * cell.weight[2][z] *
         (t[m] / 2 + t[m + 1] * cell.from[0][x] + t[m + 2] * cell.from[1][y] + t[m + 3] * cell.from[2][z]);
}

/// The orders in which POV-Ray adds the corners, so that sums are equal to the last bit.
constexpr int kScalarOrder[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                    {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
constexpr int kVectorOrder[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                    {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, {0, 0, 1}};
constexpr double kLatticeOffset = 10000;

// ---- Generator 3: gradient noise ----

double gradient_noise(const Vec3& p) {
  constexpr double kOffset = 10000000.023157213;
  const Cell cell(p, kOffset, kernel::kGradients);
  const GradientTables& tables = gradient_tables();
  double sum = 0;
  for (const auto& [x, y, z] : kScalarOrder) {
    const std::uint32_t row = tables.next[cell.lattice[0][x]];
    const std::uint32_t column = tables.next[(row + cell.lattice[1][y]) % kernel::kGradients];
    const Vec3& gradient = tables.gradient[(column + cell.lattice[2][z]) % kernel::kGradients];
    sum += cell.weight[0][x] * cell.weight[1][y] * cell.weight[2][z] *
           (gradient.x * cell.from[0][x] + gradient.y * cell.from[1][y] + gradient.z * cell.from[2][z]);
  }
  return std::clamp(0.4925 + kGradientStrength * sum, 0.0, 1.0);
}

} // namespace

Vec3 noise_vector(const Vec3& p) {
  const Cell cell(p, kLatticeOffset, kPeriod);
  Vec3 sum{0, 0, 0};
  for (const auto& [x, y, z] : kVectorOrder)
    for (int axis = 0; axis < 3; ++axis)
      sum[axis] += corner(cell, x, y, z, static_cast<std::uint32_t>(4 * axis));
  return sum;
}

Vec3 turbulence_vector(const Vec3& p, int octaves, double lambda, double omega) {
  Vec3 sum{0, 0, 0};
  double scale = 1, strength = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += noise_vector(p * scale) * strength;
    scale *= lambda;
    strength *= omega;
  }
  return sum;
}

double noise_value(const Vec3& p, int generator) {
  if (generator == 3) return gradient_noise(p);
  const Cell cell(p, kLatticeOffset, kPeriod);
  double sum = 0;
  for (const auto& [x, y, z] : kScalarOrder)
    sum += corner(cell, x, y, z, 0);
  return std::clamp(generator == 1 ? sum + 0.5 : (sum + 1.05242) * 0.48985582, 0.0, 1.0);
}

} // namespace celltrace
