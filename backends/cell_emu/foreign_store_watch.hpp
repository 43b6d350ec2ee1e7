// Detects, in lockstep, stores of one SPE's program into the local store of another.
//
// Between a program's turns, only DMA and the PPE may change its local store. When its turn ends, the used
// part of its local store is copied; when its next turn or the PPE's turn begins, the copy is compared with
// local store. The copy is the whole used part until kAllowance bytes have been compared, or if it has at
// most kWindow bytes; after that it is another kilobyte in each turn, because copying everything would take
// longer than the turn. If DMA has written into the local store meanwhile, nothing is compared.
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

  /// The part of an SPE's local store that its program uses.
  struct Used {
    const std::uint8_t* begin;
    std::uint32_t bytes;
    std::uint64_t dma_writes; ///< DMA writes into the local store so far
  };
  struct Change {
    std::uint32_t offset;           ///< offset of the first changed word in the part in use
    std::vector<unsigned> suspects; ///< SPEs that have had turns since the copy was made; at least one
  };

  /// Begins a program of `spe`.
  void begin(unsigned spe) { seen_[spe] = {}; }
  void end_turn(unsigned spe, const Used& used);
  /// Ends the last turn of a program.
  void end(unsigned spe);

  /// Returns a store of another SPE since end_turn(), if there is one. Each change is returned once.
  std::optional<Change> take_change(unsigned spe, const Used& used);
  /// Updates the copy, so that changes so far do not count as stores of other SPEs.
  void accept_changes(unsigned spe, const Used& used);

private:
  /// Number of bytes that are compared, for each program, in copies of more than kWindow bytes.
  static constexpr std::uint32_t kAllowance = 256 * 1024;
  static constexpr std::uint32_t kWindow = 1024;

  struct Seen {
    std::vector<std::uint8_t> copy; ///< empty: nothing was copied
    std::uint32_t offset = 0;
    std::uint64_t dma_writes = 0;
    std::uint64_t turn = 0; ///< number of the last turn that ended
    std::uint32_t allowance = kAllowance;
    std::uint32_t next = 0; ///< offset of the kilobyte to be copied in the next turn
  };

  static bool has_changed(Seen& seen, const Used& used);

  std::vector<Seen> seen_;
  std::uint64_t turn_ = 0;
};

} // namespace celltrace::cell_emu
