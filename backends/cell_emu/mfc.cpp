#include "backends/cell_emu/mfc.hpp"

#include "backends/cell_emu/local_store_watch.hpp"
#include "backends/cell_emu/mfc_rules.hpp"
#include "backends/cell_emu/opened_local_store.hpp"
#include "celltrace/spe/channels.hpp"
#include "celltrace/spe/spu.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace celltrace::cell_emu {
namespace {

constexpr std::uint64_t kMfcStream = 0x4D4643;

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

void Mfc::issue(const MfcCommand& given, CallSite site, Cycle now) {
  check_stores(site, now);
  ++commands_;
  if (!check(given, commands_, site, now, false)) return;
  MfcCommand command = given;
  if (kind_of(command.opcode) == CommandKind::lock_line) {
    // If the rule's action permits an unaligned command, its addresses are truncated as on the hardware.
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
    // The SPE may have lost its reservation to another SPE, which is no mistake.
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
  // All commands that this command is ordered behind are complete, so their data have to be moved now, even
  // with TransferTime::at_wait.
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
      // By a wait for the tag of `entry` the program may learn that this flight is complete.
      if (flight.transfer.tag != entry.command.tag) permit(flight);
    });
  entry.due = time_of(entry, now) + random_.below(config.faults.dma_delay);
  entry.moved = false;
  entry.move_at = kNever;
  const bool random = config.transfers == TransferTime::random;
  if (random) entry.due += random_.below(entry.due - now + 1);
  // One half of the gets, chosen at random, move their data when the program waits for them.
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
    // All transfers that this get is ordered behind have moved their data, so that nothing else uses the
    // get's target.
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
  // A get that the program has not waited for moves its data when the program waits.
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
