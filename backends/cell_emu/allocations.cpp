#include "backends/cell_emu/allocations.hpp"

#include "backends/cell_emu/local_store_watch.hpp"

#include <algorithm>

namespace celltrace::cell_emu {

void Allocations::begin(std::uint8_t* local_store, std::uint32_t arena_end, std::uint32_t red_zone) {
  const std::lock_guard lock(mutex_);
  local_store_ = local_store;
  arena_end_ = arena_end;
  red_zone_ = red_zone;
  known_ = true;
  allocations_.clear();
}

void Allocations::end() {
  const std::lock_guard lock(mutex_);
  known_ = false;
  allocations_.clear();
}

void Allocations::add(std::uint32_t begin, std::uint32_t end, CallSite site) {
  const std::lock_guard lock(mutex_);
  if (!allocations_.empty()) allocations_.back().zone_end = std::min(allocations_.back().zone_end, begin);
  allocations_.push_back({begin, end, std::min(end + kZoneBytes, arena_end_), site});
  fill_zone(allocations_.back());
}

void Allocations::release(std::uint32_t lsa) {
  const std::lock_guard lock(mutex_);
  const auto is_kept = [&](const Allocation& each) { return each.begin < lsa; };
  allocations_.erase(std::partition_point(allocations_.begin(), allocations_.end(), is_kept),
                     allocations_.end());
  if (allocations_.empty()) return;
  Allocation& last = allocations_.back();
  last.end = std::min(last.end, lsa);
  last.zone_end = std::min(last.end + kZoneBytes, arena_end_);
  fill_zone(last);
}

const Allocations::Allocation* Allocations::find(std::uint32_t lsa) const {
  const auto behind =
      std::upper_bound(allocations_.begin(), allocations_.end(), lsa,
                       [](std::uint32_t at, const Allocation& each) { return at < each.begin; });
  return behind == allocations_.begin() ? nullptr : &*std::prev(behind);
}

bool Allocations::broken_by_another(std::uint32_t lsa, std::uint32_t size) const {
  const std::lock_guard lock(mutex_);
  return !is_within_one(lsa, size) &&
         std::any_of(allocations_.begin(), allocations_.end(),
                     [&](const Allocation& each) { return lsa < each.zone_end && each.begin < lsa + size; });
}

std::optional<Allocations::Allocation> Allocations::before(std::uint32_t lsa) const {
  const std::lock_guard lock(mutex_);
  const Allocation* const found = find(lsa);
  if (found == nullptr) return std::nullopt;
  return *found;
}

void Allocations::fill_zone(const Allocation& allocation) const {
  if (red_zone_ != 0) fill_with_poison(local_store_ + allocation.end, allocation.zone_end - allocation.end);
}

std::optional<Allocations::Overrun> Allocations::take_overrun() {
  if (red_zone_ == 0) return std::nullopt;
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
