// Memory that DMA reads and writes.
#pragma once

#include <cstddef>
#include <memory>

namespace celltrace {

/// Starts on a 128-byte boundary. Large blocks lie on huge pages where the system has them, for rays go
/// through them in no order.
class AlignedBlock {
public:
  AlignedBlock() = default;
  /// Zero at first. Throws std::bad_alloc.
  explicit AlignedBlock(std::size_t bytes);
  /// With anything in it.
  static AlignedBlock uninitialised(std::size_t bytes);

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
