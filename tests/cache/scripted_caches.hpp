// Playing scripts to software caches on a machine.
//
//   ScriptedCaches caches(kind, 1, 100);           // with 1 SPE, and 100 lines of main memory
//   caches.script().read(128);
//   caches.play(CacheFlavour::plain, config);
//   caches.check_values();                         // what was read
//   caches.check_counts();                         // against the model
#pragma once

#include "script.hpp"
#include "script_fields.hpp"
#include "script_model.hpp"
#include "spe/machine_kinds.hpp"

#include "celltrace/spe/control_block.hpp"
#include "celltrace/spe/shared_records.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

namespace celltrace {

SpeProgram cache_scripts_program();

namespace test {

/// A machine whose SPEs play a script each, on one region of main memory.
class ScriptedCaches {
public:
  ScriptedCaches(const MachineKind& kind, unsigned spes, std::uint32_t lines)
      : kind_(kind), machine_(kind.machine(spes)), memory_(lines),
        scripts_(spes, CacheScript(memory_, machine_->byte_order())) {}

  unsigned spes() const { return machine_->spe_count(); }
  CacheScript& script(unsigned spe = 0) { return scripts_[spe]; }

  void play(CacheFlavour flavour, const CacheConfig& config) {
    const std::endian order = machine_->byte_order();
    config_ = config;
    words_ = SharedRecords<std::uint32_t>(memory_.bytes() / 4, order);
    for (std::uint32_t i = 0; i < words_.size(); ++i)
      words_[i] = memory_.word(4 * i);
    words_.publish();
    reports_ = SharedRecords<CacheReport>(spes(), order);
    std::vector<SharedRecords<CacheEntry>> entries;
    SharedRecords<CacheTask> tasks(spes(), order);
    for (unsigned spe = 0; spe < spes(); ++spe) {
      entries.emplace_back(0, order);
      entries[spe].assign(scripts_[spe].entries());
      tasks[spe] = task_of(flavour, config, words_.ea(), entries[spe], reports_.ea(spe));
    }
    tasks.publish();
    run_ = run_program(*machine_, cache_scripts_program(), tasks.ea());
    words_.fetch();
    reports_.fetch();
  }

  const ProgramRun& run() const { return run_; }
  const CacheReport& report(unsigned spe = 0) const { return reports_[spe]; }
  /// Of main memory as it is now.
  std::uint32_t word(std::uint32_t offset) const { return words_[offset / 4]; }
  std::uint32_t byte(std::uint32_t offset) const {
    return word(offset) >> shift_of_byte(offset, machine_->byte_order()) & 0xFF;
  }
  bool broke(Rule rule) const {
    return std::any_of(run_.diagnostics.begin(), run_.diagnostics.end(),
                       [&](const Diagnostic& each) { return each.rule == rule; });
  }

  /// Every SPE played its script to the end and found what it should, and no rule was broken.
  void check_values() const {
    check_clean(run_);
    for (unsigned spe = 0; spe < spes(); ++spe) {
      CAPTURE(spe, reports_[spe].first_wrong);
      CHECK(reports_[spe].played == scripts_[spe].entries().size());
      CHECK(reports_[spe].wrong == 0);
    }
  }
  /// Main memory is what the script of SPE 0 made of it.
  void check_memory() const {
    std::uint32_t wrong = 0;
    for (std::uint32_t offset = 0; offset < memory_.bytes(); offset += 4)
      wrong += word(offset) != scripts_[0].word(offset);
    CHECK(wrong == 0);
  }
  /// Every cache counted what its model does; where memory is direct, nothing.
  void check_counts() const {
    for (unsigned spe = 0; spe < spes(); ++spe) {
      const CacheCounts expected =
          kind_.is_native() ? CacheCounts{} : expected_counts(scripts_[spe].entries(), config_);
      for (std::uint32_t kind = 0; kind < cache_trace::kKinds; ++kind) {
        CAPTURE(spe, kind);
        CHECK(reports_[spe].hits[kind] == expected[kind].hits);
        CHECK(reports_[spe].misses[kind] == expected[kind].misses);
      }
    }
  }
  /// The same commands brought the same number of bytes as on another machine.
  void check_transfers_as(const ScriptedCaches& other) const {
    for (unsigned spe = 0; spe < spes(); ++spe) {
      CAPTURE(spe);
      const SpeStatistics mine = transfers(spe);
      const SpeStatistics its = other.transfers(spe);
      CHECK(mine.dma_commands == its.dma_commands);
      CHECK(mine.dma_bytes_read == its.dma_bytes_read);
      CHECK(mine.dma_bytes_written == its.dma_bytes_written);
    }
  }

private:
  /// Without those by which machine code learns where it runs, before its kernel starts.
  SpeStatistics transfers(unsigned spe) const {
    SpeStatistics statistics = run_.spes[spe];
    if (kind_.runs_machine_code()) {
      statistics.dma_commands -= 2;
      statistics.dma_bytes_read -= sizeof(ControlBlock) + spes() * sizeof(SpeAddresses);
    }
    return statistics;
  }

  MachineKind kind_;
  std::unique_ptr<Machine> machine_;
  Memory memory_;
  std::vector<CacheScript> scripts_;
  CacheConfig config_;
  SharedRecords<std::uint32_t> words_;
  SharedRecords<CacheReport> reports_;
  ProgramRun run_;
};

} // namespace test
} // namespace celltrace
