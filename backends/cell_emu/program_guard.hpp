// Guards the local store in which a program's code and stack would lie on a real SPE. A program of host code
// does not use this local store, so that any change of it is a stray store.
#pragma once

#include "backends/cell_emu/diagnostic_log.hpp"
#include "backends/cell_emu/local_store_watch.hpp"
#include "backends/cell_emu/mfc.hpp"

namespace celltrace::cell_emu {

class ProgramGuard {
public:
  ProgramGuard(std::uint8_t* local_store, ArenaRange arena) : local_store_(local_store), arena_(arena) {}

  // DMA of other SPEs may write the local store meanwhile: call these functions in Bus::hold_local_store().

  void fill() const {
    fill_with_poison(local_store_, arena_.begin);
    fill_with_poison(local_store_ + arena_.end, kLocalStoreBytes - arena_.end);
  }

  /// Reports the first change. `arena_end` is the end of the arena, which may have grown.
  void check(unsigned spe, std::uint32_t arena_end, DiagnosticLog& log) const {
    const bool code = is_poison(local_store_, arena_.begin);
    const bool stack = is_poison(local_store_ + arena_end, kLocalStoreBytes - arena_end);
    if (code && stack) return;
    std::uint32_t lsa = code ? arena_end : 0;
    while (is_poison(local_store_ + lsa, 8))
      lsa += 8;
    Diagnostic diagnostic;
    diagnostic.rule = Rule::program_overwritten;
    diagnostic.spe = spe;
    diagnostic.lsa = lsa;
    log.report(diagnostic, "near LS address " + std::to_string(lsa) + ": " +
                               std::string(text_of(Rule::program_overwritten)));
  }

private:
  std::uint8_t* local_store_;
  ArenaRange arena_;
};

} // namespace celltrace::cell_emu
