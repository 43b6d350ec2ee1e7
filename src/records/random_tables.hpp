// Tables of random numbers that patterns read. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

// The image has a table if a pattern reads it. All random numbers are POV-Ray's.

/// A random point in a unit cell of space. The cell with corner (x, y, z) has the record with number h(h(h(x)
/// ^ y) ^ z), each coordinate modulo kFeatures, where h(n) is `hash` of record n.
struct alignas(16) FeatureRecord {
  float place[3]; ///< position in its cell, 0 to 1
  uint32_t hash;
};
static_assert(sizeof(FeatureRecord) == 16, "eight a line");
constexpr uint32_t kFeatures = 4096;

/// A gradient of noise generator 3. The corner (x, y, z) of a cell has the gradient of record next(next(x) +
/// y) + z, all modulo kGradients.
struct alignas(16) GradientRecord {
  float gradient[3];
  uint32_t next;
};
static_assert(sizeof(GradientRecord) == 16, "eight a line");
constexpr uint32_t kGradients = 2048;

/// A source of ripples or waves and its frequency.
struct alignas(16) WaveRecord {
  float source[3];
  float frequency; ///< frequency of waves; all ripples have frequency 1
};
static_assert(sizeof(WaveRecord) == 16, "eight a line");

} // namespace celltrace::kernel
