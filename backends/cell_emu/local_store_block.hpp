// The memory of all local stores of a machine, with guards that detect stores just outside of a local store.
//
//   gap | edge | local store 0 | edge | gap | edge | local store 1 | edge | gap | ...
//
// Each local store is aligned to its 256 KB and has gaps of 256 KB around it. The 4 KB in front of and behind
// a local store are its edges, filled with a pattern that is checked. The rest of a gap is inaccessible if
// the host supports this, so that a store farther away crashes at once.
#pragma once

#include "celltrace/spe/types.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace celltrace::cell_emu {

/// The memory block. Thread safety: the edges of a local store belong to the thread that runs its SPE.
class LocalStoreBlock {
public:
  /// Bytes from one local store to the next.
  static constexpr std::size_t kStride = 2 * std::size_t{kLocalStoreBytes};

  explicit LocalStoreBlock(unsigned spes);
  ~LocalStoreBlock();
  LocalStoreBlock(const LocalStoreBlock&) = delete;
  LocalStoreBlock& operator=(const LocalStoreBlock&) = delete;

  /// Returns the local store of an SPE, zeroed at first.
  std::uint8_t* local_store(unsigned spe) const { return begin_ + kLocalStoreBytes + spe * kStride; }
  /// Return the block of the local stores with all gaps.
  const std::uint8_t* begin() const { return begin_; }
  std::size_t bytes() const { return bytes_; }

  /// Returns true if nothing was stored right in front of the local store or right behind it. Fast: checks
  /// the nearest 128 bytes.
  bool is_edge_intact(unsigned spe) const {
    const std::uint8_t* const at = local_store(spe);
    return is_intact(at - kLineBytes, kLineBytes) && is_intact(at + kLocalStoreBytes, kLineBytes);
  }
  /// Returns the offset from the local store's beginning of the first changed byte of its edges, negative in
  /// front of the local store; nothing if no byte has changed. Restores the edges.
  std::optional<std::int64_t> take_overrun(unsigned spe) const;

private:
  static bool is_intact(const std::uint8_t* at, std::uint32_t bytes);
  std::optional<std::int64_t> first_change(unsigned spe, const std::uint8_t* edge) const;

  std::size_t bytes_;
  void* memory_ = nullptr; ///< address that the host returned
  std::size_t memory_bytes_ = 0;
  std::uint8_t* begin_ = nullptr;
};

} // namespace celltrace::cell_emu
