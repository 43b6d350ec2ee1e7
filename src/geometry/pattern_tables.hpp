// The tables of random numbers that patterns read, as measured from POV-Ray 3.7.
#pragma once

#include "celltrace/transform.hpp"
#include "records/random_tables.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace celltrace {

/// Factor of the vectors of noise generator 3.
constexpr double kGradientStrength = 0.795;
struct GradientTables {
  std::array<Vec3, kernel::kGradients> gradient; ///< unit vectors
  std::array<std::uint32_t, kernel::kGradients> next;
};
const GradientTables& gradient_tables();

std::vector<kernel::FeatureRecord> make_features();
/// Returns the vectors of gradient_tables() times kGradientStrength.
std::vector<kernel::GradientRecord> make_gradients();
std::vector<kernel::WaveRecord> make_waves(int count);

} // namespace celltrace
