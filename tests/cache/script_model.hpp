// What a cache ought to count when a script is played to it: CacheModel, entry by entry.
#pragma once

#include "model.hpp"
#include "script_records.hpp"

#include "celltrace/cache.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace celltrace::test {

/// What a cache ought to count, by kind of data.
using CacheCounts = std::array<CacheCounters, cache_trace::kKinds>;

class ScriptModel {
public:
  explicit ScriptModel(const CacheConfig& config) : config_(config), model_(config) {}

  void play(const CacheEntry& entry) {
    switch (entry.step) {
    case CacheStep::use:
    case CacheStep::use_plain:
    case CacheStep::settle:
    case CacheStep::change:
    case CacheStep::flush:
      break;
    case CacheStep::item:
      items_.push_back(entry.offset);
      break;
    case CacheStep::fetch:
      for (const std::uint32_t offset : items_)
        prefetch(offset);
      items_.clear();
      break;
    case CacheStep::lanes:
      lanes(entry);
      break;
    case CacheStep::run:
      run_words_ = entry.value;
      if (run_words_ != 0) line_of_run(entry);
      break;
    case CacheStep::next:
      --run_words_;
      if ((entry.offset + 4) % kLineBytes == 0 && run_words_ != 0)
        line_of_run({entry.step, entry.kind, entry.offset + 4, 0});
      break;
    case CacheStep::prefetch:
      prefetch(entry.offset);
      break;
    case CacheStep::synchronize:
      model_.synchronize(entry.offset, entry.value);
      break;
    case CacheStep::synchronize_all:
      model_.synchronize(0, 0xFFFFFFFFu);
      break;
    case CacheStep::invalidate_all:
      model_.invalidate_all();
      break;
    case CacheStep::reset_counters:
      counts_ = {};
      break;
    default:
      reference(entry.offset, entry.kind);
    }
  }
  const CacheCounts& counts() const { return counts_; }

private:
  void reference(std::uint32_t offset, std::uint32_t kind) {
    const bool hit = config_.enabled && model_.read(offset);
    ++(hit ? counts_[kind].hits : counts_[kind].misses);
  }
  void prefetch(std::uint32_t offset) {
    if (config_.enabled) model_.prefetch(offset);
  }
  /// Lanes that want one line are hits behind the first of them.
  void lanes(const CacheEntry& entry) {
    for (std::uint32_t lane = 0; lane < items_.size(); ++lane) {
      if ((entry.value >> lane & 1) == 0) continue;
      bool is_first = true;
      for (std::uint32_t before = 0; before < lane; ++before)
        is_first &=
            (entry.value >> before & 1) == 0 || items_[before] / kLineBytes != items_[lane] / kLineBytes;
      if (is_first || !config_.enabled)
        reference(items_[lane], entry.kind);
      else
        ++counts_[entry.kind].hits;
    }
    items_.clear();
  }
  /// A run reads a line at a time, and has the next one fetched.
  void line_of_run(const CacheEntry& at) {
    const std::uint32_t line = at.offset / kLineBytes * kLineBytes;
    if (run_words_ > (kLineBytes - (at.offset - line)) / 4) prefetch(line + kLineBytes);
    reference(line, at.kind);
  }

  CacheConfig config_;
  CacheModel model_;
  std::vector<std::uint32_t> items_;
  std::uint32_t run_words_ = 0;
  CacheCounts counts_{};
};

inline CacheCounts expected_counts(const std::vector<CacheEntry>& script, const CacheConfig& config) {
  ScriptModel model(config);
  for (const CacheEntry& entry : script)
    model.play(entry);
  return model.counts();
}

} // namespace celltrace::test
