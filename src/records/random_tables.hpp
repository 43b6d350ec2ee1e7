// Tables of random numbers that patterns read. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

// Tables of random numbers, which the image has if a pattern reads them. All are POV-Ray's.

/// A random point in each of the unit cells of space, whose corner (x, y, z) gives the number
/// h(h(h(x) ^ y) ^ z), each coordinate modulo kFeatures, where h() is `hash` of the record of a number.
struct alignas(16) FeatureRecord {
  float place[3]; ///< in its cell, 0 to 1
  uint32_t hash;
};
static_assert(sizeof(FeatureRecord) == 16, "eight a line");
constexpr uint32_t kFeatures = 4096;

/// Of the noise of generator 3. The corner (x, y, z) of a cell has the gradient of record
/// next(next(x) + y) + z, all modulo kGradients.
struct alignas(16) GradientRecord {
  float gradient[3];
  uint32_t next;
};
static_assert(sizeof(GradientRecord) == 16, "eight a line");
constexpr uint32_t kGradients = 2048;

/// Of ripples and waves: where one comes from, and how often it comes.
struct alignas(16) WaveRecord {
  float source[3];
  float frequency; ///< of waves; ripples are all of 1
};
static_assert(sizeof(WaveRecord) == 16, "eight a line");

} // namespace celltrace::kernel
