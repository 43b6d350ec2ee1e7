// What a program has allocated of its local store, and the red zones behind that: poison, of which a change
// is a store past an allocation.
//
//   allocation | zone | allocation | zone | free ...
//
// A zone reaches to the next allocation, but not further than kZoneBytes. With red zones asked for, each
// allocation lies a multiple of kZoneBytes further than it would without, which keeps its alignment. What
// zones take of the arena is added at its end, in the local store that is kept for the stack and that nothing
// of a host's program uses: with red zones a program finds as much room as without.
#pragma once

#include "celltrace/spe/call_site.hpp"

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace celltrace::cell_emu {

/// Offsets in one local store. Thread safety: is_left_by() and before() from any thread, the others belong to
/// the thread that runs the SPE.
class Allocations {
public:
  static constexpr std::uint32_t kZoneBytes = 128;

  struct Allocation {
    std::uint32_t begin, end; ///< without its zone
    std::uint32_t zone_end;
    std::uint32_t behind;    ///< where the next one may begin
    std::uint32_t unshifted; ///< where it might without any zones
    CallSite site;
  };
  /// A store into the zone behind an allocation.
  struct Overrun {
    Allocation allocation;
    std::uint32_t lsa; ///< of the first changed word
  };

  /// A program begins, which may allocate from `begin` on.
  void begin(std::uint8_t* local_store, std::uint32_t begin, bool red_zones);
  /// It has ended: nothing is known any more.
  void end();
  bool known() const { return known_; }

  /// `arena_end`: without zones. Where local store ends before a zone would, there is none.
  void add(std::uint32_t begin, std::uint32_t bytes, std::uint32_t alignment, std::uint32_t arena_end,
           CallSite site);
  /// Everything from `lsa` on is free again.
  void release(std::uint32_t lsa);

  /// Where the next allocation may begin, and how many bytes further that is than without zones.
  std::uint32_t next() const { return next_; }
  std::uint32_t shift() const { return next_ - unshifted_; }

  /// [lsa, lsa + size) touches an allocation or its zone, and is not within the allocation.
  bool is_left_by(std::uint32_t lsa, std::uint32_t size) const;
  /// The last allocation that begins at `lsa` or before.
  std::optional<Allocation> before(std::uint32_t lsa) const;

  /// A zone that was stored into, which becomes whole again.
  std::optional<Overrun> take_overrun();

private:
  using Iterator = std::vector<Allocation>::const_iterator;
  /// The first that begins behind `lsa`.
  Iterator behind(std::uint32_t lsa) const;
  void fill_zone(const Allocation& allocation) const;

  std::uint8_t* local_store_ = nullptr;
  bool red_zones_ = false;
  std::uint32_t next_ = 0, unshifted_ = 0;
  bool known_ = false;
  mutable std::mutex mutex_;            ///< for changes, and for looks from other threads
  std::vector<Allocation> allocations_; ///< in ascending order
};

} // namespace celltrace::cell_emu
