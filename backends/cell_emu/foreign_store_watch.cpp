#include "backends/cell_emu/foreign_store_watch.hpp"

#include "backends/cell_emu/access_checkers.hpp"

#include <algorithm>
#include <cstring>

namespace celltrace::cell_emu {

void ForeignStoreWatch::end_turn(unsigned spe, const Used& used) {
  Seen& seen = seen_[spe];
  seen.turn = ++turn_;
  seen.dma_writes = used.dma_writes;
  seen.copy.clear();
  seen.offset = 0;
  std::uint32_t bytes = used.bytes;
  if (bytes > kWindow && bytes > seen.allowance) {
    seen.offset = seen.next < used.bytes ? seen.next : 0;
    bytes = std::min(kWindow, used.bytes - seen.offset);
    seen.next = seen.offset + bytes;
  }
  const std::uint8_t* const from = used.begin + seen.offset;
  if (may_access(from, bytes)) seen.copy.assign(from, from + bytes);
}

void ForeignStoreWatch::end(unsigned spe) {
  seen_[spe] = {};
  seen_[spe].turn = ++turn_;
}

bool ForeignStoreWatch::has_changed(Seen& seen, const Used& used) {
  if (seen.copy.empty() || seen.dma_writes != used.dma_writes) return false;
  if (seen.copy.size() > kWindow) {
    if (seen.copy.size() > seen.allowance) seen.copy.resize(kWindow);
    seen.allowance -= std::min(seen.allowance, static_cast<std::uint32_t>(seen.copy.size()));
  }
  const UncheckedScope unset_bytes_count;
  return std::memcmp(used.begin + seen.offset, seen.copy.data(), seen.copy.size()) != 0;
}

std::optional<ForeignStoreWatch::Change> ForeignStoreWatch::take_change(unsigned spe, const Used& used) {
  Seen& seen = seen_[spe];
  if (!has_changed(seen, used)) return std::nullopt;
  const UncheckedScope unset_bytes_count;
  const auto first = std::mismatch(seen.copy.begin(), seen.copy.end(), used.begin + seen.offset).first;
  Change change{(seen.offset + static_cast<std::uint32_t>(first - seen.copy.begin())) & ~3u, {}};
  for (unsigned other = 0; other < seen_.size(); ++other)
    if (other != spe && seen_[other].turn > seen.turn) change.suspects.push_back(other);
  seen.copy.clear();
  if (change.suspects.empty()) return std::nullopt;
  return change;
}

void ForeignStoreWatch::accept_changes(unsigned spe, const Used& used) {
  Seen& seen = seen_[spe];
  if (!has_changed(seen, used)) return;
  const std::uint8_t* const from = used.begin + seen.offset;
  seen.copy.assign(from, from + seen.copy.size());
}

} // namespace celltrace::cell_emu
