// Memory that DMA reads and writes.
#pragma once

#include <cstddef>
#include <memory>

namespace celltrace {

/// Huge pages, where the system has them, are for what rays go through in no order. For pictures they are not
/// worth it: the host of a virtual machine may have to provide them first, which takes ten times as long as
/// to fill normal ones.
enum class Pages { normal, huge };

/// Starts on a 128-byte boundary.
class AlignedBlock {
public:
  AlignedBlock() = default;
  /// Zero at first; on huge pages if it is large. Throws std::bad_alloc.
  explicit AlignedBlock(std::size_t bytes);
  /// With anything in it.
  static AlignedBlock uninitialised(std::size_t bytes, Pages pages = Pages::huge);

  /// Has `bytes` at least; what was in it is lost if it was smaller.
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
