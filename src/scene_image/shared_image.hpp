// The scene image as the SPEs of a machine read it.
#pragma once

#include "celltrace/spe/types.hpp"
#include "memory/aligned_block.hpp"
#include "scene_image/scene_image.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace celltrace {

/// The image itself where the SPUs have the host's byte order, which costs nothing; else a copy in theirs.
/// Thread safety: as a standard container.
class SharedImage {
public:
  /// `image` stays where it is as long as this lives, and has an accelerator's room when it is shown.
  SharedImage(const SceneImage& image, std::endian spe_order)
      : image_(image), converts_(spe_order != std::endian::native) {}

  /// Shows the SPEs the static part, with room behind it for an accelerator of their own making. May move.
  void publish_static();
  /// Shows them the static part and an accelerator that the PPE's side has made. May move.
  void publish_all();

  /// Before the image changes in place: keeps what it is now.
  void remember();
  /// Shows the SPEs what has changed since remember(), and returns the offsets of the lines in which that is,
  /// in ascending order. The image has not moved.
  std::vector<std::uint32_t> publish_changes();

  /// Of the base.
  ea_t ea() const noexcept {
    return reinterpret_cast<std::uintptr_t>(converts_ ? copy_.data() : image_.base());
  }

private:
  void copy(std::size_t begin, std::size_t end);
  void copy_header();

  const SceneImage& image_;
  bool converts_;
  AlignedBlock copy_;
  AlignedBlock before_; ///< the image as it was when it was remembered
};

} // namespace celltrace
