// The MFC's transfers in flight: conflicts between them, the moves of their data, and accesses of the program
// to their local store.
#include "backends/cell_emu/access_checkers.hpp"
#include "backends/cell_emu/isa/state.hpp"
#include "backends/cell_emu/local_store_watch.hpp"
#include "backends/cell_emu/mfc.hpp"
#include "backends/cell_emu/mfc_rules.hpp"
#include "backends/cell_emu/opened_local_store.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace celltrace::cell_emu {
namespace {

std::string address_text(std::uint32_t address) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%05x", static_cast<unsigned>(address));
  return text;
}

} // namespace

std::uint8_t* Mfc::local_store(const MfcCommand& transfer) const {
  return bus_.map().local_store(spe_) + transfer.lsa;
}

bool Mfc::is_ordered_before(const Flight& flight, const Entry& entry) const {
  if (flight.proxy != entry.proxy || flight.command > entry.number) return false;
  if (flight.command == entry.number) return true; // elements of a list are transferred in order
  if (kind_of(entry.command.opcode) == CommandKind::barrier ||
      flight.command < last_queue_barrier_[entry.proxy])
    return true;
  if (flight.transfer.tag != entry.command.tag) return false;
  return follows_its_tag(entry.command.opcode) ||
         flight.command <= last_tag_barrier_[entry.proxy][entry.command.tag];
}

/// Returns true if the flight belongs to a command that waits until all of `entry`, a list that goes on after
/// a stop, is complete.
bool Mfc::is_ordered_behind(const Flight& flight, const Entry& entry) const {
  if (flight.proxy != entry.proxy || flight.command <= entry.number) return false;
  std::vector<const MfcCommand*> chain{&entry.command};
  for (const Entry& later : queue_) {
    if (later.proxy != entry.proxy || later.number <= entry.number) continue;
    if (std::none_of(chain.begin(), chain.end(),
                     [&](const MfcCommand* earlier) { return is_ordered(*earlier, later.command); }))
      continue;
    if (later.number == flight.command) return true;
    chain.push_back(&later.command);
  }
  return false;
}

void Mfc::forbid(Flight& flight) {
  // Machine code may load data early, as long as it does not use them (early_loads.hpp).
  if (!has_checker_ || watch_ != nullptr) return;
  flight.forbidden = true;
  forbid_access(local_store(flight.transfer), flight.bytes());
}

void Mfc::permit(Flight& flight) {
  if (!flight.forbidden) return;
  flight.forbidden = false;
  permit_access(local_store(flight.transfer), flight.bytes());
}

Mfc::OpenedLocalStore::OpenedLocalStore(const Mfc& mfc, const MfcCommand& transfer)
    : mfc_(mfc), begin_(transfer.lsa), end_(transfer.lsa + transfer.size) {
  for_each([&](const Flight& flight) { permit_access(mfc_.local_store(flight.transfer), flight.bytes()); });
}

Mfc::OpenedLocalStore::~OpenedLocalStore() {
  for_each([&](const Flight& flight) { forbid_access(mfc_.local_store(flight.transfer), flight.bytes()); });
}

template <class Do> void Mfc::OpenedLocalStore::for_each(Do action) const {
  if (!mfc_.has_checker_) return;
  for (const Flight& flight : mfc_.context_.flights.of(mfc_.spe_))
    if (flight.forbidden && flight.transfer.lsa < end_ && begin_ < flight.transfer.lsa + flight.bytes())
      action(flight);
}

