// The allocations of a program in its local store, and the red zones behind allocations. Zones are filled
// with poison; a change of the poison reveals a store past an allocation.
//
//   allocation | zone | allocation | zone | free ...
//
// A zone reaches to the next allocation, but not further than kZoneBytes. If red zones are configured, each
// allocation lies a multiple of kZoneBytes further than without red zones, which keeps its alignment. The
// arena grows at its end by the bytes of the zones, so that a program has as much room as without red zones.
// The arena grows into local store that is reserved for the stack, which a program of host code does not use.
#pragma once

#include "celltrace/spe/call_site.hpp"

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace celltrace::cell_emu {

/// Allocations as offsets in one local store. Thread safety: is_left_by() and before() from any thread; the
/// other members belong to the thread that runs the SPE.
class Allocations {
public:
  static constexpr std::uint32_t kZoneBytes = 128;

  struct Allocation {
    std::uint32_t begin, end; ///< range of the allocation, without its zone
    std::uint32_t zone_end;
    std::uint32_t behind;    ///< first offset at which the next allocation may begin
    std::uint32_t unshifted; ///< value of `behind` if there were no zones
    CallSite site;
  };
  /// A store into the zone behind an allocation.
  struct Overrun {
    Allocation allocation;
    std::uint32_t lsa; ///< local-store address of the first changed word
  };

  /// Begins a program that may allocate from `begin` on.
  void begin(std::uint8_t* local_store, std::uint32_t begin, bool red_zones);
  /// Ends the program and forgets its allocations.
  void end();
  bool known() const { return known_; }

  /// Adds an allocation. `arena_end` is the end of the arena without zones. An allocation whose zone would
  /// not fit into local store gets no zone.
  void add(std::uint32_t begin, std::uint32_t bytes, std::uint32_t alignment, std::uint32_t arena_end,
           CallSite site);
  /// Frees everything from `lsa` on.
  void release(std::uint32_t lsa);

  /// Return the offset at which the next allocation may begin, and the number of bytes by which zones have
  /// moved this offset.
  std::uint32_t next() const { return next_; }
  std::uint32_t shift() const { return next_ - unshifted_; }

  /// Returns true if [lsa, lsa + size) touches an allocation or its zone, and is not within the allocation.
  bool is_left_by(std::uint32_t lsa, std::uint32_t size) const;
  /// Returns the last allocation that begins at `lsa` or before.
  std::optional<Allocation> before(std::uint32_t lsa) const;

  /// Returns a store into a zone, if a zone has changed, and restores this zone.
  std::optional<Overrun> take_overrun();

private:
  using Iterator = std::vector<Allocation>::const_iterator;
  /// Returns the first allocation that begins behind `lsa`.
  Iterator behind(std::uint32_t lsa) const;
  void fill_zone(const Allocation& allocation) const;

  std::uint8_t* local_store_ = nullptr;
  bool red_zones_ = false;
  std::uint32_t next_ = 0, unshifted_ = 0;
  bool known_ = false;
  mutable std::mutex mutex_;            ///< guards allocations_ against changes during reads of other threads
  std::vector<Allocation> allocations_; ///< in ascending order
};

} // namespace celltrace::cell_emu
