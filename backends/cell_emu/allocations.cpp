#include "backends/cell_emu/allocations.hpp"

#include "backends/cell_emu/local_store_watch.hpp"
#include "celltrace/spe/types.hpp"

#include <algorithm>

namespace celltrace::cell_emu {
namespace {

constexpr std::uint32_t aligned(std::uint32_t lsa, std::uint32_t alignment) {
  return (lsa + alignment - 1) & ~(alignment - 1);
}

} // namespace

void Allocations::begin(std::uint8_t* local_store, std::uint32_t begin, bool red_zones) {
  const std::lock_guard lock(mutex_);
  local_store_ = local_store;
  red_zones_ = red_zones;
  next_ = unshifted_ = begin;
  known_ = true;
  allocations_.clear();
}

void Allocations::end() {
  const std::lock_guard lock(mutex_);
  known_ = false;
  allocations_.clear();
}

void Allocations::add(std::uint32_t begin, std::uint32_t bytes, std::uint32_t alignment,
                      std::uint32_t arena_end, CallSite site) {
  const std::lock_guard lock(mutex_);
  const std::uint32_t end = begin + bytes;
  if (!allocations_.empty()) allocations_.back().zone_end = std::min(allocations_.back().zone_end, begin);
  // The program may have changed ArenaState::next itself.
  unshifted_ = std::min(unshifted_ + (begin - aligned(next_, alignment)), begin);
  unshifted_ = std::min(aligned(unshifted_, alignment) + bytes, end);
  const std::uint32_t grown = arena_end + end + kZoneBytes - unshifted_;
  const bool is_full = unshifted_ >= arena_end;
  next_ = end + (red_zones_ && !is_full && grown <= kLocalStoreBytes ? kZoneBytes : 0);
  allocations_.push_back({begin, end, std::min(end + kZoneBytes, kLocalStoreBytes), next_, unshifted_, site});
  fill_zone(allocations_.back());
}

void Allocations::release(std::uint32_t lsa) {
  const std::lock_guard lock(mutex_);
  const auto is_kept = [&](const Allocation& each) { return each.begin < lsa; };
  allocations_.erase(std::partition_point(allocations_.begin(), allocations_.end(), is_kept),
                     allocations_.end());
  const std::uint32_t shift_before =
      allocations_.empty() ? 0 : allocations_.back().behind - allocations_.back().unshifted;
  next_ = lsa;
  unshifted_ = lsa - shift_before;
  if (allocations_.empty()) return;
  Allocation& last = allocations_.back();
  last.end = std::min(last.end, lsa);
  last.zone_end = std::min(last.end + kZoneBytes, kLocalStoreBytes);
  fill_zone(last);
}

Allocations::Iterator Allocations::behind(std::uint32_t lsa) const {
  return std::upper_bound(allocations_.begin(), allocations_.end(), lsa,
                          [](std::uint32_t at, const Allocation& each) { return at < each.begin; });
}

bool Allocations::is_left_by(std::uint32_t lsa, std::uint32_t size) const {
  const std::lock_guard lock(mutex_);
  const Iterator next = behind(lsa);
  if (next != allocations_.begin()) {
    const Allocation& before = *std::prev(next);
    if (lsa + size <= before.end) return false;
    if (lsa < before.zone_end) return true;
  }
  return next != allocations_.end() && next->begin < lsa + size;
}

std::optional<Allocations::Allocation> Allocations::before(std::uint32_t lsa) const {
  const std::lock_guard lock(mutex_);
  const Iterator next = behind(lsa);
  if (next == allocations_.begin()) return std::nullopt;
  return *std::prev(next);
}

void Allocations::fill_zone(const Allocation& allocation) const {
  if (red_zones_) fill_with_poison(local_store_ + allocation.end, allocation.zone_end - allocation.end);
}

std::optional<Allocations::Overrun> Allocations::take_overrun() {
  if (!red_zones_) return std::nullopt;
  for (const Allocation& each : allocations_) {
    const std::uint8_t* const zone = local_store_ + each.end;
    if (is_poison(zone, each.zone_end - each.end)) continue;
    std::uint32_t offset = 0;
    while (is_poison(zone + offset, std::min(4u, each.zone_end - each.end - offset)))
      offset += 4;
    fill_zone(each);
    return Overrun{each, each.end + offset};
  }
  return std::nullopt;
}

} // namespace celltrace::cell_emu
