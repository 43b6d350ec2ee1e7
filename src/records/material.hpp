// Materials: textures, finishes and interiors. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// A normal: a disturbance of surface normals by a pattern. `linear` maps surface normals to the pattern's
/// space.
struct alignas(64) NormalRecord {
  uint32_t pattern; ///< offset of a PatternRecord
  /// 1: the pattern's entries are NormalRecords, and the members below are unused. 0: the entries are a slope
  /// map.
  uint32_t is_mapped;
  float amount;
  float accuracy;  ///< distance at which slopes of the pattern are measured
  float linear[9]; ///< three rows
  uint32_t unused[3];
};
static_assert(sizeof(NormalRecord) == 64, "two a line");

namespace material_flag {
constexpr uint32_t fresnel = 0x1;
constexpr uint32_t conserve_energy = 0x2;
constexpr uint32_t patterned = 0x4; ///< `pattern` determines the pigment
constexpr uint32_t disturbed = 0x8; ///< has a normal
constexpr uint32_t layered = 0x10;  ///< has a layer below
constexpr uint32_t mapped = 0x20;   ///< texture map: `pattern` has MaterialRecords; other members are unused
constexpr uint32_t old_opacity = 0x40; ///< filter counts by the brightest channel, as before version 3.7
// Flags of members: a member is only read if the flag that concerns it is set.
constexpr uint32_t brilliance = 0x80; ///< brilliance is not 1
constexpr uint32_t phong = 0x100;
constexpr uint32_t specular = 0x200;
constexpr uint32_t highlights = phong | specular;
constexpr uint32_t metallic = 0x400; ///< highlights have the colour of the surface
constexpr uint32_t reflects = 0x800;
constexpr uint32_t metallic_mirror = 0x1000;
constexpr uint32_t falloff = 0x2000;             ///< the falloff of reflection is not 1
constexpr uint32_t reflection_exponent = 0x4000; ///< the exponent of reflection is not 1
constexpr uint32_t transmits = 0x8000; ///< constants let light through; a pattern may do so without this flag
} // namespace material_flag

/// A texture or one layer of it: pigment, normal and finish. Numbers that are constant in a frame are
/// computed beforehand.
struct alignas(128) MaterialRecord {
  float pigment[3];
  float filter;
  float transmit;
  float opacity;
  float ambient[3]; ///< finish ambient times the scene's ambient light, plus emission
  float diffuse;
  float brilliance;
  float phong;
  float phong_size;
  float specular;
  float inverse_roughness;
  float metallic;
  float reflection_min[3];
  float reflection_max[3];
  float reflection_falloff;
  float reflection_metallic;
  float inverse_reflection_exponent;
  uint32_t flags;
  uint32_t pattern;     ///< offset of a PatternRecord
  uint32_t normal;      ///< offset of a NormalRecord
  uint32_t below;       ///< offset of the layer's MaterialRecord
  uint32_t finish;      ///< offset of a FinishRecord, or kNoOffset
  uint32_t inside;      ///< for two_sided objects: offset of the MaterialRecord that is seen from inside
  float diffuse_behind; ///< share of the light on the surface's other side that this side sends on
};
static_assert(sizeof(MaterialRecord) == 128, "one material a line");

/// Materials of a triangle whose vertices have different ones; they are blended by barycentric coordinates.
struct alignas(16) BlendRecord {
  uint32_t material[3];
  uint32_t unused;
};
static_assert(sizeof(BlendRecord) == 16, "crosses DMA");

/// Rare features of a finish.
struct alignas(64) FinishRecord {
  float crand;
  float irid;
  float irid_thickness;
  float irid_turbulence;
  float inverse_wavelength[3];
  uint32_t first_generator; ///< 0 or 1: noise generator 1, as with pattern_flag::first_generator
  uint32_t unused[8];
};
static_assert(sizeof(FinishRecord) == 64, "two a line");

struct alignas(32) InteriorRecord {
  float ior;
  /// Factor of transmitted light at the surfaces of the interior; its sign is negative if fog is inside.
  float signed_refraction;
  float inverse_fade_distance; ///< 0: light does not fade
  float fade_power;            ///< exponent of fading; from 1000 on light fades exponentially
  float fade_colour[3];
  float caustics; ///< exponent; 0: none

  bool is_hollow() const { return __builtin_signbit(signed_refraction) != 0; }
  float refraction() const { return __builtin_fabsf(signed_refraction); }
};
static_assert(sizeof(InteriorRecord) == 32, "four a line");

} // namespace celltrace::kernel
