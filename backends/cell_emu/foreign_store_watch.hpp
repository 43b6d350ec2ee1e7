// Notices, in lockstep, stores of one SPE's program into the local store of another.
//
// While a program is not having its turn, only DMA and the PPE change its local store. What the program has
// in use is copied when its turn ends, and compared when the next one begins, or when the PPE's turn does:
// all of it while the program is young or uses little, else a kilobyte after the other, as to copy everything
// would take longer than the turn. Nothing is compared where DMA has come in between.
#pragma once

#include "celltrace/spe/types.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace celltrace::cell_emu {

/// Thread safety: none.
class ForeignStoreWatch {
public:
  explicit ForeignStoreWatch(unsigned spes) : seen_(spes) {}

  /// The local store of an SPE that is in use.
  struct Used {
    const std::uint8_t* begin;
    std::uint32_t bytes;
    std::uint64_t dma_writes; ///< into the local store so far
  };
  struct Change {
    std::uint32_t offset;           ///< of the first changed word, in what is in use
    std::vector<unsigned> suspects; ///< the SPEs that have had turns; at least one
  };

  /// A program of `spe` starts.
  void begin(unsigned spe) { seen_[spe] = {}; }
  void end_turn(unsigned spe, const Used& used);
  /// The last turn of a program.
  void end(unsigned spe);

  /// What others have stored since end_turn(). They are not asked twice.
  std::optional<Change> take_change(unsigned spe, const Used& used);
  /// Whatever has changed, it was not by other SPEs.
  void accept_changes(unsigned spe, const Used& used);

private:
  /// Bytes of a young program that are looked at besides the kilobyte of each turn.
  static constexpr std::uint32_t kAllowance = 256 * 1024;
  static constexpr std::uint32_t kWindow = 1024;

  struct Seen {
    std::vector<std::uint8_t> copy; ///< empty: nothing was seen
    std::uint32_t offset = 0;
    std::uint64_t dma_writes = 0;
    std::uint64_t turn = 0; ///< the last one that ended
    std::uint32_t allowance = kAllowance;
    std::uint32_t next = 0; ///< offset of the next window
  };

  static bool has_changed(Seen& seen, const Used& used);

  std::vector<Seen> seen_;
  std::uint64_t turn_ = 0;
};

} // namespace celltrace::cell_emu
