// Lights. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

namespace light_flag {
constexpr uint32_t kind_mask = 0xFF;   ///< index of the light's type in lights/list.hpp
constexpr uint32_t shadowless = 0x100; ///< casts neither shadows nor highlights
constexpr uint32_t parallel = 0x200;   ///< all rays are parallel to the axis
constexpr uint32_t fades = 0x400;
constexpr uint32_t area = 0x800;        ///< has an area; its shadows are sampled at places on the area
constexpr uint32_t circular = 0x1000;   ///< the area is round
constexpr uint32_t orient = 0x2000;     ///< the area turns toward the surface
constexpr uint32_t jitter = 0x4000;     ///< places on the area are moved at random
constexpr uint32_t selective = 0x8000;  ///< some objects are not lit by this light
constexpr uint32_t projected = 0x10000; ///< shines only through its projector
constexpr uint32_t dimmed = 0x20000;    ///< fogs dim the light
} // namespace light_flag

/// Largest number of columns or rows of places on a light.
constexpr uint32_t kMaxLightPlaces = 256;

/// A light. A beam (spotlight or cylinder light) has an axis; the offset of a point from the axis is 0 on the
/// axis and 1 where the light ends.
struct alignas(128) LightRecord {
  float location[3];
  uint32_t kind_and_flags;
  float colour[3];
  float tightness;             ///< exponent of a beam's brightness across it
  float axis[3];               ///< unit vector away from the light; for beams and parallel lights
  float inverse_width;         ///< 1 / distance from the axis of a cylinder light at which the offset is 1
  float inner;                 ///< offset from the axis at which a beam's edge begins
  float inverse_edge;          ///< 1 / width of a beam's edge
  float inverse_fade_distance; ///< 1 / distance at which a fading light is as bright as without fading
  float fade_power;

  // For lights with an area:
  float across[3]; ///< vector from the first column of places to the last
  uint32_t columns;
  float along[3]; ///< vector from the first row of places to the last
  uint32_t rows;
  float inverse_columns, inverse_rows; ///< 1 / (columns - 1), 1 / (rows - 1)
  uint32_t adaptive;                   ///< number of times that the grid of places is always divided
  float axis_length;                   ///< distance from the location to the point that the light is aimed at

  /// `selective`: offset of words with a bit for each set of lights, which is set if the set contains this
  /// light.
  uint32_t lit_sets;
  uint32_t projector,
      projector_count; ///< `projected`: offset of the projector's first ObjectRecord; number of these
  /// Factor from |d|^fade_power to d^fade_power for a negative distance d in units of the fade distance: 1 or
  /// -1, or large enough to leave no light if the power is no real number. As in POV-Ray, distances behind a
  /// parallel light are negative.
  float fade_behind;
};
static_assert(sizeof(LightRecord) == 128, "one light a line");

} // namespace celltrace::kernel
