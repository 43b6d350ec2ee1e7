// What a program has allocated of its local store, and the red zones behind that: poison, of which a change
// is a store past an allocation.
//
//   allocation | zone | allocation | zone | free ...
//
// A zone reaches to the next allocation, but not further than kZoneBytes.
#pragma once

#include "celltrace/spe/call_site.hpp"

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace celltrace::cell_emu {

/// Offsets in one local store. Thread safety: broken_by_another() from any thread, the others belong to the
/// thread that runs the SPE.
class Allocations {
public:
  static constexpr std::uint32_t kZoneBytes = 128;

  struct Allocation {
    std::uint32_t begin, end; ///< without its zone
    std::uint32_t zone_end;
    CallSite site;
  };
  /// A store into the zone behind an allocation.
  struct Overrun {
    Allocation allocation;
    std::uint32_t lsa; ///< of the first changed word
  };

  /// A program begins, which may allocate up to `arena_end`. Between allocations it leaves `red_zone` bytes;
  /// 0: zones are not watched.
  void begin(std::uint8_t* local_store, std::uint32_t arena_end, std::uint32_t red_zone);
  /// It has ended, or its allocations are not known.
  void end();

  void add(std::uint32_t begin, std::uint32_t end, CallSite site);
  /// Everything from `lsa` on is free again.
  void release(std::uint32_t lsa);

  /// [lsa, lsa + size) is not within one allocation, and it is known what was allocated.
  bool breaks_bounds(std::uint32_t lsa, std::uint32_t size) const {
    return known_ && !is_within_one(lsa, size);
  }
  /// The same for transfers of others, who may have arranged with the program to use what it has not
  /// allocated: the range touches an allocation, or its zone, and is not within it.
  bool broken_by_another(std::uint32_t lsa, std::uint32_t size) const;
  /// The last allocation that begins at `lsa` or before.
  std::optional<Allocation> before(std::uint32_t lsa) const;

  /// A zone that was stored into, which becomes whole again.
  std::optional<Overrun> take_overrun();

private:
  bool is_within_one(std::uint32_t lsa, std::uint32_t size) const {
    const Allocation* const found = find(lsa);
    return found != nullptr && lsa + size <= found->end;
  }
  const Allocation* find(std::uint32_t lsa) const;
  void fill_zone(const Allocation& allocation) const;

  std::uint8_t* local_store_ = nullptr;
  std::uint32_t arena_end_ = 0;
  std::uint32_t red_zone_ = 0;
  bool known_ = false;
  mutable std::mutex mutex_;            ///< for changes, and for looks from other threads
  std::vector<Allocation> allocations_; ///< in ascending order
};

} // namespace celltrace::cell_emu