void Mfc::depart(const Entry& entry, const MfcCommand& transfer, Cycle now) {
  if (transfer.size == 0) return;
  Flight flight;
  flight.command = entry.number;
  flight.transfer = transfer;
  flight.site = entry.site;
  flight.proxy = entry.proxy;
  flight.local = bus_.map().addresses(spe_).local_store + transfer.lsa;
  const bool lock_line = kind_of(transfer.opcode) == CommandKind::lock_line;
  if (is_immediate(transfer.opcode))
    flight.transfer.opcode = transfer.opcode == MfcOpcode::getllar ? MfcOpcode::get : MfcOpcode::put;
  // Lines of lock-line commands and registers cannot be part of a race.
  flight.has_storage = !lock_line && !is_register(bus_.map().locate(transfer.ea, transfer.size).kind);
  for (std::size_t i = 0; i < context_.flights.of(spe_).size(); ++i) {
    Flight& other = context_.flights.at(spe_, i);
    const Overlap overlap = overlap_of(flight, other);
    if (!overlap.any) continue;
    if (is_ordered_before(other, entry) || is_ordered_behind(other, entry)) {
      flight.shared = other.shared = true;
      continue;
    }
    if (other.drained) {
      other.shared = true;
      report_drained(FlightInfo(other), now);
      continue;
    }
    report_conflict(entry, transfer, {spe_, other.command, other.transfer, other.site, overlap.local}, now);
  }
  if (flight.has_storage)
    if (const auto conflict = context_.flights.conflict_elsewhere(spe_, flight))
      report_conflict(entry, transfer, *conflict, now);
  if (is_immediate(transfer.opcode)) return;
  context_.flights.add(spe_, flight);
  watch(flight);
}

// --- loads and stores of machine code ---

/// Marks the quadwords of a flight's local store, so that the SPU's loads and stores there are checked. Skips
/// proxy commands, which the SPU cannot know.
void Mfc::watch(const Flight& flight) {
  if (watch_ == nullptr || flight.proxy) return;
  const std::uint32_t lsa = flight.transfer.lsa;
  const std::uint8_t bits = flight.writes_local_store() ? isa::State::kWatchLoads | isa::State::kWatchStores
                                                        : isa::State::kWatchStores;
  for (std::uint32_t quadword = lsa / 16; quadword <= (lsa + flight.bytes() - 1) / 16; ++quadword)
    watch_[quadword] |= bits;
}

template <class Predicate> void Mfc::remove_flights(Predicate predicate) {
  if (watch_ != nullptr) {
    for (const Flight& flight : context_.flights.of(spe_))
      if (predicate(flight))
        std::memset(watch_ + flight.transfer.lsa / 16, 0,
                    (flight.transfer.lsa % 16 + flight.bytes() + 15) / 16);
  }
  if (has_checker_)
    context_.flights.for_each(spe_, [&](Flight& flight) {
      if (predicate(flight)) permit(flight);
    });
  context_.flights.remove_if(spe_, predicate);
  // Restore the marks of other flights in the same quadwords.
  for (const Flight& flight : context_.flights.of(spe_)) {
    watch(flight);
    if (flight.forbidden) forbid_access(local_store(flight.transfer), flight.bytes());
  }
}

void Mfc::report_access(const FlightInfo& flight, Rule rule, const std::string& what, CallSite site,
                        Cycle now) {
  Diagnostic diagnostic = about({flight.transfer, flight.command, site, false, now}, rule, now);
  diagnostic.other_site = flight.site;
  std::string command = describe(flight.transfer);
  if (const std::string where = to_text(flight.site); !where.empty()) command += ", at " + where;
  context_.log.report(diagnostic, what + " meets " + command + ": " + std::string(text_of(rule)));
}

std::optional<Mfc::FlightInfo> Mfc::get_in_flight(std::uint32_t lsa) const {
  for (const Flight& flight : context_.flights.of(spe_))
    if (!flight.proxy && flight.writes_local_store() && flight.transfer.lsa <= lsa &&
        flight.transfer.lsa + flight.bytes() >= lsa + 16)
      return FlightInfo(flight);
  return std::nullopt;
}

void Mfc::report_early_load(const FlightInfo& flight, std::uint32_t lsa, CallSite load, CallSite use,
                            Cycle now) {
  if (flight.drained) return report_drained(flight, now);
  report_access(flight, Rule::get_target_read,
                "load of LS " + address_text(lsa) + ", used at " + to_text(use) + ",", load, now);
}

