// The element interconnect bus: moves bytes between local stores, main memory and registers, keeps lines
// atomic, and watches the reservations of the lock-line commands.
//
// Every move takes the lock of the issuing SPE's local store, the lock of the target local store if the
// target is a local store, and one after the other the locks of the stripes of lines that it touches
// (line_locks.hpp). This orders DMA against DMA. Direct accesses to memory by an SPE's program or the PPE are
// not ordered, and do not affect reservations.
#pragma once

#include "backends/cell_emu/address_map.hpp"
#include "backends/cell_emu/line_locks.hpp"
#include "backends/cell_emu/problem_state.hpp"

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

namespace celltrace::cell_emu {

/// Moves data. Thread safety: all members from any thread. Commands must have passed the rules of
/// mfc_rules.hpp.
class Bus {
public:
  using ProblemStates = std::vector<ProblemState*>;

  Bus(const AddressMap& map, const ProblemStates& problem_states);

  const AddressMap& map() const { return map_; }

  /// Copies storage to local store address `lsa` of SPE `spe`.
  void get(unsigned spe, std::uint32_t lsa, ea_t ea, std::uint32_t size);
  /// Copies local store to storage. All SPEs, also `spe`, lose reservations of lines that the put touches.
  void put(unsigned spe, std::uint32_t lsa, ea_t ea, std::uint32_t size);

  /// Zeroes lines of main memory or of a local store, as a put of zeros would.
  void zero(unsigned spe, ea_t ea, std::uint32_t size);

  /// Returns the number of writes into the local store by DMA and by the SPE's MFC.
  std::uint64_t local_store_writes(unsigned spe) const {
    return units_[spe].local_store_writes.load(std::memory_order_relaxed);
  }
  void count_local_store_write(unsigned spe) {
    units_[spe].local_store_writes.fetch_add(1, std::memory_order_relaxed);
  }

  /// Calls `use()` while no DMA touches the local store.
  template <class Use> void hold_local_store(unsigned spe, Use use) {
    const std::lock_guard lock(units_[spe].local_store_lock);
    use();
  }

  std::uint32_t read_register(AddressMap::Place place) const;
  /// Writes a register. Returns false if an unread word was lost.
  bool write_register(AddressMap::Place place, std::uint32_t value, Sender sender);

  // Lock-line operations on one line each. An SPE has one reservation; getllar replaces it.
  void get_line_and_reserve(unsigned spe, std::uint32_t lsa, ea_t ea);
  /// Writes the line if the SPE still has its reservation. Returns whether it did; the SPE has no reservation
  /// afterwards.
  bool put_line_conditional(unsigned spe, std::uint32_t lsa, ea_t ea);
  void put_line(unsigned spe, std::uint32_t lsa, ea_t ea);
  void drop_reservation(unsigned spe);
  /// State of the SPE's last reservation.
  enum class Reservation : unsigned char { none, held, lost_to_own_put, lost_to_others };
  Reservation reservation(unsigned spe) const { return units_[spe].state.load(std::memory_order_relaxed); }
  bool reserves(unsigned spe, ea_t line) const {
    return units_[spe].reserved.load(std::memory_order_relaxed) == line;
  }
  /// Returns true if the SPE has a reservation, but of another line.
  bool reserves_other_than(unsigned spe, ea_t line) const {
    const ea_t reserved = units_[spe].reserved.load(std::memory_order_relaxed);
    return reserved != kNoLine && reserved != line;
  }
  bool reserved_by_another(unsigned spe, ea_t line) const;

private:
  /// State of one SPE on the bus.
  struct alignas(64) Unit {
    SpinLock local_store_lock;
    std::atomic<std::uint64_t> local_store_writes{0};
    /// The reserved line, or kNoLine. Changes only under the lock of the line's stripe.
    std::atomic<ea_t> reserved{kNoLine};
    std::atomic<Reservation> state{Reservation::none};
  };
  /// The address of no line: it is not a multiple of 128.
  static constexpr ea_t kNoLine = 1;

  /// Holds the locks of the local stores that a transfer touches.
  class LocalStoreLocks;
  enum class OwnLoss { event, silent };

  void count_write(AddressMap::Place to);
  template <class Move> void for_each_span(ea_t ea, std::uint32_t size, Move move);
  void lose_reservations(unsigned writer, OwnLoss own, Stripe& stripe, ea_t ea, std::uint32_t size);
  bool release_reservation(unsigned spe, Stripe& stripe, ea_t line, Reservation state);

  const AddressMap& map_;
  const ProblemStates& problem_states_;
  std::unique_ptr<Unit[]> units_;
  std::unique_ptr<LineLocks> locks_;
};

} // namespace celltrace::cell_emu
