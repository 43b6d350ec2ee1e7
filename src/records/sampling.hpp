// Sampling of pixels, and the storage of samples. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

constexpr uint32_t kPacketEdge = 4; ///< a packet is 4x4 rays

/// Purpose of a frame. If colours are requested, a picture without antialiasing is traced as a grid of its
/// pixels' middles, from which the host takes the colours. An antialiased picture takes two frames: the
/// points of a grid, with one point more than pixels in each direction, then the additional samples of some
/// pixels. `blocks` is a picture whose pixels leave the SPEs as blocks of BC1.
enum class FramePurpose : uint32_t { picture = 0, grid = 1, samples = 2, blocks = 3 };

/// POV-Ray's sampling methods. `fixed`: grid points are the middles of pixels, beginning one pixel to the
/// upper left of the picture; pixels that differ from their neighbours get a fixed number of samples.
/// `adaptive`: grid points are the corners of pixels; squares whose corners differ are divided.
enum class SamplingMethod : uint32_t { fixed = 1, adaptive = 2 };

/// Pixels per side of a block that is sampled independently, as in POV-Ray, where the fixed method does not
/// compare pixels of different blocks.
constexpr uint32_t kSampledEdge = 32;
constexpr uint32_t kMaxSamplingDepth = 9;
/// Bytes of a packet of grid points: red of all points, then green, blue, and transparency.
constexpr uint32_t kGridPacketBytes = 4 * 4 * kPacketEdge * kPacketEdge;

/// First hits of a packet's primary rays.
struct alignas(64) FirstHitRecord {
  float distance[kPacketEdge * kPacketEdge];
  float normal[3][kPacketEdge * kPacketEdge];
  uint32_t interior[kPacketEdge * kPacketEdge]; ///< offset of an InteriorRecord; kNoOffset: no hit
};
static_assert(sizeof(FirstHitRecord) == 320, "crosses DMA");

/// Parameters of sampling.
struct SamplingRecord {
  uint32_t method; ///< SamplingMethod
  uint32_t depth;  ///< fixed: rows, and samples per row; adaptive: levels of squares, of which the pixel is
                   ///< the first
  float threshold; ///< least difference of two colours that counts, summed over the channels
  float jitter;    ///< total range of random moves of a sample, in pixels
  float inverse_gamma; ///< exponent applied to colours before comparison
  /// Bytes of a row of ColourRecords, one per pixel, or 0 if colours are not requested. The rows of
  /// ColourRecords follow the rows of the surface.
  uint32_t colours_pitch;
};

/// The linear colour of a pixel as traced, and the share of the light from behind the scene that the pixel
/// lets through (light_feature::alpha).
struct alignas(16) ColourRecord {
  float channel[4];
};

} // namespace celltrace::kernel
