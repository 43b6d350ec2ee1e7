// The tables of random numbers that patterns read, as measured from POV-Ray 3.7.
#pragma once

#include "kernel/records.hpp"

#include <vector>

namespace celltrace {

std::vector<kernel::FeatureRecord> make_features();
std::vector<kernel::GradientRecord> make_gradients();
std::vector<kernel::WaveRecord> make_waves(int count);

} // namespace celltrace
