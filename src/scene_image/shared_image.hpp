// The scene image in the byte order of a machine's SPEs.
#pragma once

#include "celltrace/spe/types.hpp"
#include "memory/aligned_block.hpp"
#include "scene_image/scene_image.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace celltrace {

/// The image itself if the SPUs have the host's byte order, which costs nothing; else a copy in the SPUs'
/// byte order. Thread safety: as a standard container.
class SharedImage {
public:
  /// Refers to `image`, which must stay where it is while this object lives. Room for an accelerator must be
  /// reserved in the image before it is published.
  SharedImage(const SceneImage& image, std::endian spe_order)
      : image_(image), converts_(spe_order != std::endian::native) {}

  /// Publishes the static part to the SPEs, with room behind it for an accelerator that they build. May move
  /// the copy.
  void publish_static();
  /// Publishes the static part and an accelerator that the host has built. May move the copy.
  void publish_all();

  /// Keeps a copy of the image's state before it changes in place.
  void remember();
  /// Publishes what has changed since remember(), and returns the offsets of the changed cache lines in
  /// ascending order. The image must not have moved.
  std::vector<std::uint32_t> publish_changes();

  /// Returns the effective address of the image's first byte.
  ea_t ea() const noexcept {
    return reinterpret_cast<std::uintptr_t>(converts_ ? copy_.data() : image_.base());
  }

private:
  void copy(std::size_t begin, std::size_t end);
  void copy_header();

  const SceneImage& image_;
  bool converts_;
  AlignedBlock copy_;
  AlignedBlock before_; ///< the image at the time of remember()
};

} // namespace celltrace
