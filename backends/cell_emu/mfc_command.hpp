// An MFC command as the SPU issues it, and the properties of its opcode.
#pragma once

#include "celltrace/spe/types.hpp"

#include <cstdint>

namespace celltrace::cell_emu {

/// Entries of the proxy queue, for commands that the PPE, or another writer of an SPE's problem state,
/// issues.
constexpr unsigned kProxyQueueEntries = 8;
/// Number of tags that libspe2 leaves to programs; the others are the system's.
constexpr std::uint32_t kProxyTags = 16;

/// The parameters of channels 16..21. For a list command, `size` is the length of the list in bytes, the high
/// half of `ea` is the high half of all elements' addresses, and the low half of `ea` is the local-store
/// address of the list.
struct MfcCommand {
  MfcOpcode opcode;
  std::uint32_t tag;
  std::uint32_t lsa;
  std::uint32_t size;
  ea_t ea;
};

enum class CommandKind { get, put, send_signal, lock_line, barrier, cache_control, unknown };

constexpr CommandKind kind_of(MfcOpcode opcode) {
  switch (opcode) {
  case MfcOpcode::get:
  case MfcOpcode::getb:
  case MfcOpcode::getf:
  case MfcOpcode::getl:
  case MfcOpcode::getlb:
  case MfcOpcode::getlf:
    return CommandKind::get;
  case MfcOpcode::put:
  case MfcOpcode::putb:
  case MfcOpcode::putf:
  case MfcOpcode::putl:
  case MfcOpcode::putlb:
  case MfcOpcode::putlf:
  case MfcOpcode::putr:
  case MfcOpcode::putrb:
  case MfcOpcode::putrf:
  case MfcOpcode::putrl:
  case MfcOpcode::putrlb:
  case MfcOpcode::putrlf:
    return CommandKind::put;
  case MfcOpcode::sndsig:
  case MfcOpcode::sndsigb:
  case MfcOpcode::sndsigf:
    return CommandKind::send_signal;
  case MfcOpcode::getllar:
  case MfcOpcode::putllc:
  case MfcOpcode::putlluc:
  case MfcOpcode::putqlluc:
    return CommandKind::lock_line;
  case MfcOpcode::barrier:
  case MfcOpcode::mfceieio:
  case MfcOpcode::mfcsync:
    return CommandKind::barrier;
  case MfcOpcode::sdcrt:
  case MfcOpcode::sdcrtst:
  case MfcOpcode::sdcrz:
  case MfcOpcode::sdcrst:
  case MfcOpcode::sdcrf:
    return CommandKind::cache_control;
  }
  return CommandKind::unknown;
}

/// Returns true if the opcode has the suffix `bit`. Only opcodes of transfers and signals have suffixes.
constexpr bool has_suffix(MfcOpcode opcode, std::uint32_t bit) {
  const CommandKind kind = kind_of(opcode);
  return (kind == CommandKind::get || kind == CommandKind::put || kind == CommandKind::send_signal) &&
         (static_cast<std::uint32_t>(opcode) & bit) != 0;
}
/// Returns true if the command is ordered after all earlier and before all later commands of its tag.
constexpr bool has_barrier(MfcOpcode opcode) {
  return has_suffix(opcode, 1);
}
/// Returns true if the command is ordered after all earlier commands of its tag.
constexpr bool has_fence(MfcOpcode opcode) {
  return has_suffix(opcode, 2);
}
constexpr bool is_list(MfcOpcode opcode) {
  return has_suffix(opcode, 4);
}
/// Returns true if the command is executed at once, outside the queue and the tag groups.
constexpr bool is_immediate(MfcOpcode opcode) {
  return kind_of(opcode) == CommandKind::lock_line && opcode != MfcOpcode::putqlluc;
}

/// Returns true if the command waits for all earlier commands of its tag.
constexpr bool follows_its_tag(MfcOpcode opcode) {
  return has_fence(opcode) || has_barrier(opcode) || opcode == MfcOpcode::putqlluc;
}

/// Returns true if the command changes the storage at its effective address.
constexpr bool writes_storage(MfcOpcode opcode) {
  const CommandKind kind = kind_of(opcode);
  return kind == CommandKind::put || opcode == MfcOpcode::sdcrz ||
         (kind == CommandKind::lock_line && opcode != MfcOpcode::getllar);
}

/// Returns true if `earlier` must be complete before `later` of the same queue may start, without regard to
/// commands between them.
constexpr bool is_ordered(const MfcCommand& earlier, const MfcCommand& later) {
  if (kind_of(earlier.opcode) == CommandKind::barrier || kind_of(later.opcode) == CommandKind::barrier)
    return true;
  if (earlier.tag != later.tag) return false;
  return has_barrier(earlier.opcode) || follows_its_tag(later.opcode);
}

constexpr const char* name_of(MfcOpcode opcode) {
  switch (opcode) {
  case MfcOpcode::put:
    return "put";
  case MfcOpcode::putb:
    return "putb";
  case MfcOpcode::putf:
    return "putf";
  case MfcOpcode::putl:
    return "putl";
  case MfcOpcode::putlb:
    return "putlb";
  case MfcOpcode::putlf:
    return "putlf";
  case MfcOpcode::putr:
    return "putr";
  case MfcOpcode::putrb:
    return "putrb";
  case MfcOpcode::putrf:
    return "putrf";
  case MfcOpcode::putrl:
    return "putrl";
  case MfcOpcode::putrlb:
    return "putrlb";
  case MfcOpcode::putrlf:
    return "putrlf";
  case MfcOpcode::sdcrt:
    return "sdcrt";
  case MfcOpcode::sdcrtst:
    return "sdcrtst";
  case MfcOpcode::sdcrz:
    return "sdcrz";
  case MfcOpcode::sdcrst:
    return "sdcrst";
  case MfcOpcode::sdcrf:
    return "sdcrf";
  case MfcOpcode::get:
    return "get";
  case MfcOpcode::getb:
    return "getb";
  case MfcOpcode::getf:
    return "getf";
  case MfcOpcode::getl:
    return "getl";
  case MfcOpcode::getlb:
    return "getlb";
  case MfcOpcode::getlf:
    return "getlf";
  case MfcOpcode::sndsig:
    return "sndsig";
  case MfcOpcode::sndsigb:
    return "sndsigb";
  case MfcOpcode::sndsigf:
    return "sndsigf";
  case MfcOpcode::putlluc:
    return "putlluc";
  case MfcOpcode::putllc:
    return "putllc";
  case MfcOpcode::putqlluc:
    return "putqlluc";
  case MfcOpcode::barrier:
    return "barrier";
  case MfcOpcode::mfceieio:
    return "mfceieio";
  case MfcOpcode::mfcsync:
    return "mfcsync";
  case MfcOpcode::getllar:
    return "getllar";
  }
  return "command";
}

} // namespace celltrace::cell_emu
