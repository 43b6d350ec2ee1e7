// How pixels are sampled, and what is kept of samples. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

constexpr uint32_t kPacketEdge = 4; ///< a packet is 4x4 rays

/// What a frame is for. Where colours are asked for, a picture without antialiasing is a grid of its pixels'
/// middles, and the host takes them from there. With antialiasing a picture takes two: the points of a grid,
/// one more than pixels each way, then the samples that some pixels need besides. `blocks` is a picture whose
/// pixels leave the SPEs as blocks of BC1.
enum class FramePurpose : uint32_t { picture = 0, grid = 1, samples = 2, blocks = 3 };

/// POV-Ray's. `fixed`: grid points are the middles of pixels, from the one to the upper left of the picture
/// on, and pixels that differ from their neighbours get a number of samples. `adaptive`: they are the corners
/// of pixels, which are divided as long as theirs differ.
enum class SamplingMethod : uint32_t { fixed = 1, adaptive = 2 };

/// Pixels a side of the blocks that are sampled by themselves. POV-Ray's, where its fixed method does not
/// look from one to the next.
constexpr uint32_t kSampledEdge = 32;
constexpr uint32_t kMaxSamplingDepth = 9;
/// Colours of a packet of grid points, red of all first, then green, then blue, then how clear they are.
constexpr uint32_t kGridPacketBytes = 4 * 4 * kPacketEdge * kPacketEdge;

/// What the primary rays of a packet hit.
struct alignas(64) FirstHitRecord {
  float distance[kPacketEdge * kPacketEdge];
  float normal[3][kPacketEdge * kPacketEdge];
  uint32_t interior[kPacketEdge * kPacketEdge]; ///< offset of an InteriorRecord; kNoOffset: nothing was hit
};
static_assert(sizeof(FirstHitRecord) == 320, "crosses DMA");

/// How pixels are sampled.
struct SamplingRecord {
  uint32_t method; ///< SamplingMethod
  uint32_t depth;  ///< fixed: samples a row, and rows; adaptive: levels of squares, the pixel the first one
  float threshold; ///< of the difference of two colours, summed over the channels
  float jitter;    ///< pixels that a sample may be moved by, all in all
  float inverse_gamma; ///< power that colours are raised to before they are compared
  /// Bytes of a row of colours, a ColourRecord a pixel. The rows lie behind those of the surface; 0: colours
  /// are not asked for.
  uint32_t colours_pitch;
};

/// A pixel's colour as the rays brought it, and the share of what is behind the scene that comes through
/// (light_way::alpha).
struct alignas(16) ColourRecord {
  float channel[4];
};

} // namespace celltrace::kernel
