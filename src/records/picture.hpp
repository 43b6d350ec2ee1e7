// Pictures that patterns read. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// How a pattern reads a picture.
struct alignas(128) PictureRecord {
  uint32_t tiles;         ///< offset of the first TexelTileRecord; tiles are in rows from the top left
  uint32_t width, height; ///< in texels
  uint32_t tile_columns;
  uint32_t mapping;       ///< POV-Ray's map_type: 0, 1, 2 or 5
  uint32_t interpolation; ///< POV-Ray's number: 0, 2, 3 or 4
  uint32_t once;          ///< 1: there is one copy of the picture
  uint32_t reads_transmit; ///< 1: of patterns, the value is the transmittance in place of the grey
  float repeat[2];        ///< copies per unit
  float offset[2];        ///< in widths and heights of the picture
  float scale;            ///< of colours; texels are shares of it
  float filter, transmit; ///< added to all texels
  uint32_t unused[17];
};
static_assert(sizeof(PictureRecord) == 128, "one a line");

/// 4x4 neighbouring texels, so that a fetch brings the neighbours that interpolation reads. Two words each:
/// red and green, blue and transmittance, the former in the upper half; 65535 is 1.
struct alignas(128) TexelTileRecord {
  static constexpr uint32_t kSide = 4;
  uint32_t word[2 * kSide * kSide];
};
static_assert(sizeof(TexelTileRecord) == 128, "one a line");

} // namespace celltrace::kernel
