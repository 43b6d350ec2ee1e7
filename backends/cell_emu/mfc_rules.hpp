// The architecture's rules for MFC commands, as pure functions. The functions broken_..._rule() return the
// rule that a command breaks, or Rule::none.
//
// Sources: Cell Broadband Engine Programming Handbook, chapter "DMA transfers and inter-processor
// communication"; spu_mfcio.h of GCC 9.3; Linux spufs_check_valid_dma(). Where the hardware silently wraps
// addresses or ignores bits, these rules are stricter on purpose.
#pragma once

#include "backends/cell_emu/mfc_command.hpp"
#include "celltrace/spe/diagnostic.hpp"

#include <string>

namespace celltrace::cell_emu {

/// The kind of storage at an effective address.
enum class EaKind {
  main_memory,
  local_store,
  signal_1,
  signal_2,
  in_mailbox,
  no_register, ///< problem state without a register that the emulator implements
  unmapped,    ///< no storage, or the range crosses the end of the storage that it starts in
};
constexpr bool is_register(EaKind kind) {
  return kind == EaKind::signal_1 || kind == EaKind::signal_2 || kind == EaKind::in_mailbox;
}

/// Checks a get, put or sndsig of `size` bytes. Size 0 is a legal no-op.
Rule broken_transfer_rule(const MfcCommand& command, EaKind target);

/// Checks a list command without its elements.
Rule broken_list_rule(const MfcCommand& command);

/// Returns the transfer of one element of a list. `quadword` is the local-store address of the element's
/// first quadword; the low 4 bits of the element's effective address choose the byte in this quadword.
MfcCommand element_command(const MfcCommand& list, const ListElement& element, std::uint32_t quadword);

/// Checks the result of element_command().
Rule broken_element_rule(const MfcCommand& part, EaKind target);

/// Checks getllar, putllc, putlluc or putqlluc.
Rule broken_lock_line_rule(const MfcCommand& command, EaKind target);

/// Checks sdcrz and the hints for the PPE's cache. A hint may have any mapped address.
Rule broken_cache_control_rule(const MfcCommand& command, EaKind target);

/// Checks the further rules of a command of the proxy queue.
Rule broken_proxy_rule(const MfcCommand& command);

/// Checks the rules of all commands: the opcode exists, the tag is 0..31.
Rule broken_common_rule(const MfcCommand& command);

/// Returns true if a command that broke `rule` can still be executed, provided that the rule's action is not
/// Action::stop.
constexpr bool can_be_carried_out(Rule rule) {
  return rule == Rule::none || rule == Rule::zero_size || rule == Rule::line_alignment ||
         rule == Rule::program_overwritten || rule == Rule::allocation_bounds || rule == Rule::object_bounds;
}

/// Returns a number's hexadecimal digits, without "0x".
std::string to_hex(std::uint32_t value);

/// Returns the command in one line: "get 20 bytes, LS 0x18010 <- EA 0x7f0010, tag 5".
std::string describe(const MfcCommand& command);

} // namespace celltrace::cell_emu
