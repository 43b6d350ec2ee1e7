#include "backends/native/mfc.hpp"

#include <cstring>

namespace celltrace::native {

namespace {

constexpr std::uint32_t kPutBit = 0x20;
constexpr std::uint32_t kBarrierBit = 0x1;
constexpr std::uint32_t kFenceBit = 0x2;
constexpr std::uint32_t kElementSizeMask = 0x7FFF;

bool is_queue_barrier(MfcOpcode opcode) {
  return opcode == MfcOpcode::barrier || opcode == MfcOpcode::mfceieio || opcode == MfcOpcode::mfcsync;
}

/// Returns true for put, get and sndsig, whose opcodes have fence and barrier in the low two bits.
bool has_ordering_bits(MfcOpcode opcode) {
  return static_cast<std::uint32_t>(opcode) < static_cast<std::uint32_t>(MfcOpcode::putlluc);
}
bool is_barrier(MfcOpcode opcode) {
  return has_ordering_bits(opcode) && (static_cast<std::uint32_t>(opcode) & kBarrierBit) != 0;
}
bool is_fence(MfcOpcode opcode) {
  return has_ordering_bits(opcode) && (static_cast<std::uint32_t>(opcode) & kFenceBit) != 0;
}

bool is_put(MfcOpcode opcode) {
  return (static_cast<std::uint32_t>(opcode) & kPutBit) != 0;
}

template <class T> T* quadword_of(T* ls) {
  return reinterpret_cast<T*>(reinterpret_cast<std::uintptr_t>(ls) & ~static_cast<std::uintptr_t>(15));
}

} // namespace

Mfc::Mfc(unsigned spe, Channels& channels, const RegisterMap& registers, Reservations& reservations,
         Counters& counters)
    : spe_(spe), channels_(channels), registers_(registers), reservations_(reservations),
      counters_(counters) {
}

void Mfc::reset() {
  waiting_.clear();
  stalled_tags_ = 0;
  tag_mask_ = 0;
  tag_requested_ = false;
  tag_status_ready_ = false;
  atomic_status_ready_ = false;
  reservations_.release(spe_);
}

// --- commands ---

void Mfc::command(MfcOpcode opcode, void* ls, ea_t ea, std::uint32_t size, std::uint32_t tag) {
  issue({opcode, static_cast<std::uint8_t*>(ls), ea, size, tag, nullptr, nullptr, false});
}

void Mfc::list_command(MfcOpcode opcode, void* ls, ea_t ea, const ListElement* list, std::uint32_t bytes,
                       std::uint32_t tag) {
  issue(
      {opcode, static_cast<std::uint8_t*>(ls), ea, 0, tag, list, list + bytes / sizeof(ListElement), false});
}

std::uint32_t Mfc::queue_space() const noexcept {
  return kMfcQueueEntries - static_cast<std::uint32_t>(waiting_.size());
}

void Mfc::issue(const Command& command) {
  counters_.dma_commands.add(1);
  if (run_atomic(command)) return;
  if (queue_space() == 0) channels_.stall_for_ever();
  if (waiting_.empty()) {
    Command at_once = command;
    if (!run(at_once)) waiting_.push_back(at_once);
    return;
  }
  waiting_.push_back(command);
  advance();
}

/// Returns true if the waiting command at `position` cannot run yet: it is a stalled list, or ordered behind
/// an earlier waiting command.
bool Mfc::must_wait(std::size_t position) const {
  const Command& command = waiting_[position];
  if (command.stalled) return true;
  for (std::size_t i = 0; i < position; ++i) {
    const Command& earlier = waiting_[i];
    if (is_queue_barrier(command.opcode) || is_queue_barrier(earlier.opcode)) return true;
    const bool ordered = is_fence(command.opcode) || is_barrier(command.opcode) || is_barrier(earlier.opcode);
    if (ordered && earlier.tag == command.tag) return true;
  }
  return false;
}

/// Runs all waiting commands that can run.
void Mfc::advance() {
  const bool was_full = queue_space() == 0;
  for (std::size_t i = 0; i < waiting_.size();) {
    if (must_wait(i) || !run(waiting_[i]))
      ++i;
    else
      waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  if (was_full && queue_space() > 0) channels_.raise_own(event::command_queue);
  if (tag_requested_) update_tag_status();
}

/// Runs a command. Returns false if it is a list that stopped.
bool Mfc::run(Command& command) {
  if (command.list != nullptr) return walk(command);
  if (is_queue_barrier(command.opcode)) return true;
  if (command.opcode == MfcOpcode::putqlluc) {
    reservations_.put_unconditional(spe_, command.ls, command.ea);
    counters_.dma_bytes_written.add(kLineBytes);
    return true;
  }
  transfer(is_put(command.opcode), command.ls, command.ea, command.size);
  return true;
}

bool Mfc::walk(Command& command) {
  const ea_t high = command.ea & ~static_cast<ea_t>(0xFFFFFFFF);
  while (command.list != command.list_end) {
    const ListElement element = *command.list++;
    const std::uint32_t size = element.notify_and_size & kElementSizeMask;
    std::uint8_t* ls = quadword_of(command.ls) + (element.ea_low & 15);
    transfer(is_put(command.opcode), ls, high | element.ea_low, size);
    command.ls = quadword_of(ls + size + 15);
    counters_.dma_list_elements.add(1);

    const bool notify = (element.notify_and_size & ListElement::kNotify) != 0;
    if (notify && command.list != command.list_end) {
      command.stalled = true;
      stalled_tags_ |= 1u << command.tag;
      channels_.raise_own(event::list_stall);
      return false;
    }
  }
  return true;
}

void Mfc::transfer(bool to_main_storage, std::uint8_t* ls, ea_t ea, std::uint32_t size) {
  if (size == 0) return;
  if (!to_main_storage) {
    std::memmove(ls, reinterpret_cast<const void*>(static_cast<std::uintptr_t>(ea)), size);
    counters_.dma_bytes_read.add(size);
    return;
  }
  counters_.dma_bytes_written.add(size);
  if (registers_.contains(ea))
    write_register(ls, ea, size);
  else
    reservations_.put(spe_, ls, ea, size);
}

void Mfc::write_register(const std::uint8_t* ls, ea_t ea, std::uint32_t size) {
  const bool mailbox = registers_.write(ea, ls, size) == RegisterMap::Register::in_mailbox;
  (mailbox ? counters_.mailbox_words_sent : counters_.signals_sent).add(1);
}

// --- lock lines ---

/// Runs a lock-line command that bypasses the queue. Returns false for all other commands.
bool Mfc::run_atomic(const Command& command) {
  switch (command.opcode) {
  case MfcOpcode::getllar:
    reservations_.get_and_reserve(spe_, command.ls, command.ea);
    counters_.dma_bytes_read.add(kLineBytes);
    finish_atomic(atomic_status::getllar_done);
    return true;
  case MfcOpcode::putllc: {
    const bool done = reservations_.put_conditional(spe_, command.ls, command.ea);
    counters_.dma_bytes_written.add(done ? kLineBytes : 0);
    finish_atomic(done ? 0 : atomic_status::putllc_failed);
    return true;
  }
  case MfcOpcode::putlluc:
    reservations_.put_unconditional(spe_, command.ls, command.ea);
    counters_.dma_bytes_written.add(kLineBytes);
    finish_atomic(atomic_status::putlluc_done);
    return true;
  default:
    return false;
  }
}

void Mfc::finish_atomic(std::uint32_t status) {
  atomic_status_ = status;
  atomic_status_ready_ = true;
}

std::uint32_t Mfc::read_atomic_status() {
  if (!atomic_status_ready_) channels_.stall_for_ever();
  atomic_status_ready_ = false;
  return atomic_status_;
}

// --- tag groups ---

void Mfc::update_tag_status() {
  std::uint32_t incomplete = 0;
  for (const Command& command : waiting_)
    incomplete |= 1u << command.tag;
  const std::uint32_t completed = tag_mask_ & ~incomplete;
  if (tag_request_ == TagUpdate::any && completed == 0) return;
  if (tag_request_ == TagUpdate::all && completed != tag_mask_) return;
  tag_requested_ = false;
  tag_status_ready_ = true;
  tag_status_ = completed;
  if (tag_request_ != TagUpdate::immediate) channels_.raise_own(event::tag_status);
}

void Mfc::write_tag_mask(std::uint32_t mask) {
  tag_mask_ = mask;
  if (tag_requested_) update_tag_status();
}

void Mfc::write_tag_update(TagUpdate request) {
  tag_request_ = request;
  tag_requested_ = true;
  update_tag_status();
}

std::uint32_t Mfc::read_tag_status() {
  if (!tag_status_ready_) channels_.stall_for_ever();
  tag_status_ready_ = false;
  return tag_status_;
}

std::uint32_t Mfc::read_list_stall_status() {
  if (stalled_tags_ == 0) channels_.stall_for_ever();
  const std::uint32_t tags = stalled_tags_;
  stalled_tags_ = 0;
  return tags;
}

void Mfc::acknowledge_list_stall(std::uint32_t tag) {
  for (Command& command : waiting_)
    if (command.tag == tag) command.stalled = false;
  advance();
}

} // namespace celltrace::native
