#include "backends/cell_emu/bus.hpp"

#include "backends/cell_emu/access_checkers.hpp"

#include <algorithm>
#include <cstring>
#include <mutex>

namespace celltrace::cell_emu {
namespace {

std::uint8_t* host_address(ea_t ea) {
  return reinterpret_cast<std::uint8_t*>(static_cast<std::uintptr_t>(ea));
}

/// Permits access to data of a race, so that the emulator can copy them if the rule's action lets the program
/// go on: while a transfer is in flight, its local store is forbidden to the owner's program.
void open_for_race(AddressMap::Place place, ea_t ea, std::uint32_t size) {
  if (place.kind == EaKind::local_store && !may_access(host_address(ea), size))
    permit_access(host_address(ea), size);
}

} // namespace

class Bus::LocalStoreLocks {
public:
  /// Locks the local stores of the issuing SPE `own` and of the target `place`, the lower-numbered SPE first,
  /// to avoid deadlocks.
  LocalStoreLocks(Unit* units, unsigned own, AddressMap::Place place) {
    const unsigned other = place.kind == EaKind::local_store ? place.spe : own;
    first_ = &units[std::min(own, other)].local_store_lock;
    second_ = own == other ? nullptr : &units[std::max(own, other)].local_store_lock;
    first_->lock();
    if (second_ != nullptr) second_->lock();
  }
  ~LocalStoreLocks() {
    if (second_ != nullptr) second_->unlock();
    first_->unlock();
  }
  LocalStoreLocks(const LocalStoreLocks&) = delete;
  LocalStoreLocks& operator=(const LocalStoreLocks&) = delete;

private:
  SpinLock* first_;
  SpinLock* second_;
};

Bus::Bus(const AddressMap& map, const ProblemStates& problem_states)
    : map_(map), problem_states_(problem_states), units_(std::make_unique<Unit[]>(map.spes())),
      locks_(std::make_unique<LineLocks>()) {
}

/// Calls move(stripe, ea, offset, bytes) under the lock of each stripe that [ea, ea + size) crosses.
template <class Move> void Bus::for_each_span(ea_t ea, std::uint32_t size, Move move) {
  for (std::uint32_t offset = 0; offset < size;) {
    const ea_t at = ea + offset;
    const auto room = static_cast<std::uint32_t>(LineLocks::kSpan - at % LineLocks::kSpan);
    const std::uint32_t bytes = std::min(room, size - offset);
    Stripe& stripe = locks_->of(at);
    const std::lock_guard lock(stripe.lock);
    move(stripe, at, offset, bytes);
    offset += bytes;
  }
}

void Bus::get(unsigned spe, std::uint32_t lsa, ea_t ea, std::uint32_t size) {
  count_local_store_write(spe);
  const AddressMap::Place from = map_.locate(ea, size);
  const LocalStoreLocks local_stores(units_.get(), spe, from);
  open_for_race(from, ea, size);
  std::uint8_t* const to = map_.local_store(spe) + lsa;
  // Source and target may overlap: an SPE can address its own local store from outside.
  for_each_span(ea, size, [&](Stripe&, ea_t at, std::uint32_t offset, std::uint32_t bytes) {
    std::memmove(to + offset, host_address(at), bytes);
  });
}

void Bus::count_write(AddressMap::Place to) {
  if (to.kind == EaKind::local_store) count_local_store_write(to.spe);
}

void Bus::put(unsigned spe, std::uint32_t lsa, ea_t ea, std::uint32_t size) {
  const AddressMap::Place to = map_.locate(ea, size);
  const LocalStoreLocks local_stores(units_.get(), spe, to);
  count_write(to);
  open_for_race(to, ea, size);
  const std::uint8_t* const from = map_.local_store(spe) + lsa;
  for_each_span(ea, size, [&](Stripe& stripe, ea_t at, std::uint32_t offset, std::uint32_t bytes) {
    std::memmove(host_address(at), from + offset, bytes);
    lose_reservations(spe, OwnLoss::event, stripe, at, bytes);
  });
}

void Bus::zero(unsigned spe, ea_t ea, std::uint32_t size) {
  const AddressMap::Place to = map_.locate(ea, size);
  const LocalStoreLocks local_stores(units_.get(), spe, to);
  count_write(to);
  open_for_race(to, ea, size);
  for_each_span(ea, size, [&](Stripe& stripe, ea_t at, std::uint32_t, std::uint32_t bytes) {
    std::memset(host_address(at), 0, bytes);
    lose_reservations(spe, OwnLoss::event, stripe, at, bytes);
  });
}

std::uint32_t Bus::read_register(AddressMap::Place place) const {
  return problem_states_[place.spe]->peek_signal(place.kind == EaKind::signal_1 ? Signal::one : Signal::two);
}

bool Bus::write_register(AddressMap::Place place, std::uint32_t value, Sender sender) {
  ProblemState& target = *problem_states_[place.spe];
  if (place.kind == EaKind::in_mailbox) return target.write_in_mailbox(value, sender);
  return target.write_signal(place.kind == EaKind::signal_1 ? Signal::one : Signal::two, value, sender);
}

// --- reservations ---

bool Bus::release_reservation(unsigned spe, Stripe& stripe, ea_t line, Reservation state) {
  std::atomic<ea_t>& reserved = units_[spe].reserved;
  if (reserved.load(std::memory_order_relaxed) != line) return false;
  reserved.store(kNoLine, std::memory_order_relaxed);
  units_[spe].state.store(state, std::memory_order_relaxed);
  --stripe.reservations;
  return true;
}

void Bus::lose_reservations(unsigned writer, OwnLoss own, Stripe& stripe, ea_t ea, std::uint32_t size) {
  if (stripe.reservations == 0) return;
  const ea_t first = ea & ~ea_t{kLineBytes - 1};
  for (unsigned spe = 0; spe < map_.spes(); ++spe) {
    const ea_t line = units_[spe].reserved.load(std::memory_order_relaxed);
    if (line == kNoLine || line - first >= ea + size - first) continue;
    release_reservation(spe, stripe, line,
                        spe == writer ? Reservation::lost_to_own_put : Reservation::lost_to_others);
    if (spe != writer || own == OwnLoss::event) problem_states_[spe]->raise(event::reservation_lost);
  }
}

bool Bus::reserved_by_another(unsigned spe, ea_t line) const {
  for (unsigned other = 0; other < map_.spes(); ++other)
    if (other != spe && reserves(other, line)) return true;
  return false;
}

void Bus::drop_reservation(unsigned spe) {
  const ea_t line = units_[spe].reserved.load(std::memory_order_relaxed);
  if (line == kNoLine) return;
  Stripe& stripe = locks_->of(line);
  const std::lock_guard lock(stripe.lock);
  release_reservation(spe, stripe, line, Reservation::none);
}

void Bus::get_line_and_reserve(unsigned spe, std::uint32_t lsa, ea_t ea) {
  drop_reservation(spe);
  count_local_store_write(spe);
  const AddressMap::Place from = map_.locate(ea, kLineBytes);
  const LocalStoreLocks local_stores(units_.get(), spe, from);
  open_for_race(from, ea, kLineBytes);
  Stripe& stripe = locks_->of(ea);
  const std::lock_guard lock(stripe.lock);
  std::memmove(map_.local_store(spe) + lsa, host_address(ea), kLineBytes);
  units_[spe].reserved.store(ea, std::memory_order_relaxed);
  units_[spe].state.store(Reservation::held, std::memory_order_relaxed);
  ++stripe.reservations;
}

bool Bus::put_line_conditional(unsigned spe, std::uint32_t lsa, ea_t ea) {
  bool written = false;
  {
    const AddressMap::Place to = map_.locate(ea, kLineBytes);
    const LocalStoreLocks local_stores(units_.get(), spe, to);
    count_write(to);
    open_for_race(to, ea, kLineBytes);
    Stripe& stripe = locks_->of(ea);
    const std::lock_guard lock(stripe.lock);
    written = release_reservation(spe, stripe, ea, Reservation::none);
    if (written) {
      std::memmove(host_address(ea), map_.local_store(spe) + lsa, kLineBytes);
      lose_reservations(spe, OwnLoss::silent, stripe, ea, kLineBytes);
    }
  }
  if (!written) drop_reservation(spe);
  return written;
}

void Bus::put_line(unsigned spe, std::uint32_t lsa, ea_t ea) {
  const AddressMap::Place to = map_.locate(ea, kLineBytes);
  const LocalStoreLocks local_stores(units_.get(), spe, to);
  count_write(to);
  open_for_race(to, ea, kLineBytes);
  Stripe& stripe = locks_->of(ea);
  const std::lock_guard lock(stripe.lock);
  std::memmove(host_address(ea), map_.local_store(spe) + lsa, kLineBytes);
  lose_reservations(spe, OwnLoss::silent, stripe, ea, kLineBytes);
}

} // namespace celltrace::cell_emu
