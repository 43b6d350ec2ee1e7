// The memory of all local stores of a machine, with what notices stores that miss them.
//
//   gap | edge | local store 0 | edge | gap | edge | local store 1 | edge | gap | ...
//
// Each local store is aligned to its 256 KB and has gaps of 256 KB around it. The first 4 KB of a gap on
// either side are an edge: a pattern that is looked at. Behind it, where the host has such memory, no access
// is possible at all: what misses a local store by more crashes where it does.
#pragma once

#include "celltrace/spe/types.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace celltrace::cell_emu {

/// Thread safety: the edges of a local store belong to the thread that runs its SPE.
class LocalStoreBlock {
public:
  /// From one local store to the next.
  static constexpr std::size_t kStride = 2 * std::size_t{kLocalStoreBytes};

  explicit LocalStoreBlock(unsigned spes);
  ~LocalStoreBlock();
  LocalStoreBlock(const LocalStoreBlock&) = delete;
  LocalStoreBlock& operator=(const LocalStoreBlock&) = delete;

  /// Zero at first.
  std::uint8_t* local_store(unsigned spe) const { return begin_ + kLocalStoreBytes + spe * kStride; }
  /// The local stores with all gaps.
  const std::uint8_t* begin() const { return begin_; }
  std::size_t bytes() const { return bytes_; }

  /// Nothing was stored right in front of the local store or right behind it. Fast: the nearest 128 bytes.
  bool is_edge_intact(unsigned spe) const {
    const std::uint8_t* const at = local_store(spe);
    return is_intact(at - kLineBytes, kLineBytes) && is_intact(at + kLocalStoreBytes, kLineBytes);
  }
  /// The first byte of the edges that was changed, as an address in the local store: negative in front of it.
  /// Makes the edges whole again.
  std::optional<std::int64_t> take_overrun(unsigned spe) const;

private:
  static bool is_intact(const std::uint8_t* at, std::uint32_t bytes);
  std::optional<std::int64_t> first_change(unsigned spe, const std::uint8_t* edge) const;

  std::size_t bytes_;
  void* memory_ = nullptr; ///< as the host gave it
  std::size_t memory_bytes_ = 0;
  std::uint8_t* begin_ = nullptr;
};

} // namespace celltrace::cell_emu
