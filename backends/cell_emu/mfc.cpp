#include "backends/cell_emu/mfc.hpp"

#include "backends/cell_emu/mfc_rules.hpp"
#include "celltrace/error.hpp"

#include <algorithm>
#include <cstring>

namespace celltrace::cell_emu {
namespace {

/// Must `earlier` be complete before `later` may move?
bool is_ordered(const MfcCommand& earlier, const MfcCommand& later) {
  if (kind_of(earlier.opcode) == CommandKind::barrier || kind_of(later.opcode) == CommandKind::barrier)
    return true;
  if (earlier.tag != later.tag) return false;
  return has_barrier(earlier.opcode) || has_barrier(later.opcode) || has_fence(later.opcode);
}

} // namespace

Mfc::Mfc(unsigned spe, Bus& bus, ProblemState& problem_state, Counters& counters)
    : spe_(spe), bus_(bus), problem_state_(problem_state), counters_(counters) {
}

Mfc::~Mfc() {
  bus_.drop_reservation(spe_);
}

void Mfc::fail(const std::string& what) const {
  throw SpeError("SPE " + std::to_string(spe_) + ": " + what);
}

// --- issue ---

void Mfc::check(const MfcCommand& command) const {
  MfcRule rule = broken_common_rule(command);
  if (rule == MfcRule::none) {
    const CommandKind kind = kind_of(command.opcode);
    if (is_list(command.opcode))
      rule = broken_list_rule(command);
    else if (kind == CommandKind::lock_line)
      rule = broken_lock_line_rule(command, bus_.map().locate(command.ea, kLineBytes).kind);
    else if (kind != CommandKind::barrier)
      rule = broken_transfer_rule(command, bus_.map().locate(command.ea, command.size).kind);
  }
  if (rule != MfcRule::none) fail(describe(command) + ": " + text_of(rule));
}

void Mfc::issue(const MfcCommand& command) {
  check(command);
  counters_.dma_commands.add(1);
  if (is_immediate(command.opcode))
    execute_immediate(command);
  else
    enqueue(command);
}

void Mfc::execute_immediate(const MfcCommand& command) {
  const auto [opcode, tag, lsa, size, ea] = command;
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

void Mfc::enqueue(const MfcCommand& command) {
  while (free_entries() == 0)
    if (!advance()) fail(describe(command) + ": the queue is full, and all of it waits for stopped lists");
  queue_[queued_++] = {command, timing_.mark(), 0, command.lsa & ~15u, false};
}

// --- order ---

unsigned Mfc::first_before(unsigned index) const {
  for (unsigned earlier = 0; earlier < index; ++earlier)
    if (is_ordered(queue_[earlier].command, queue_[index].command)) return earlier;
  return index;
}

bool Mfc::advance_towards(unsigned index) {
  for (unsigned before = first_before(index); before != index; before = first_before(index))
    index = before;
  Entry& entry = queue_[index];
  if (entry.stalled) return false;
  if (execute(entry)) remove(index);
  return true;
}

bool Mfc::advance_any_of(std::uint32_t tags) {
  for (unsigned i = 0; i < queued_; ++i)
    if ((tags >> queue_[i].command.tag & 1) != 0 && advance_towards(i)) return true;
  return false;
}

bool Mfc::advance() {
  return queued_ != 0 && advance_any_of(~0u);
}

void Mfc::drain() {
  while (advance()) {
  }
}

void Mfc::finish() {
  drain();
  if (queued_ != 0) fail("ended while a list is stopped at a notify element: " + describe(queue_[0].command));
}

void Mfc::remove(unsigned index) {
  if (free_entries() == 0) problem_state_.raise_own(event::command_queue);
  std::copy(queue_.begin() + index + 1, queue_.begin() + queued_, queue_.begin() + index);
  --queued_;
  judge_tag_groups();
}

// --- execution ---

bool Mfc::execute(Entry& entry) {
  const MfcCommand& command = entry.command;
  if (is_list(command.opcode)) return execute_list(entry);
  if (kind_of(command.opcode) == CommandKind::barrier) return true;
  if (kind_of(command.opcode) == CommandKind::lock_line) {
    bus_.put_line(spe_, command.lsa, command.ea);
    counters_.dma_bytes_written.add(kLineBytes);
    return true;
  }
  transfer(command);
  return true;
}

ListElement Mfc::read_element(const Entry& entry) const {
  const std::uint8_t* const list =
      bus_.map().local_store(spe_) + static_cast<std::uint32_t>(entry.command.ea);
  ListElement element;
  std::memcpy(&element, list + entry.next_element * sizeof element, sizeof element);
  return element;
}

bool Mfc::execute_list(Entry& entry) {
  const MfcCommand& list = entry.command;
  const std::uint32_t elements = list.size / sizeof(ListElement);
  while (entry.next_element < elements) {
    const ListElement element = read_element(entry);
    const MfcCommand part = element_command(list, element, entry.next_lsa);
    const MfcRule rule = broken_element_rule(part, bus_.map().locate(part.ea, part.size).kind);
    if (rule != MfcRule::none)
      fail("element " + std::to_string(entry.next_element) + " of " + describe(list) + ": " + describe(part) +
           ": " + text_of(rule));
    transfer(part);
    counters_.dma_list_elements.add(1);
    if (part.size != 0) entry.next_lsa = (part.lsa + part.size + 15) & ~15u;
    ++entry.next_element;
    if ((element.notify_and_size & ListElement::kNotify) != 0 && entry.next_element < elements) {
      entry.stalled = true;
      stalled_tags_ |= 1u << list.tag;
      problem_state_.raise_own(event::list_stall);
      return false;
    }
  }
  return true;
}

void Mfc::transfer(const MfcCommand& command) {
  if (command.size == 0) return;
  const AddressMap::Place place = bus_.map().locate(command.ea, command.size);
  if (is_register(place.kind))
    transfer_word(command, place);
  else
    transfer_block(command);
}

void Mfc::transfer_word(const MfcCommand& command, AddressMap::Place place) {
  std::uint8_t* const word = bus_.map().local_store(spe_) + command.lsa;
  std::uint32_t value;
  if (kind_of(command.opcode) == CommandKind::get) {
    value = bus_.read_register(place);
    std::memcpy(word, &value, sizeof value);
    counters_.dma_bytes_read.add(sizeof value);
    return;
  }
  std::memcpy(&value, word, sizeof value);
  bus_.write_register(place, value);
  counters_.dma_bytes_written.add(sizeof value);
  (place.kind == EaKind::in_mailbox ? counters_.mailbox_words_sent : counters_.signals_sent).add(1);
}

void Mfc::transfer_block(const MfcCommand& command) {
  if (kind_of(command.opcode) == CommandKind::get) {
    bus_.get(spe_, command.lsa, command.ea, command.size);
    counters_.dma_bytes_read.add(command.size);
  } else {
    bus_.put(spe_, command.lsa, command.ea, command.size);
    counters_.dma_bytes_written.add(command.size);
  }
}

// --- tag groups ---

std::uint32_t Mfc::outstanding_tags() const {
  std::uint32_t tags = 0;
  for (unsigned i = 0; i < queued_; ++i)
    tags |= 1u << queue_[i].command.tag;
  return tags;
}

void Mfc::judge_tag_groups() {
  if (tag_groups_.waiting() && tag_groups_.judge(outstanding_tags()))
    problem_state_.raise_own(event::tag_status);
}

void Mfc::write_tag_mask(std::uint32_t mask) {
  tag_groups_.write_mask(mask);
  judge_tag_groups();
}

void Mfc::write_tag_update(std::uint32_t request) {
  if (request > static_cast<std::uint32_t>(TagUpdate::all))
    fail("MFC_WrTagUpdate " + std::to_string(request) + ": a request is 0 (immediate), 1 (any) or 2 (all)");
  tag_groups_.request(static_cast<TagUpdate>(request));
  judge_tag_groups();
  // A program that polls must see the end some time.
  if (static_cast<TagUpdate>(request) == TagUpdate::immediate) advance();
}

std::uint32_t Mfc::read_tag_status() {
  while (!tag_groups_.available()) {
    if (!tag_groups_.waiting())
      fail("MFC_RdTagStat would stall for ever: no tag status update has been requested");
    if (!advance_any_of(tag_groups_.mask()))
      fail("MFC_RdTagStat would stall for ever: " +
           std::string(tag_groups_.mask() == 0 ? "no tag group is enabled"
                                               : "a list of the tag group is stopped at a notify element"));
  }
  timing_.count_wait();
  if (queued_ != 0 && timing_.overdue(queue_[0].mark)) advance();
  return tag_groups_.take();
}

// --- lists and atomics ---

std::uint32_t Mfc::read_list_stall_status() {
  while (stalled_tags_ == 0)
    if (!advance())
      fail("MFC_RdListStallStat would stall for ever: no list in the queue has a notify element");
  const std::uint32_t tags = stalled_tags_;
  stalled_tags_ = 0;
  return tags;
}

void Mfc::acknowledge_list_stall(std::uint32_t tag) {
  if (tag >= kMfcTags) fail("MFC_WrListStallAck " + std::to_string(tag) + ": " + text_of(MfcRule::tag_range));
  for (unsigned i = 0; i < queued_; ++i)
    if (queue_[i].command.tag == tag) queue_[i].stalled = false;
}

std::uint32_t Mfc::read_atomic_status() {
  if (!atomic_status_) fail("MFC_RdAtomicStat would stall for ever: no lock-line command has been issued");
  // A program may spin on a line that another SPE writes only in answer to what is still queued here.
  advance();
  const std::uint32_t status = *atomic_status_;
  atomic_status_.reset();
  return status;
}

} // namespace celltrace::cell_emu
