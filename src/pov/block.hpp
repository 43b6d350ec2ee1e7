// The blocks of the scene language that have items.
#pragma once

#include <cstdint>

namespace celltrace::pov {

/// The blocks. The words of a block are those of its own table and of the table of base_of().
enum class Block : std::uint8_t {
  none, ///< has no items
  scene,
  settings,
  finish,
  reflection,
  irid,
  old_texture, ///< before version 3.0
  interior,
  material,
  fog,
  rainbow,
  sky_sphere,
  camera,
  light_source,
  light_group,
  object,
  mesh2,
  bicubic_patch,
  picture,
  height_field,
  photons,
  pattern, ///< what all kinds of patterns have
  pigment,
  normal,
  warp,
};
inline constexpr int kBlocks = static_cast<int>(Block::warp) + 1;

} // namespace celltrace::pov
