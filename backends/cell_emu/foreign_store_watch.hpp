// Detects, in lockstep, stores of one SPE's program into the local store of another.
//
// Between two turns of a program, only DMA and the PPE may change its local store. The part that the program
// uses is copied when a turn ends, and compared when its next turn or the PPE's begins. Nothing is compared
// if DMA has written in between.
//
// A copy of the whole part would take longer than the turn. Once 256 KB have been compared, each turn
// therefore copies one kilobyte, the next one each time, unless the program uses no more than that.
#pragma once

#include "celltrace/spe/types.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace celltrace::cell_emu {

/// The watch over all local stores. Thread safety: none.
class ForeignStoreWatch {
public:
  explicit ForeignStoreWatch(unsigned spes) : seen_(spes) {}

  /// The part of an SPE's local store that is in use.
  struct Used {
    const std::uint8_t* begin;
    std::uint32_t bytes;
    std::uint64_t dma_writes; ///< DMA writes into the local store so far
  };
  struct Change {
    std::uint32_t offset;           ///< offset of the first changed word in the part in use
    std::vector<unsigned> suspects; ///< SPEs that have had turns since; at least one
  };

  /// Begins a program of `spe`.
  void begin(unsigned spe) { seen_[spe] = {}; }
  void end_turn(unsigned spe, const Used& used);
  /// Ends the last turn of a program.
  void end(unsigned spe);

  /// Returns what others have stored since end_turn(). Each change is returned once.
  std::optional<Change> take_change(unsigned spe, const Used& used);
  /// Accepts all changes as not made by other SPEs.
  void accept_changes(unsigned spe, const Used& used);

private:
  /// Number of bytes of a program that are compared as parts larger than a window.
  static constexpr std::uint32_t kAllowance = 256 * 1024;
  static constexpr std::uint32_t kWindow = 1024;

  struct Seen {
    std::vector<std::uint8_t> copy; ///< empty: nothing was copied
    std::uint32_t offset = 0;
    std::uint64_t dma_writes = 0;
    std::uint64_t turn = 0; ///< the last turn that ended
    std::uint32_t allowance = kAllowance;
    std::uint32_t next = 0; ///< offset of the next window
  };

  static bool has_changed(Seen& seen, const Used& used);

  std::vector<Seen> seen_;
  std::uint64_t turn_ = 0;
};

} // namespace celltrace::cell_emu