void Mfc::check_store(std::uint32_t lsa, const std::uint8_t* bytes, CallSite site, Cycle now) {
  for (std::size_t i = 0; i < context_.flights.of(spe_).size(); ++i) {
    Flight& flight = context_.flights.at(spe_, i);
    const std::uint32_t begin = std::max(lsa, flight.transfer.lsa);
    const std::uint32_t end = std::min(lsa + 16, flight.transfer.lsa + flight.bytes());
    if (flight.proxy || begin >= end) continue;
    const bool get = flight.writes_local_store();
    if (!get && std::memcmp(bus_.map().local_store(spe_) + begin, bytes + (begin - lsa), end - begin) == 0)
      continue;
    flight.shared = true; // prevents a second report
    if (flight.drained)
      report_drained(FlightInfo(flight), now);
    else
      report_access(FlightInfo(flight), get ? Rule::get_target_touched : Rule::put_source_changed,
                    "store to LS " + address_text(lsa), site, now);
  }
}

void Mfc::report_conflict(const Entry& entry, const MfcCommand& transfer, const Conflict& conflict,
                          Cycle now) {
  const Rule rule = conflict.in_local_store ? Rule::local_store_race : Rule::main_storage_race;
  Diagnostic diagnostic = about({transfer, entry.number, entry.site, entry.proxy, now}, rule, now);
  diagnostic.other_spe = conflict.spe;
  diagnostic.other_command = conflict.command;
  diagnostic.other_site = conflict.site;
  std::string other = "command " + std::to_string(conflict.command) + " of SPE " +
                      std::to_string(conflict.spe) + " (" + describe(conflict.transfer);
  if (const std::string site = to_text(conflict.site); !site.empty()) other += ", at " + site;
  context_.log.report(diagnostic,
                      describe(transfer) + " meets " + other + "): " + std::string(text_of(rule)));
}

void Mfc::report_touched(const Flight& flight, Cycle now) {
  const Rule rule = flight.writes_local_store() ? Rule::get_target_touched : Rule::put_source_changed;
  report({flight.transfer, flight.command, flight.site, flight.proxy, now}, rule, now);
}

void Mfc::check_source(const Flight& flight, const Entry& entry, Cycle now) {
  // Loads of machine code are checked instead; besides, machine code may put uninitialised variables.
  if (watch_ != nullptr || flight.proxy) return;
  const auto found = find_in_flight_word(local_store(flight.transfer), flight.bytes());
  if (!found) return;
  report({flight.transfer, entry.number, entry.site, false, now}, Rule::get_target_read, now,
         "LS " + address_text(flight.transfer.lsa + *found) +
             " has what lies where a get's data are still to come, in ");
}

void Mfc::verify(const Flight& flight, Cycle now) {
  if (!flight.hashed || flight.shared) return;
  const OpenedLocalStore opened(*this, flight.transfer);
  if (checksum(local_store(flight.transfer), flight.bytes()) == flight.hash) return;
  if (flight.drained)
    report_drained(FlightInfo(flight), now);
  else
    report_touched(flight, now);
}

void Mfc::move_word(const Flight& flight, AddressMap::Place place, Cycle now) {
  std::uint8_t* const word = local_store(flight.transfer);
  std::uint32_t value;
  if (flight.writes_local_store()) {
    value = context_.from_spu(bus_.read_register(place));
    bus_.count_local_store_write(spe_);
    std::memcpy(word, &value, sizeof value);
    counters_.dma_bytes_read.add(sizeof value);
    return;
  }
  std::memcpy(&value, word, sizeof value);
  value = context_.from_spu(value);
  const bool mail = place.kind == EaKind::in_mailbox;
  counters_.dma_bytes_written.add(sizeof value);
  (mail ? counters_.mailbox_words_sent : counters_.signals_sent).add(1);
  if (bus_.write_register(place, value, {flight.proxy ? Diagnostic::kPpe : spe_, now})) return;
  const Rule rule = mail ? Rule::mailbox_overwritten : Rule::signal_overwritten;
  Diagnostic diagnostic = about({flight.transfer, flight.command, flight.site, flight.proxy, now}, rule, now);
  diagnostic.other_spe = place.spe;
  context_.log.report(diagnostic, describe(flight.transfer) + " (" + (mail ? "mailbox" : "signal") +
                                      " of SPE " + std::to_string(place.spe) +
                                      "): " + std::string(text_of(rule)));
}

