// The texts and default actions of the rules.
#include "celltrace/spe/diagnostic.hpp"

#include <array>

namespace celltrace {
namespace {

struct Entry {
  Rule rule;
  std::string_view name;
  Action action;
  std::string_view text;
};

constexpr Action kIgnore = Action::ignore, kWarn = Action::warn, kStop = Action::stop;

constexpr std::array<Entry, kRules> kTable = {{
    {Rule::none, "none", kIgnore, "legal"},

    {Rule::known_command, "known-command", kStop, "the MFC has no such command"},
    {Rule::tag_range, "tag-range", kStop, "tag must be 0..31"},
    {Rule::transfer_size, "transfer-size", kStop, "size must be 1, 2, 4, 8 or a multiple of 16 up to 16384"},
    {Rule::zero_size, "zero-size", kWarn, "a transfer of 0 bytes does nothing"},
    {Rule::in_local_store, "in-local-store", kStop, "LS address must lie in this SPE's local store"},
    {Rule::local_store_end, "local-store-end", kStop, "transfer must not cross the end of local store"},
    {Rule::same_low_bits, "same-low-bits", kStop, "LS and EA must agree in their low 4 bits"},
    {Rule::natural_alignment, "natural-alignment", kStop,
     "a transfer of less than 16 bytes must be aligned to its size"},
    {Rule::quadword_alignment, "quadword-alignment", kStop,
     "a transfer of 16 bytes or more must be 16-byte aligned"},
    {Rule::mapped_address, "mapped-address", kStop,
     "EA must be mapped, readable for a get and writable for a put, and the transfer stay in the storage it "
     "starts in"},
    {Rule::register_exists, "register-exists", kStop,
     "EA must be a problem-state register: signal 1, signal 2 or inbound mailbox"},
    {Rule::register_size, "register-size", kStop, "a problem-state register takes exactly 4 bytes"},
    {Rule::register_word, "register-word", kStop,
     "the word for a problem-state register must lie in the last word of a quadword (LS & 15 = 0xC)"},
    {Rule::register_readable, "register-readable", kStop, "the inbound mailbox cannot be read by DMA"},
    {Rule::signal_size, "signal-size", kStop, "sndsig takes exactly 4 bytes"},
    {Rule::signal_target, "signal-target", kStop, "sndsig must go to a signal notification register"},
    {Rule::line_alignment, "line-alignment", kStop,
     "LS and EA of a lock-line command must be 128-byte aligned"},
    {Rule::line_in_memory, "line-in-memory", kStop,
     "a lock line must lie in main memory or in a local store"},
    {Rule::list_in_local_store, "list-in-local-store", kStop, "the list must lie in this SPE's local store"},
    {Rule::list_alignment, "list-alignment", kStop, "the list must be 8-byte aligned"},
    {Rule::list_length, "list-length", kStop, "the list must be a multiple of 8 bytes, up to 2048 elements"},
    {Rule::list_end, "list-end", kStop, "the list must not cross the end of local store"},
    {Rule::element_region, "element-region", kStop, "a list element must not cross a 4 GB boundary"},
    {Rule::allocation_bounds, "allocation-bounds", kStop,
     "a transfer or list that touches an allocation of local store must lie within it"},
    {Rule::object_bounds, "object-bounds", kStop,
     "a transfer that touches a registered object in main memory must lie within it"},
    {Rule::parameters_kept, "parameters-kept", kWarn,
     "the MFC's parameter channels are documented as undefined after a command: write them again"},
    {Rule::proxy_command, "proxy-command", kStop,
     "a proxy command is a get or a put, with or without fence or barrier; no list, signal or lock line"},
    {Rule::proxy_tag_range, "proxy-tag-range", kStop,
     "the tag of a proxy command must be 0..15 (16..31 are the system's)"},

    {Rule::local_store_race, "local-store-race", kStop,
     "transfers in flight overlap in local store, one of them writes there, and nothing orders them"},
    {Rule::main_storage_race, "main-storage-race", kStop,
     "transfers in flight overlap in main storage, one of them writes there, and nothing orders them"},
    {Rule::get_target_touched, "get-target-touched", kStop,
     "local store was written while a get that targets it was in flight"},
    {Rule::get_target_read, "get-target-read", kStop,
     "the program uses local store that it loaded while a get that targets it was in flight"},
    {Rule::put_source_changed, "put-source-changed", kStop,
     "local store was written while a put that reads it was in flight"},
    {Rule::list_changed, "list-changed", kStop, "a list was written while the MFC was walking it"},
    {Rule::in_flight_at_exit, "in-flight-at-exit", kStop,
     "the program ended without a wait for the tag group of this command"},
    {Rule::drained_queue, "drained-queue", kWarn,
     "that the command is complete was seen by the room in the queue (MFC_Cmd's count), not by a tag status"},

    {Rule::tag_reused, "tag-reused", kWarn,
     "a command joins a tag group whose status has been requested and not yet read"},
    {Rule::wait_without_command, "wait-without-command", kWarn,
     "a wait for tag groups that have no command, while commands of other groups are in flight"},
    {Rule::tag_update_request, "tag-update-request", kStop,
     "a tag status request is 0 (immediate), 1 (any) or 2 (all)"},
    {Rule::tag_status_unread, "tag-status-unread", kWarn, "a tag status was requested and never read"},
    {Rule::atomic_status_unread, "atomic-status-unread", kWarn,
     "the status of a lock-line command was never read: a putllc may have failed"},
    {Rule::list_stall_tag, "list-stall-tag", kStop, "the tag to acknowledge must be 0..31"},

    {Rule::reservation_lost_to_own_put, "reservation-lost-to-own-put", kWarn,
     "the SPE's own put has taken the reservation, so that the putllc cannot succeed"},
    {Rule::conditional_without_reservation, "conditional-without-reservation", kWarn,
     "a putllc without a getllar of the same line before it cannot succeed"},

    {Rule::mailbox_overwritten, "mailbox-overwritten", kWarn,
     "a word was written to a full inbound mailbox, whose newest word is lost"},
    {Rule::mailbox_unread, "mailbox-unread", kWarn, "the program ended with words in its inbound mailbox"},
    {Rule::signal_overwritten, "signal-overwritten", kWarn,
     "a signal in overwrite mode was written before the last one was read, which is lost"},
    {Rule::signal_unread, "signal-unread", kWarn, "the program ended with a signal that it never read"},

    {Rule::local_store_exhausted, "local-store-exhausted", kStop,
     "code, data, stack and arena must fit into 256 KB"},
    {Rule::local_store_overrun, "local-store-overrun", kStop,
     "a store went beyond the end, or in front of the beginning, of local store"},
    {Rule::allocation_overrun, "allocation-overrun", kStop, "a store went past an allocation"},
    {Rule::foreign_store, "foreign-store", kStop,
     "a store changed the local store of another SPE, which only DMA reaches"},
    {Rule::program_overwritten, "program-overwritten", kStop,
     "a store or transfer hit local store that belongs to the program's code or stack"},
    {Rule::stack_overflow, "stack-overflow", kStop,
     "the stack has grown into the program's data or its heap"},

    {Rule::invalid_instruction, "invalid-instruction", kStop, "the SPU has no such instruction"},
    {Rule::unwritten_code, "unwritten-code", kStop,
     "the SPU executed local store that was never written, or that a get in flight targets"},
    {Rule::absent_module, "absent-module", kStop,
     "code of a module runs while another one is in its region of local store"},
    {Rule::invalid_channel, "invalid-channel", kStop, "there is no such channel in this direction"},
    {Rule::stalls_for_ever, "stalls-for-ever", kStop, "the channel would stall for ever"},
    {Rule::phantom_event, "phantom-event", kStop,
     "after a phantom event (status 0) the program waits for what the event did not announce"},
    {Rule::deadlock, "deadlock", kStop, "every SPE waits, and so does the PPE"},
    {Rule::time_limit, "time-limit", kStop, "the program runs longer than the configuration allows"},
    {Rule::halted, "halted", kStop, "the program halted itself"},
    {Rule::kernel_exception, "kernel-exception", kStop, "the kernel threw an exception"},
}};

constexpr bool in_order() {
  for (unsigned i = 0; i < kRules; ++i)
    if (static_cast<unsigned>(kTable[i].rule) != i) return false;
  return true;
}
static_assert(in_order(), "one entry per rule, in the order of the enumeration");

const Entry& entry_of(Rule rule) {
  return kTable[static_cast<unsigned>(rule) < kRules ? static_cast<unsigned>(rule) : 0];
}

} // namespace

std::string_view name_of(Rule rule) {
  return entry_of(rule).name;
}

std::string_view text_of(Rule rule) {
  return entry_of(rule).text;
}

Action default_action(Rule rule) {
  return entry_of(rule).action;
}

std::map<Rule, Action> lenient_actions() {
  std::map<Rule, Action> actions;
  for (const Rule rule : {Rule::zero_size, Rule::line_alignment, Rule::parameters_kept, Rule::drained_queue,
                          Rule::tag_reused, Rule::wait_without_command, Rule::tag_status_unread,
                          Rule::atomic_status_unread, Rule::reservation_lost_to_own_put,
                          Rule::conditional_without_reservation, Rule::mailbox_unread, Rule::signal_unread})
    actions[rule] = Action::ignore;
  return actions;
}

} // namespace celltrace
