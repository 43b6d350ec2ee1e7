#include "backends/cell_emu/mfc.hpp"

#include "backends/cell_emu/local_store_watch.hpp"
#include "backends/cell_emu/mfc_rules.hpp"
#include "backends/cell_emu/opened_local_store.hpp"
#include "celltrace/spe/channels.hpp"
#include "celltrace/spe/spu.hpp"

#include <algorithm>
#include <bit>
#include <cinttypes>
#include <cstdio>
#include <cstring>

namespace celltrace::cell_emu {
namespace {

constexpr std::uint64_t kMfcStream = 0x4D4643;

std::string to_hex(std::uint32_t value) {
  char text[9];
  std::snprintf(text, sizeof text, "%x", static_cast<unsigned>(value));
  return text;
}

/// Returns whether a command that broke a rule, whose action is not to stop, can still be carried out.
constexpr bool can_be_carried_out(Rule rule) {
  return rule == Rule::none || rule == Rule::zero_size || rule == Rule::line_alignment ||
         rule == Rule::program_overwritten || rule == Rule::allocation_bounds || rule == Rule::object_bounds;
}

std::string describe(const Allocations::Allocation& allocation) {
  std::string text =
      std::to_string(allocation.end - allocation.begin) + " bytes at LS 0x" + to_hex(allocation.begin);
  if (const std::string site = to_text(allocation.site); !site.empty()) text += ", made at " + site;
  return text;
}

/// Returns the bytes of local store that a command uses; for a list command those of the list.
std::uint32_t storage_bytes(const MfcCommand& command) {
  switch (kind_of(command.opcode)) {
  case CommandKind::get:
  case CommandKind::put:
  case CommandKind::send_signal:
    return command.size;
  case CommandKind::lock_line:
    return kLineBytes;
  case CommandKind::barrier:
  case CommandKind::cache_control:
  case CommandKind::unknown:
    break;
  }
  return 0;
}

const char* name_of(EaKind kind) {
  switch (kind) {
  case EaKind::main_memory:
    return "main memory";
  case EaKind::local_store:
    return "local store";
  case EaKind::signal_1:
    return "signal 1";
  case EaKind::signal_2:
    return "signal 2";
  case EaKind::in_mailbox:
    return "in mailbox";
  case EaKind::no_register:
  case EaKind::unmapped:
    break;
  }
  return "nothing";
}

} // namespace

Mfc::Mfc(unsigned spe, const MfcContext& context, DmaTiming& timing, ProblemState& problem_state,
         Counters& counters)
    : spe_(spe), context_(context), bus_(context.bus), timing_(timing), problem_state_(problem_state),
      counters_(counters), random_(context.config.seed, kMfcStream + spe) {
}

// --- a program's life ---

void Mfc::begin_program(ArenaRange arena) {
  arena_ = arena;
  plain_arena_end_ = arena.end;
  bus_.map().local_stores().take_overrun(spe_);
  allocations().end();
  host_memory_.forget();
  tag_groups_ = {};
  used_tags_ = waited_tags_ = stalled_tags_ = 0;
  waits_ = {};
  last_request_ = {};
  atomic_status_.reset();
  drain_site_ = {};
  drain_reported_ = false;
}

void Mfc::finish(Cycle now) {
  while (next_event() != kNever)
    now = std::max(now, run_next());
  const auto still_stopped = [&](std::uint64_t command) {
    return std::any_of(queue_.begin(), queue_.end(), [&](const Entry& entry) {
      return !entry.proxy && entry.number == command && entry.stalled;
    });
  };
  const std::uint32_t idle_waits = waited_tags_ & ~used_tags_;
  std::optional<Diagnostic> first;
  std::uint64_t last = 0;
  const auto report_left = [&](const Entry& entry) {
    if (entry.number == last) return;
    last = entry.number;
    Diagnostic diagnostic = about(entry, Rule::in_flight_at_exit, now);
    std::string what = describe(entry.command) + ": " + std::string(text_of(Rule::in_flight_at_exit));
    if (still_stopped(entry.number)) what += "; its list is still stopped at a notify element";
    const bool kept = context_.log.note(diagnostic, what);
    if (kept && diagnostic.action == Action::stop && !first) first = diagnostic;
  };
  Diagnostic overrun;
  if (note_overrun(overrun, {}, now) && overrun.action == Action::stop) first = overrun;
  while (note_allocation_overrun(overrun, {}, now))
    if (overrun.action == Action::stop && !first) first = overrun;
  for (const Flight& flight : context_.flights.of(spe_)) {
    if (flight.proxy) continue;
    Diagnostic diagnostic;
    if (!flight.drained)
      report_left({flight.transfer, flight.command, flight.site, false, 0});
    else if (note_drained(FlightInfo(flight), diagnostic, now) && diagnostic.action == Action::stop && !first)
      first = diagnostic;
  }
  // A stopped list whose transferred part the program has seen has no flight, but is not done.
  const std::vector<Flight>& flights = context_.flights.of(spe_);
  for (const Entry& entry : queue_)
    if (entry.stalled && !entry.proxy &&
        std::none_of(flights.begin(), flights.end(),
                     [&](const Flight& flight) { return flight.command == entry.number; }))
      report_left(entry);
  if (last != 0 && idle_waits != 0) {
    Diagnostic diagnostic = about({}, Rule::wait_without_command, now);
    diagnostic.tag = static_cast<std::uint32_t>(std::countr_zero(idle_waits));
    diagnostic.site = waits_[diagnostic.tag];
    context_.log.note(diagnostic, "tag groups 0x" + to_hex(idle_waits) + ": " +
                                      std::string(text_of(Rule::wait_without_command)));
  }
  if (tag_groups_.available() || tag_groups_.waiting()) {
    Diagnostic diagnostic = about({}, Rule::tag_status_unread, now);
    diagnostic.site = last_request_;
    context_.log.note(diagnostic, std::string(text_of(Rule::tag_status_unread)));
  }
  if (atomic_status_ && !first) {
    Diagnostic diagnostic =
        about({last_atomic_, commands_, last_atomic_site_, false, 0}, Rule::atomic_status_unread, now);
    if (context_.log.note(diagnostic,
                          describe(last_atomic_) + ": " + std::string(text_of(Rule::atomic_status_unread))) &&
        diagnostic.action == Action::stop)
      first = diagnostic;
  }
  abandon();
  if (first) throw RuleViolation(*first);
}

ForeignStoreWatch::Used Mfc::local_store_in_use() const {
  const std::uint64_t used = std::min<std::uint64_t>(counters_.local_store_peak.value() + red_zone_bytes(),
                                                     arena_.end - arena_.begin);
  return {bus_.map().local_store(spe_) + arena_.begin, static_cast<std::uint32_t>(used),
          bus_.local_store_writes(spe_)};
}

void Mfc::abandon() {
  allocations().end();
  context_.flights.for_each(spe_, [&](Flight& flight) {
    if (!flight.proxy) permit(flight);
  });
  context_.flights.remove_if(spe_, [](const Flight& flight) { return !flight.proxy; });
  std::erase_if(queue_, [](const Entry& entry) { return !entry.proxy; });
  spu_entries_ = 0;
  stalled_tags_ = 0;
  tag_groups_ = {};
  atomic_status_.reset();
  bus_.drop_reservation(spe_);
  start_ready(0);
}

// --- issue ---

Diagnostic Mfc::about(const Entry& entry, Rule rule, Cycle now) const {
  Diagnostic diagnostic;
  diagnostic.rule = rule;
  diagnostic.spe = entry.proxy ? Diagnostic::kPpe : spe_;
  if (entry.proxy) diagnostic.other_spe = spe_;
  diagnostic.command = entry.number;
  diagnostic.opcode = static_cast<std::uint32_t>(entry.command.opcode);
  diagnostic.tag = entry.command.tag;
  diagnostic.lsa = entry.command.lsa;
  diagnostic.size = entry.command.size;
  diagnostic.ea = entry.command.ea;
  diagnostic.site = entry.site;
  diagnostic.cycle = now;
  return diagnostic;
}

void Mfc::report(const Entry& entry, Rule rule, Cycle now, const std::string& before) const {
  context_.log.report(about(entry, rule, now), before + describe(entry.command) + ": " +
                                                   std::string(text_of(rule)) + bounds_of(rule, entry));
}

void Mfc::report_channel(Channel channel, std::uint32_t value, Rule rule, CallSite site, Cycle now) const {
  Diagnostic diagnostic = about({}, rule, now);
  diagnostic.site = site;
  context_.log.report(diagnostic, std::string(celltrace::name_of(channel)) + " " + std::to_string(value) +
                                      ": " + std::string(text_of(rule)));
}

bool Mfc::note_overrun(Diagnostic& diagnostic, CallSite site, Cycle now) {
  const auto at = bus_.map().local_stores().take_overrun(spe_);
  if (!at) return false;
  diagnostic = about({}, Rule::local_store_overrun, now);
  diagnostic.site = site;
  diagnostic.lsa = static_cast<std::uint32_t>(*at);
  const std::string where = *at < 0 ? std::to_string(-*at) + " bytes in front of LS 0"
                                    : "near LS 0x" + to_hex(static_cast<std::uint32_t>(*at));
  return context_.log.note(diagnostic, where + ": " + std::string(text_of(diagnostic.rule)));
}

// --- allocations ---

void Mfc::begin_allocations(const std::uint8_t* from) {
  std::uint8_t* const local_store = bus_.map().local_store(spe_);
  allocations().begin(local_store, static_cast<std::uint32_t>(from - local_store), context_.config.red_zones);
}

void Mfc::allocated(const std::uint8_t* begin, std::uint32_t bytes, std::uint32_t alignment, CallSite site,
                    ArenaState& arena) {
  if (!allocations().known()) return;
  const auto lsa = static_cast<std::uint32_t>(begin - bus_.map().local_store(spe_));
  allocations().add(lsa, bytes, alignment, plain_arena_end_, site);
  fit_arena(arena);
}

void Mfc::release(const std::uint8_t* from, CallSite site, Cycle now, ArenaState& arena) {
  if (allocations().known()) check_stores(site, now);
  allocations().release(static_cast<std::uint32_t>(from - bus_.map().local_store(spe_)));
  fit_arena(arena);
}

void Mfc::fit_arena(ArenaState& arena) {
  arena_.end = std::min(plain_arena_end_ + allocations().shift(), kLocalStoreBytes);
  std::uint8_t* const local_store = bus_.map().local_store(spe_);
  arena.next = local_store + std::min(allocations().next(), arena_.end);
  arena.end = local_store + arena_.end;
}

bool Mfc::note_allocation_overrun(Diagnostic& diagnostic, CallSite site, Cycle now) {
  const auto overrun = allocations().take_overrun();
  if (!overrun) return false;
  diagnostic = about({}, Rule::allocation_overrun, now);
  diagnostic.site = site;
  diagnostic.lsa = overrun->lsa;
  diagnostic.other_site = overrun->allocation.site;
  return context_.log.note(diagnostic, "near LS 0x" + to_hex(overrun->lsa) + ": " +
                                           std::string(text_of(diagnostic.rule)) + " of " +
                                           describe(overrun->allocation));
}

/// Reports stores past the local store or past allocations since the last check.
void Mfc::check_stores(CallSite site, Cycle now) {
  Diagnostic overrun;
  if (!bus_.map().local_stores().is_edge_intact(spe_) && note_overrun(overrun, site, now) &&
      overrun.action == Action::stop)
    throw RuleViolation(overrun);
  if (note_allocation_overrun(overrun, site, now) && overrun.action == Action::stop)
    throw RuleViolation(overrun);
}

/// Returns the range of local store in which a command leaves an allocation: of the issuing program, or of
/// another SPE's. A proxy command is not checked against its own SPE's allocations.
std::optional<Mfc::LocalRange> Mfc::unallocated(const MfcCommand& command, bool proxy) const {
  const std::uint32_t size = storage_bytes(command);
  if (size == 0) return std::nullopt;
  const std::uint32_t lsa = is_list(command.opcode) ? static_cast<std::uint32_t>(command.ea) : command.lsa;
  if (!proxy && allocations().is_left_by(lsa, size)) return LocalRange{spe_, lsa};
  if (is_list(command.opcode)) return std::nullopt;
  const AddressMap::Place place = bus_.map().locate(command.ea, size);
  if (place.kind != EaKind::local_store || (place.spe == spe_ && !proxy)) return std::nullopt;
  const auto there = static_cast<std::uint32_t>(command.ea - bus_.map().addresses(place.spe).local_store);
  if (!context_.bounds.allocations[place.spe].is_left_by(there, size)) return std::nullopt;
  return LocalRange{place.spe, there};
}

/// Returns the object that the command leaves. Lock-line commands move whole lines, whatever lies in them.
std::optional<MemoryObject> Mfc::left_object(const MfcCommand& command) const {
  const CommandKind kind = kind_of(command.opcode);
  if ((kind != CommandKind::get && kind != CommandKind::put) || is_list(command.opcode) || command.size == 0)
    return std::nullopt;
  return context_.bounds.objects.left_by(command.ea, command.size);
}

Rule Mfc::broken_bounds_rule(const MfcCommand& command, bool proxy) const {
  if (unallocated(command, proxy)) return Rule::allocation_bounds;
  return left_object(command) ? Rule::object_bounds : Rule::none;
}

std::string Mfc::bounds_of(Rule rule, const Entry& entry) const {
  if (rule == Rule::object_bounds) {
    const auto object = left_object(entry.command);
    if (!object) return {};
    char text[80];
    std::snprintf(text, sizeof text, ": %" PRIu64 " bytes at EA 0x%" PRIx64, object->bytes, object->ea);
    return (object->name.empty() ? "" : ", '" + object->name + "'") + std::string(text);
  }
  if (rule != Rule::allocation_bounds) return {};
  const auto range = unallocated(entry.command, entry.proxy);
  if (!range) return {};
  const auto before = context_.bounds.allocations[range->spe].before(range->lsa);
  const std::string whose = range->spe == spe_ ? "" : " of SPE " + std::to_string(range->spe);
  return before ? "; the last one before it" + whose + " is " + describe(*before) : "";
}

/// Checks that a get fills only the program's own part of local store.
Rule Mfc::broken_arena_rule(const MfcCommand& transfer) const {
  const bool outside = transfer.lsa < arena_.begin || transfer.lsa + transfer.size > arena_.end;
  const bool fills = kind_of(transfer.opcode) == CommandKind::get && transfer.size != 0;
  return fills && outside ? Rule::program_overwritten : Rule::none;
}

EaKind Mfc::target_of(const MfcCommand& command, std::uint32_t size, bool proxy) {
  const EaKind kind = bus_.map().locate(command.ea, size).kind;
  if (kind != EaKind::main_memory) return kind;
  const bool write = writes_storage(command.opcode);
  // The PPE checks its commands on a thread of its own.
  const bool accessible = proxy ? accessible_memory(command.ea, size, write).has_value()
                                : host_memory_.is_accessible(command.ea, size, write);
  return accessible ? kind : EaKind::unmapped;
}

bool Mfc::check(const MfcCommand& command, std::uint64_t number, CallSite site, Cycle now, bool proxy) {
  Rule rule = broken_common_rule(command);
  if (rule == Rule::none && proxy) rule = broken_proxy_rule(command);
  const CommandKind kind = kind_of(command.opcode);
  if (rule == Rule::none) {
    if (is_list(command.opcode))
      rule = broken_list_rule(command);
    else if (kind == CommandKind::lock_line)
      rule = broken_lock_line_rule(command, target_of(command, kLineBytes, proxy));
    else if (kind == CommandKind::cache_control)
      rule = broken_cache_control_rule(command, target_of(command, command.size, proxy));
    else if (kind != CommandKind::barrier)
      rule = broken_transfer_rule(command, target_of(command, command.size, proxy));
  }
  if (rule == Rule::none && !is_list(command.opcode)) rule = broken_arena_rule(command);
  if (rule == Rule::none) rule = broken_bounds_rule(command, proxy);
  if (rule == Rule::none && (kind == CommandKind::get || kind == CommandKind::put) && command.size == 0)
    rule = Rule::zero_size;
  if (rule != Rule::none) report({command, number, site, proxy, now}, rule, now);
  return can_be_carried_out(rule);
}

void Mfc::issue(const MfcCommand& given, CallSite site, Cycle now) {
  check_stores(site, now);
  ++commands_;
  if (!check(given, commands_, site, now, false)) return;
  MfcCommand command = given;
  if (kind_of(command.opcode) == CommandKind::lock_line) {
    // If an unaligned command is let pass, its addresses are truncated as on the hardware.
    command.lsa &= ~(kLineBytes - 1);
    command.ea &= ~ea_t{kLineBytes - 1};
  }
  counters_.dma_commands.add(1);
  const std::uint32_t bit = 1u << command.tag;
  if (is_immediate(command.opcode)) {
    check_conditional(command, site, now);
    last_atomic_ = command;
    last_atomic_site_ = site;
    depart({command, commands_, site, false, now}, command, now);
    execute_immediate(command, now);
    return;
  }
  if ((tag_groups_.waiting() || tag_groups_.available()) && (tag_groups_.mask() & bit) != 0)
    report({command, commands_, site, false, now}, Rule::tag_reused, now);
  used_tags_ |= bit;
  enqueue(command, site, now, false);
}

bool Mfc::check_proxy(const MfcCommand& command, Cycle now) {
  return check(command, 0, {}, now, true);
}

void Mfc::issue_proxy(const MfcCommand& command, Cycle now) {
  ++commands_;
  enqueue(command, {}, now, true);
}

void Mfc::perform_proxy(const MfcCommand& command) {
  if (command.size == 0) return;
  const AddressMap::Place place = bus_.map().locate(command.ea, command.size);
  const bool reads = kind_of(command.opcode) == CommandKind::get;
  if (!is_register(place.kind))
    return reads ? bus_.get(spe_, command.lsa, command.ea, command.size)
                 : bus_.put(spe_, command.lsa, command.ea, command.size);
  std::uint32_t value;
  if (reads) {
    value = context_.from_spu(bus_.read_register(place));
    std::memcpy(local_store(command), &value, sizeof value);
  } else {
    std::memcpy(&value, local_store(command), sizeof value);
    bus_.write_register(place, context_.from_spu(value), {Diagnostic::kPpe, 0});
  }
}

void Mfc::enqueue(const MfcCommand& command, CallSite site, Cycle now, bool proxy) {
  Entry entry{command, commands_, site, proxy, now};
  if (is_list(command.opcode)) {
    entry.next_lsa = command.lsa & ~15u;
    read_list(entry);
    begin_part(entry, now);
  } else if (kind_of(command.opcode) != CommandKind::barrier &&
             kind_of(command.opcode) != CommandKind::cache_control) {
    depart(entry, command, now);
  }
  if (kind_of(command.opcode) == CommandKind::barrier) last_queue_barrier_[proxy] = commands_;
  if (has_barrier(command.opcode)) last_tag_barrier_[proxy][command.tag] = commands_;
  queue_.push_back(std::move(entry));
  if (!proxy) ++spu_entries_;
  start_ready(now + context_.config.timing.mfc_issue);
}

void Mfc::check_conditional(const MfcCommand& command, CallSite site, Cycle now) {
  if (command.opcode != MfcOpcode::putllc) return;
  Rule rule = Rule::none;
  switch (bus_.reservation(spe_)) {
  case Bus::Reservation::none:
    rule = Rule::conditional_without_reservation;
    break;
  case Bus::Reservation::lost_to_own_put:
    rule = Rule::reservation_lost_to_own_put;
    break;
  case Bus::Reservation::held:
    // Another SPE may have taken the line in the meantime, which is no mistake.
    if (bus_.reserves_other_than(spe_, command.ea)) rule = Rule::conditional_without_reservation;
    break;
  case Bus::Reservation::lost_to_others:
    break;
  }
  if (rule != Rule::none) report({command, commands_, site, false, now}, rule, now);
}

void Mfc::execute_immediate(const MfcCommand& command, Cycle now) {
  const auto [opcode, tag, lsa, size, ea] = command;
  const bool elsewhere = bus_.reserved_by_another(spe_, ea);
  const OpenedLocalStore opened(*this, command);
  const TimingParameters& timing = context_.config.timing;
  atomic_due_ = now + timing.mfc_issue + (elsewhere ? timing.lock_line_spe : timing.lock_line_memory);
  if (opcode == MfcOpcode::getllar) {
    bus_.get_line_and_reserve(spe_, lsa, ea);
    counters_.dma_bytes_read.add(kLineBytes);
    atomic_status_ = atomic_status::getllar_done;
  } else if (opcode == MfcOpcode::putlluc) {
    bus_.put_line(spe_, lsa, ea);
    counters_.dma_bytes_written.add(kLineBytes);
    atomic_status_ = atomic_status::putlluc_done;
  } else {
    const bool written = bus_.put_line_conditional(spe_, lsa, ea);
    if (written) counters_.dma_bytes_written.add(kLineBytes);
    atomic_status_ = written ? 0 : atomic_status::putllc_failed;
  }
}

// --- progress ---

std::uint32_t Mfc::outstanding(bool proxy) const {
  std::uint32_t tags = 0;
  for (const Entry& entry : queue_)
    if (entry.proxy == proxy) tags |= 1u << entry.command.tag;
  return tags;
}

Cycle Mfc::next_event() const {
  Cycle next = kNever;
  for (const Entry& entry : queue_)
    next = std::min(next, entry.moved ? entry.due : std::min(entry.due, entry.move_at));
  return next;
}

Cycle Mfc::run_next() {
  const Cycle now = next_event();
  for (std::size_t i = 0; i < queue_.size(); ++i) {
    Entry& entry = queue_[i];
    if (!entry.moved && entry.move_at == now && entry.move_at < entry.due) {
      move_data(entry, now);
      return now;
    }
    if (entry.due == now) {
      complete(i, now);
      return now;
    }
  }
  return now;
}

bool Mfc::may_start(std::size_t index) const {
  for (std::size_t earlier = 0; earlier < index; ++earlier)
    if (queue_[earlier].proxy == queue_[index].proxy &&
        is_ordered(queue_[earlier].command, queue_[index].command))
      return false;
  return true;
}

void Mfc::start_ready(Cycle now) {
  for (std::size_t i = 0; i < queue_.size(); ++i)
    if (queue_[i].due == kNever && !queue_[i].stalled && may_start(i)) start(queue_[i], now);
}

void Mfc::start(Entry& entry, Cycle now) {
  const EmulationConfig& config = context_.config;
  // All commands that it is ordered behind are complete, so their data have to be moved, however late that
  // is.
  std::vector<Flight>::size_type count = context_.flights.of(spe_).size();
  for (std::size_t i = 0; i < count; ++i) {
    Flight& flight = context_.flights.at(spe_, i);
    if (flight.completed && !flight.moved && flight.command != entry.number &&
        is_ordered_before(flight, entry))
      move(flight, now);
  }
  const bool releases =
      kind_of(entry.command.opcode) == CommandKind::barrier || follows_its_tag(entry.command.opcode);
  if (releases)
    context_.flights.for_each(spe_, [&](Flight& flight) {
      if (flight.command == entry.number || !is_ordered_before(flight, entry)) return;
      flight.released = true;
      // A wait for the other tag may tell the program of it.
      if (flight.transfer.tag != entry.command.tag) permit(flight);
    });
  entry.due = time_of(entry, now) + random_.below(config.faults.dma_delay);
  entry.moved = false;
  entry.move_at = kNever;
  const bool random = config.transfers == TransferTime::random;
  if (random) entry.due += random_.below(entry.due - now + 1);
  // Half of the gets move their data when they are waited for.
  if (random && !(kind_of(entry.command.opcode) == CommandKind::get && random_.once_in(2)))
    entry.move_at = now + random_.below(entry.due - now + 1);
  for (std::size_t i = 0; i < count; ++i) {
    Flight& flight = context_.flights.at(spe_, i);
    if (flight.command != entry.number || flight.started) continue;
    flight.started = true;
    std::uint8_t* const local = local_store(flight.transfer);
    const OpenedLocalStore opened(*this, flight.transfer);
    if (!flight.writes_local_store()) {
      flight.hashed = !flight.shared;
      if (flight.hashed) flight.hash = checksum(local, flight.bytes());
      check_source(flight, entry, now);
      continue;
    }
    // All data that this get is ordered behind have moved: its target belongs to nobody.
    if (config.transfers != TransferTime::at_issue) {
      flight.hashed = !flight.shared;
      bus_.count_local_store_write(spe_);
      fill_as_in_flight(local, flight.bytes());
    }
    forbid(flight);
  }
  if (config.transfers == TransferTime::at_issue) move_data(entry, now);
}

Cycle Mfc::time_of_transfer(const MfcCommand& transfer, Cycle start) {
  const AddressMap::Place place = bus_.map().locate(transfer.ea, transfer.size);
  const DmaTarget target = place.kind == EaKind::main_memory   ? DmaTarget::memory
                           : place.kind == EaKind::local_store ? DmaTarget::local_store
                                                               : DmaTarget::problem_state;
  return timing_.complete(spe_, start, target, place.spe, transfer.ea, transfer.size);
}

Cycle Mfc::time_of(const Entry& entry, Cycle start) {
  const TimingParameters& timing = context_.config.timing;
  switch (kind_of(entry.command.opcode)) {
  case CommandKind::barrier:
  case CommandKind::cache_control:
  case CommandKind::unknown:
    return start + timing.list_element;
  case CommandKind::lock_line:
    return start + timing.lock_line_memory;
  case CommandKind::get:
  case CommandKind::put:
  case CommandKind::send_signal:
    break;
  }
  if (!is_list(entry.command.opcode))
    return entry.command.size == 0 ? start + 1 : time_of_transfer(entry.command, start);
  Cycle due = start + timing.list_element;
  for (const Flight& flight : context_.flights.of(spe_)) {
    if (flight.command != entry.number || flight.started) continue;
    start += timing.list_element;
    due = std::max(due, time_of_transfer(flight.transfer, start));
  }
  return due;
}

void Mfc::move_data(Entry& entry, Cycle now) {
  entry.moved = true;
  if (entry.command.opcode == MfcOpcode::sdcrz) {
    bus_.zero(spe_, entry.command.ea, entry.command.size);
    return;
  }
  for (std::size_t i = 0; i < context_.flights.of(spe_).size(); ++i) {
    Flight& flight = context_.flights.at(spe_, i);
    if (flight.command == entry.number && flight.started && !flight.moved) move(flight, now);
  }
}

void Mfc::complete(std::size_t index, Cycle now) {
  Entry& entry = queue_[index];
  const TransferTime when = context_.config.transfers;
  // A get whose data have not been waited for moves them at the wait.
  const bool deferred = kind_of(entry.command.opcode) == CommandKind::get && entry.move_at == kNever &&
                        when != TransferTime::at_issue;
  if (!entry.moved && !deferred) move_data(entry, now);
  const bool last_part = !is_list(entry.command.opcode) || complete_part(entry, now);
  context_.flights.for_each(spe_, [&](Flight& flight) {
    if (flight.command == entry.number) flight.completed |= flight.started;
  });
  if (context_.trace != nullptr) trace_command(entry, now);
  if (!last_part) return;
  const bool was_full = free_entries() == 0;
  if (!entry.proxy) --spu_entries_;
  queue_.erase(queue_.begin() + static_cast<std::ptrdiff_t>(index));
  if (was_full && free_entries() != 0) problem_state_.raise_own(event::command_queue);
  judge_tag_groups();
  start_ready(now);
}

void Mfc::trace_command(const Entry& entry, Cycle now) const {
  const MfcCommand& command = entry.command;
  const AddressMap::Place place = bus_.map().locate(command.ea, is_list(command.opcode) ? 0 : command.size);
  const bool memory = kind_of(command.opcode) == CommandKind::barrier || is_list(command.opcode);
  context_.trace->dma(spe_, entry.number, cell_emu::name_of(command.opcode), command.tag, command.lsa,
                      command.size, memory ? name_of(EaKind::main_memory) : name_of(place.kind), place.spe,
                      entry.issued, now, entry.site);
}

// --- lists ---

void Mfc::read_list(Entry& entry) const {
  entry.elements.resize(entry.command.size / sizeof(ListElement));
  if (entry.elements.empty()) return;
  std::memcpy(entry.elements.data(),
              bus_.map().local_store(spe_) + static_cast<std::uint32_t>(entry.command.ea),
              entry.command.size);
  for (ListElement& element : entry.elements)
    element = {context_.from_spu(element.notify_and_size), context_.from_spu(element.ea_low)};
}

void Mfc::begin_part(Entry& entry, Cycle now) {
  while (entry.next_element < entry.elements.size()) {
    const ListElement element = entry.elements[entry.next_element];
    const MfcCommand part = element_command(entry.command, element, entry.next_lsa);
    Rule rule = broken_element_rule(part, target_of(part, part.size, false));
    if (rule == Rule::none) rule = broken_arena_rule(part);
    if (rule == Rule::none) rule = broken_bounds_rule(part, false);
    if (rule != Rule::none)
      report({part, entry.number, entry.site, false, now}, rule, now,
             "element " + std::to_string(entry.next_element) + " of " + describe(entry.command) + ": ");
    if (can_be_carried_out(rule)) depart(entry, part, now);
    counters_.dma_list_elements.add(1);
    if (part.size != 0) entry.next_lsa = (part.lsa + part.size + 15) & ~15u;
    ++entry.next_element;
    if ((element.notify_and_size & ListElement::kNotify) != 0) break;
  }
}

void Mfc::check_list_unchanged(const Entry& entry, Cycle now) {
  Entry again = entry;
  read_list(again);
  const auto same = [](const ListElement& a, const ListElement& b) {
    return a.notify_and_size == b.notify_and_size && a.ea_low == b.ea_low;
  };
  if (!std::equal(again.elements.begin(), again.elements.begin() + entry.next_element, entry.elements.begin(),
                  same))
    report(entry, Rule::list_changed, now);
}

bool Mfc::complete_part(Entry& entry, Cycle now) {
  check_list_unchanged(entry, now);
  // A notify bit in the last element has no effect: there is nothing left to stop.
  if (entry.next_element == entry.elements.size()) return true;
  entry.stalled = true;
  entry.due = kNever;
  entry.moved = true;
  // The event is the rise of the channel's count; a stop that joins an unread status only adds its bit.
  const bool rises = stalled_tags_ == 0;
  stalled_tags_ |= 1u << entry.command.tag;
  if (rises) problem_state_.raise_own(event::list_stall);
  return false;
}

std::uint32_t Mfc::take_list_stall_status(Cycle now) {
  const std::uint32_t tags = stalled_tags_;
  stalled_tags_ = 0;
  // The program now knows that the parts before the stops have been transferred.
  for (const Entry& entry : queue_)
    if (entry.stalled && (tags >> entry.command.tag & 1) != 0) observe_part(entry.number, now);
  return tags;
}

void Mfc::acknowledge_list_stall(std::uint32_t tag, CallSite site, Cycle now) {
  if (tag >= kMfcTags) {
    report_channel(Channel::wr_list_stall_ack, tag, Rule::list_stall_tag, site, now);
    return;
  }
  for (Entry& entry : queue_) {
    if (!entry.stalled || entry.command.tag != tag) continue;
    entry.stalled = false;
    // Read the rest of the list again: the program may have written it during the stop, which is the purpose
    // of stops.
    const std::uint32_t done = entry.next_element;
    read_list(entry);
    entry.next_element = done;
    begin_part(entry, now);
  }
  start_ready(now);
}

// --- tag groups and atomics ---

void Mfc::judge_tag_groups() {
  if (tag_groups_.waiting() && tag_groups_.judge(outstanding(false), commands_))
    problem_state_.raise_own(event::tag_status);
}

void Mfc::write_tag_mask(std::uint32_t mask) {
  tag_groups_.write_mask(mask);
  judge_tag_groups();
}

void Mfc::write_tag_update(std::uint32_t request, CallSite site, Cycle now) {
  last_request_ = site;
  if (request > static_cast<std::uint32_t>(TagUpdate::all)) {
    report_channel(Channel::wr_tag_update, request, Rule::tag_update_request, site, now);
    return;
  }
  if (request != 0) {
    waited_tags_ |= tag_groups_.mask();
    for (std::uint32_t tags = tag_groups_.mask(); tags != 0; tags &= tags - 1)
      waits_[static_cast<unsigned>(std::countr_zero(tags))] = site;
  }
  tag_groups_.request(static_cast<TagUpdate>(request));
  judge_tag_groups();
}

std::uint32_t Mfc::take_tag_status(Cycle now) {
  const std::uint64_t last = tag_groups_.answered_up_to();
  const std::uint32_t status = tag_groups_.take();
  observe(status, last, false, now);
  return status;
}

std::string Mfc::why_no_tag_status() const {
  if (!tag_groups_.waiting()) return "no tag status update has been requested";
  return tag_groups_.mask() == 0 ? "no tag group is enabled"
                                 : "a list of the tag group is stopped at a notify element";
}

std::uint32_t Mfc::take_atomic_status() {
  const std::uint32_t status = *atomic_status_;
  atomic_status_.reset();
  return status;
}

} // namespace celltrace::cell_emu
