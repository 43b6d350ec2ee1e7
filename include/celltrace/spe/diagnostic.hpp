// Diagnostics of an emulated machine: which rule a program broke, on which SPE and where.
#pragma once

#include "celltrace/export.hpp"
#include "celltrace/spe/call_site.hpp"
#include "celltrace/spe/types.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace {

/// The rules that `cell_emu` and `cell_sim` check; text_of() describes each.
enum class Rule : unsigned char {
  none, ///< no rule is broken

  // Rules on an MFC command, checked when it is issued or its list is processed.
  known_command,
  tag_range,
  transfer_size,
  zero_size,
  in_local_store,
  local_store_end,
  same_low_bits,
  natural_alignment,
  quadword_alignment,
  mapped_address,
  register_exists,
  register_size,
  register_word,
  register_readable,
  signal_size,
  signal_target,
  line_alignment,
  line_in_memory,
  list_in_local_store,
  list_alignment,
  list_length,
  list_end,
  element_region,
  allocation_bounds,
  object_bounds,
  parameters_kept,
  proxy_command,
  proxy_tag_range,

  // Rules on commands in flight, which are commands from their issue until the SPU has observed their
  // completion.
  local_store_race,
  main_storage_race,
  get_target_touched,
  get_target_read,
  put_source_changed,
  list_changed,
  in_flight_at_exit,
  drained_queue,

  // Tag groups and statuses.
  tag_reused,
  wait_without_command,
  tag_update_request,
  tag_status_unread,
  atomic_status_unread,
  list_stall_tag,

  // Reservations.
  reservation_lost_to_own_put,
  conditional_without_reservation,

  // Mailboxes and signals.
  mailbox_overwritten,
  mailbox_unread,
  signal_overwritten,
  signal_unread,

  // Local store.
  local_store_exhausted,
  local_store_overrun,
  allocation_overrun,
  foreign_store,
  program_overwritten,
  stack_overflow,

  // Run control.
  invalid_instruction,
  unwritten_code,
  absent_module,
  invalid_channel,
  stalls_for_ever,
  phantom_event,
  deadlock,
  time_limit,
  halted,
  kernel_exception,
};
constexpr unsigned kRules = static_cast<unsigned>(Rule::kernel_exception) + 1;

/// Returns the rule's name: "transfer-size".
CELLTRACE_EXPORT std::string_view name_of(Rule rule);
/// Returns the condition that must hold: "size must be 1, 2, 4, 8 or a multiple of 16 up to 16384".
CELLTRACE_EXPORT std::string_view text_of(Rule rule);

/// The reaction to a broken rule: nothing, a diagnostic, or a diagnostic and the end of the SPE's program.
enum class Action : unsigned char { ignore, warn, stop };
/// Returns the reaction that holds unless the machine's configuration names another.
CELLTRACE_EXPORT Action default_action(Rule rule);
/// Returns a map, for EmulationConfig::actions, that ignores the rules that the hardware does not enforce:
/// for programs that rely on the hardware's behaviour beyond the manuals.
CELLTRACE_EXPORT std::map<Rule, Action> lenient_actions();

/// One broken rule. `opcode`, `tag`, `lsa`, `size` and `ea` are those of the MFC command, if a command is
/// involved.
struct Diagnostic {
  static constexpr unsigned kPpe = 0xFFFFFFFFu;

  Rule rule = Rule::none;
  Action action = Action::stop;
  unsigned spe = 0; ///< SPE whose program broke the rule; kPpe: the PPE
  /// Number of the SPE's MFC command, from 1 in the order of issue; 0: no command is involved.
  std::uint64_t command = 0;
  std::uint32_t opcode = 0; ///< see MfcOpcode
  std::uint32_t tag = 0;
  std::uint32_t lsa = 0;
  std::uint32_t size = 0; ///< bytes
  ea_t ea = 0;
  CallSite site; ///< place of the operation; line 0: unknown
  // The other operation of a race. If the PPE broke the rule, other_spe is the SPE that the PPE accessed.
  unsigned other_spe = 0;
  std::uint64_t other_command = 0; ///< 0: none
  CallSite other_site;
  std::uint64_t cycle = 0; ///< the SPE's virtual time
  /// One line with all members above: "SPE 0: get 20 bytes, LS 0x18080 <- EA 0x..., tag 5: size must be ...
  /// [transfer-size, command 1, at kernel.hpp:12]".
  std::string text;
};

} // namespace celltrace