void Mfc::move(Flight& flight, Cycle now, bool observed) {
  flight.moved = true;
  const auto [opcode, tag, lsa, size, ea] = flight.transfer;
  std::uint8_t* const local = local_store(flight.transfer);
  // The program may access the local store of a proxy command as soon as its data have moved.
  if (flight.proxy) permit(flight);
  const OpenedLocalStore opened(*this, flight.transfer);
  const AddressMap::Place place = bus_.map().locate(ea, size);
  if (flight.writes_local_store()) {
    const bool touched = flight.hashed && !flight.shared && !is_as_in_flight(local, size);
    if (is_register(place.kind)) {
      move_word(flight, place, now);
    } else {
      bus_.get(spe_, lsa, ea, size);
      counters_.dma_bytes_read.add(size);
    }
    flight.hashed = !flight.shared && !observed;
    if (flight.hashed) flight.hash = checksum(local, size);
    if (touched) report_touched(flight, now);
    return;
  }
  verify(flight, now);
  if (is_register(place.kind)) {
    move_word(flight, place, now);
  } else if (opcode == MfcOpcode::putqlluc) {
    bus_.put_line(spe_, lsa, ea);
    counters_.dma_bytes_written.add(size);
  } else {
    bus_.put(spe_, lsa, ea, size);
    counters_.dma_bytes_written.add(size);
  }
}

template <class Predicate> void Mfc::observe_if(Predicate predicate, Cycle now) {
  for (std::size_t i = 0; i < context_.flights.of(spe_).size(); ++i) {
    Flight& flight = context_.flights.at(spe_, i);
    if (!predicate(flight)) continue;
    if (!flight.moved)
      move(flight, now, true);
    else
      verify(flight, now);
  }
  remove_flights(predicate);
}

void Mfc::observe(std::uint32_t tags, std::uint64_t last_command, bool proxy, Cycle now) {
  observe_if(
      [&](const Flight& flight) {
        return flight.completed && flight.proxy == proxy && (tags >> flight.transfer.tag & 1) != 0 &&
               flight.command <= last_command;
      },
      now);
}

void Mfc::observe_empty_queue(CallSite site, Cycle now) {
  const std::vector<Flight>& flights = context_.flights.of(spe_);
  const auto is_new = [](const Flight& flight) { return !flight.proxy && !flight.drained; };
  if (std::none_of(flights.begin(), flights.end(), is_new)) return;
  drain_site_ = site;
  if (drain_reported_ || !context_.log.checks(Rule::drained_queue)) {
    observe_if([](const Flight& flight) { return !flight.proxy; }, now);
    return;
  }
  for (std::size_t i = 0; i < flights.size(); ++i) {
    Flight& flight = context_.flights.at(spe_, i);
    if (!is_new(flight)) continue;
    if (!flight.moved)
      move(flight, now);
    else
      verify(flight, now);
  }
  context_.flights.for_each(spe_, [&](Flight& flight) {
    if (flight.proxy) return;
    flight.drained = flight.released = true;
    permit(flight);
  });
}

bool Mfc::note_drained(const FlightInfo& flight, Diagnostic& diagnostic, Cycle now) {
  // Reported once: a program that relies on the queue's count does so everywhere.
  if (drain_reported_) return false;
  drain_reported_ = true;
  diagnostic = about({flight.transfer, flight.command, drain_site_, false, 0}, Rule::drained_queue, now);
  std::string what = describe(flight.transfer);
  if (const std::string site = to_text(flight.site); !site.empty()) what += " at " + site;
  return context_.log.note(diagnostic, what + ": " + std::string(text_of(Rule::drained_queue)));
}

void Mfc::report_drained(const FlightInfo& flight, Cycle now) {
  Diagnostic diagnostic;
  if (note_drained(flight, diagnostic, now) && diagnostic.action == Action::stop)
    throw RuleViolation(diagnostic);
}

void Mfc::observe_part(std::uint64_t command, Cycle now) {
  observe_if([&](const Flight& flight) { return flight.command == command && flight.completed; }, now);
}

void Mfc::observe_proxy(std::uint32_t tags, Cycle now) {
  observe(tags, commands_, true, now);
}

} // namespace celltrace::cell_emu
