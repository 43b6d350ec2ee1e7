// RegisterMap: effective addresses of the problem-state registers of all SPEs, by which DMA commands write
// them.
#pragma once

#include "backends/native/channels.hpp"
#include "celltrace/spe/types.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace celltrace::native {

/// Reserves an address range for the registers of all SPEs. Nothing is ever stored in the range: writes go to
/// the channels of the SPE, and a DMA read of a register gives zeros.
///
/// Thread safety: const members may be called from any thread.
class RegisterMap {
public:
  enum class Register : std::uint32_t { signal_1, signal_2, in_mailbox };

  /// `spes[i]` are the channels of SPE i, which outlive the map.
  explicit RegisterMap(std::vector<Channels*> spes);

  /// Returns the address of a register of an existing SPE; its low four bits are 0xC.
  ea_t address(unsigned spe, Register which) const;
  /// Returns true if a transfer to `ea` writes registers. Fast: one compare.
  bool contains(ea_t ea) const noexcept { return ea - begin_ < bytes_; }
  /// Writes the word at `ls` to the register at `ea`, and returns which register it is. Throws SpeError if
  /// there is no register at `ea`, or if `size` is not 4.
  Register write(ea_t ea, const void* ls, std::uint32_t size) const;

private:
  struct alignas(kLineBytes) Page {
    std::uint32_t words[kLineBytes / sizeof(std::uint32_t)] = {};
  };

  std::vector<Channels*> spes_;
  std::unique_ptr<Page[]> pages_; ///< one per SPE
  ea_t begin_;
  std::size_t bytes_;
};

} // namespace celltrace::native
