// Blocks of memory for DMA.
#pragma once

#include <cstddef>
#include <memory>

namespace celltrace {

/// The pages of a block. Huge pages, if the system has them, are for data that rays access in random order.
/// Pictures gain nothing from huge pages: the host of a virtual machine may have to provide them first, which
/// takes ten times as long as filling normal pages.
enum class Pages { normal, huge };

/// A block that starts on a 128-byte boundary.
class AlignedBlock {
public:
  AlignedBlock() = default;
  /// Makes a zeroed block; on huge pages if it is large. Throws std::bad_alloc.
  explicit AlignedBlock(std::size_t bytes);
  /// Returns a block with indeterminate contents.
  static AlignedBlock uninitialised(std::size_t bytes, Pages pages = Pages::huge);

  /// Grows to at least `bytes` bytes; the contents are lost if the block was smaller.
  void reserve(std::size_t bytes);

  std::byte* data() const noexcept { return bytes_.get(); }
  std::size_t size() const noexcept { return size_; }

private:
  struct Free {
    void operator()(std::byte* bytes) const noexcept;
  };
  std::unique_ptr<std::byte, Free> bytes_;
  std::size_t size_ = 0;
};

} // namespace celltrace
