// Lights. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

namespace light_flag {
constexpr uint32_t kind_mask = 0xFF;   ///< the place of its kind in the list of lights/list.hpp
constexpr uint32_t shadowless = 0x100; ///< neither shadows nor highlights
constexpr uint32_t parallel = 0x200;   ///< all its rays go along its axis
constexpr uint32_t fades = 0x400;
constexpr uint32_t area = 0x800;        ///< has an area, which shadows are looked for on
constexpr uint32_t circular = 0x1000;   ///< that is round,
constexpr uint32_t orient = 0x2000;     ///< turns to surfaces,
constexpr uint32_t jitter = 0x4000;     ///< and whose places are moved at random
constexpr uint32_t selective = 0x8000;  ///< there are objects that it does not shine on
constexpr uint32_t projected = 0x10000; ///< shines through its projector alone
constexpr uint32_t dimmed = 0x20000;    ///< by fogs
} // namespace light_flag

/// Columns or rows of places on a light.
constexpr uint32_t kMaxLightPlaces = 256;

/// Beams have an axis, from which every point is some way off: 0 on it, 1 where there is no light any more.
struct alignas(128) LightRecord {
  float location[3];
  uint32_t kind_and_flags;
  float colour[3];
  float tightness;             ///< of a beam
  float axis[3];               ///< of unit length, away from the light; of beams and parallel lights
  float inverse_width;         ///< of a cylinder: of the distance from the axis that is 1 way off
  float inner;                 ///< way off where a beam's edge begins
  float inverse_edge;          ///< of the edge's width
  float inverse_fade_distance; ///< where there is as much light as without fading
  float fade_power;

  // Of a light with an area.
  float across[3]; ///< from the first column of places to the last
  uint32_t columns;
  float along[3]; ///< from the first row to the last
  uint32_t rows;
  float inverse_columns, inverse_rows; ///< of columns - 1, rows - 1
  uint32_t adaptive;                   ///< times that the grid is divided in any case
  float axis_length;                   ///< from the location to where the light points

  /// Selective: offset of words with a bit for each set of lights, whether it has this one.
  uint32_t lit_sets;
  uint32_t projector, projector_count; ///< projected: offset of the first ObjectRecord that it shines through
  /// The power of a negative distance, in units of that of fading, over the power of the positive one: 1 or
  /// -1, or so much that no light is left where it is no number. As in POV-Ray, whose distances behind
  /// parallel light are negative.
  float fade_behind;
};
static_assert(sizeof(LightRecord) == 128, "one light a line");

} // namespace celltrace::kernel
