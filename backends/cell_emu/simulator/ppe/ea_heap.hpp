// Main memory that programs allocate by effective address: malloc_ea() and related calls, and mmap_ea().
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace celltrace::cell_emu {

/// One block of the host's memory, reserved at the first allocation: if the system has room, below 4 GB,
/// since programs keep effective addresses in 32 bits unless they are compiled otherwise, and at the same
/// place in every run. Allocated blocks are kept apart and aligned to 128 bytes, so that each can be
/// transferred at full speed. All memory is released with the object. Thread safety: none.
class EaHeap {
public:
  static constexpr std::uint64_t kAlignment = 128;

  /// @param most_bytes of all blocks together, each rounded up to a multiple of 128
  explicit EaHeap(std::uint64_t most_bytes);
  ~EaHeap();
  EaHeap(const EaHeap&) = delete;
  EaHeap& operator=(const EaHeap&) = delete;

  /// Returns 0 if there is no room. The contents are indeterminate.
  /// @param alignment a power of two
  std::uint64_t allocate(std::uint64_t bytes, std::uint64_t alignment = kAlignment);

  /// Releases a block. Returns whether a block starts there.
  bool release(std::uint64_t ea);

  /// Returns the requested length of the block that starts there.
  std::optional<std::uint64_t> bytes_at(std::uint64_t ea) const;

  /// Returns the memory of [ea, ea + bytes) if one block holds it, else null.
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
  std::map<std::uint64_t, std::uint64_t> free_; // bytes by address, no two adjacent
  std::set<std::pair<std::uint64_t, std::uint64_t>> free_by_size_;
};

} // namespace celltrace::cell_emu
