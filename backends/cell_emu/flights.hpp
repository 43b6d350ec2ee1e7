// The transfers in flight. A transfer is in flight from the issue of its command until the SPU (for proxy
// commands, the PPE) has observed its completion, no matter when the data move. An overlapping access during
// this time is a race.
//
// Both sides of a transfer are ranges of the main storage domain, with local stores at their mapped
// addresses, so that one rule covers local store, main memory, and local store accessed from outside.
#pragma once

#include "backends/cell_emu/line_locks.hpp"
#include "backends/cell_emu/mfc_command.hpp"
#include "celltrace/spe/call_site.hpp"

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace celltrace::cell_emu {

/// One contiguous transfer: a plain command, or an element of a list.
struct Flight {
  std::uint64_t command = 0; ///< number of the command on its SPE
  MfcCommand transfer{};     ///< a plain command, also for an element of a list
  CallSite site;
  bool proxy = false;
  bool has_storage = true; ///< false: a register is on the other side
  ea_t local = 0;          ///< mapped address of the transfer's part of local store

  bool started = false;   ///< all transfers that this transfer is ordered behind are complete
  bool moved = false;     ///< the data have been copied
  bool completed = false; ///< the MFC has reported its completion
  /// True if a command that is ordered behind this transfer has started: a program that observes the
  /// completion of that command knows that this transfer is complete.
  bool released = false;
  /// True if the program has seen the queue empty, but not yet the status of the tag.
  bool drained = false;
  /// True if another transfer may rightly write the same local store, so that changes of it are no error.
  bool shared = false;
  /// True if an access checker reports the program's accesses to the local store.
  bool forbidden = false;
  std::uint64_t hash = 0; ///< checksum of the transfer's local store, if `hashed`
  bool hashed = false;

  std::uint32_t bytes() const { return transfer.size; }
  bool writes_local_store() const { return kind_of(transfer.opcode) == CommandKind::get; }
};

struct Conflict {
  unsigned spe;
  std::uint64_t command;
  MfcCommand transfer;
  CallSite site;
  bool in_local_store; ///< true: the overlap is in the local store of the SPE whose new transfer overlaps
};

/// The flights of all SPEs. Thread safety: one thread at a time changes an SPE's own list;
/// conflicts_elsewhere() may read it meanwhile.
class Flights {
public:
  explicit Flights(unsigned spes) : spes_(spes), lists_(std::make_unique<List[]>(spes)) {}

  /// Return the flights of one SPE, for the thread that runs the SPE.
  const std::vector<Flight>& of(unsigned spe) const { return lists_[spe].flights; }
  Flight& at(unsigned spe, std::size_t index) { return lists_[spe].flights[index]; }

  void add(unsigned spe, const Flight& flight);
  /// Removes the flights for which `predicate(flight)` is true.
  template <class Predicate> void remove_if(unsigned spe, Predicate predicate);
  /// Calls `change(flight)` for each flight while no other thread reads them.
  template <class Change> void for_each(unsigned spe, Change change);

  /// Returns a flight of another SPE that overlaps with `flight`, if at least one of the two writes the
  /// overlap.
  std::optional<Conflict> conflict_elsewhere(unsigned spe, const Flight& flight) const;

private:
  struct alignas(64) List {
    mutable SpinLock lock;
    std::vector<Flight> flights;
  };

  unsigned spes_;
  std::unique_ptr<List[]> lists_;
  /// Number of flights that write outside of the local store of their own SPE; while it is 0, gets cannot
  /// conflict.
  std::atomic<std::uint32_t> outward_{0};
};

/// Overlap of two flights, if at least one of them writes it; `local` is true if the overlap is in the local
/// store on `a`'s side.
struct Overlap {
  bool any = false;
  bool local = false;
};
Overlap overlap_of(const Flight& a, const Flight& b);

template <class Predicate> void Flights::remove_if(unsigned spe, Predicate predicate) {
  List& list = lists_[spe];
  const std::lock_guard lock(list.lock);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < list.flights.size(); ++i) {
    Flight& flight = list.flights[i];
    if (predicate(flight)) {
      if (!flight.writes_local_store()) outward_.fetch_sub(1, std::memory_order_relaxed);
      continue;
    }
    if (kept != i) list.flights[kept] = flight;
    ++kept;
  }
  list.flights.resize(kept);
}

template <class Change> void Flights::for_each(unsigned spe, Change change) {
  List& list = lists_[spe];
  const std::lock_guard lock(list.lock);
  for (Flight& flight : list.flights)
    change(flight);
}

} // namespace celltrace::cell_emu
