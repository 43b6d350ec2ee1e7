// EaHeap: main memory that programs allocate by malloc_ea() and related calls, and by mmap_ea().
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace celltrace::cell_emu {

/// A heap in one range of the host's memory, which is reserved at the first allocation. If the system has
/// room, the range is below 4 GB, because programs by default keep effective addresses in 32 bits, and at the
/// same address in every run. Blocks take whole lines of 128 bytes, so that they can be transferred at full
/// speed. All memory is released with the object. Thread safety: none.
class EaHeap {
public:
  static constexpr std::uint64_t kAlignment = 128;

  /// @param most_bytes limit of all blocks together, each rounded up to a multiple of 128
  explicit EaHeap(std::uint64_t most_bytes);
  ~EaHeap();
  EaHeap(const EaHeap&) = delete;
  EaHeap& operator=(const EaHeap&) = delete;

  /// Returns the address of a new block, whose contents are indeterminate; 0 if there is no room.
  /// @param alignment a power of two
  std::uint64_t allocate(std::uint64_t bytes, std::uint64_t alignment = kAlignment);

  /// Releases the block that starts at `ea`. Returns false if no block starts there.
  bool release(std::uint64_t ea);

  /// Returns the requested length of the block that starts at `ea`; nothing if no block starts there.
  std::optional<std::uint64_t> bytes_at(std::uint64_t ea) const;

  /// Returns the memory of [ea, ea + bytes) if it is within one block, else null.
  std::uint8_t* at(std::uint64_t ea, std::uint64_t bytes) const;

private:
  struct Block {
    std::uint64_t reserved = 0, bytes = 0;
  };

  bool reserve();
  void add_free(std::uint64_t ea, std::uint64_t bytes);
  void remove_free(std::map<std::uint64_t, std::uint64_t>::iterator free);

  std::uint64_t most_bytes_;
  std::uint8_t* memory_ = nullptr;
  std::map<std::uint64_t, Block> used_;
  std::map<std::uint64_t, std::uint64_t> free_; // free ranges: bytes by address; no two are adjacent
  std::set<std::pair<std::uint64_t, std::uint64_t>> free_by_size_;
};

} // namespace celltrace::cell_emu
