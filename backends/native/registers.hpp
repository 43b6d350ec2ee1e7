// The problem-state registers of all SPEs as places in main storage, so that DMA reaches them by address.
#pragma once

#include "backends/native/channels.hpp"
#include "celltrace/spe/types.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace celltrace::native {

/// Reserves an address range and returns which register of which SPE lies where in it. Nothing is ever stored
/// there: a write goes to the channels of the SPE, a DMA read of a register gives zeros.
///
/// Thread safety: const members may be called from any thread.
class RegisterMap {
public:
  enum class Register : std::uint32_t { signal_1, signal_2, in_mailbox };

  /// `spes[i]` are the channels of SPE i, which outlive the map.
  explicit RegisterMap(std::vector<Channels*> spes);

  /// Returns the address of a register of an existing SPE; its low four bits are 0xC.
  ea_t address(unsigned spe, Register which) const;
  /// Returns true if a transfer to `ea` would write registers. Takes one compare.
  bool contains(ea_t ea) const noexcept { return ea - begin_ < bytes_; }
  /// Delivers the word at `ls` and returns the register's kind. Throws SpeError if no register lies at `ea`,
  /// or if `size` is not that of a word.
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
