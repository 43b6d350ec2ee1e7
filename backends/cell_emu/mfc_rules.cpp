#include "backends/cell_emu/mfc_rules.hpp"

#include <cinttypes>
#include <cstdio>

namespace celltrace::cell_emu {
namespace {

constexpr bool is_transfer_size(std::uint32_t size) {
  if (size > kMaxDmaBytes) return false;
  return (size & 15) == 0 || size == 1 || size == 2 || size == 4 || size == 8;
}

MfcRule broken_register_rule(const MfcCommand& command, EaKind target) {
  if (command.size != 4) return MfcRule::register_size;
  if ((command.lsa & 15) != 0xC) return MfcRule::register_word;
  if (kind_of(command.opcode) == CommandKind::get && target == EaKind::in_mailbox)
    return MfcRule::register_readable;
  return MfcRule::none;
}

MfcRule broken_signal_rule(const MfcCommand& command, EaKind target) {
  if (command.size != 4) return MfcRule::signal_size;
  if (target != EaKind::signal_1 && target != EaKind::signal_2) return MfcRule::signal_target;
  return MfcRule::none;
}

} // namespace

const char* text_of(MfcRule rule) {
  switch (rule) {
  case MfcRule::none:
    return "legal";
  case MfcRule::known_command:
    return "the MFC has no such command";
  case MfcRule::tag_range:
    return "tag must be 0..31";
  case MfcRule::transfer_size:
    return "size must be 1, 2, 4, 8 or a multiple of 16 up to 16384";
  case MfcRule::in_local_store:
    return "LS address must lie in this SPE's local store";
  case MfcRule::local_store_end:
    return "transfer must not cross the end of local store";
  case MfcRule::same_low_bits:
    return "LS and EA must agree in their low 4 bits";
  case MfcRule::natural_alignment:
    return "a transfer of less than 16 bytes must be aligned to its size";
  case MfcRule::quadword_alignment:
    return "a transfer of 16 bytes or more must be 16-byte aligned";
  case MfcRule::mapped_address:
    return "EA must be mapped, and the transfer stay in the storage it starts in";
  case MfcRule::register_exists:
    return "EA must be a problem-state register: signal 1, signal 2 or inbound mailbox";
  case MfcRule::register_size:
    return "a problem-state register takes exactly 4 bytes";
  case MfcRule::register_word:
    return "the word for a problem-state register must lie in the last word of a quadword (LS & 15 = 0xC)";
  case MfcRule::register_readable:
    return "the inbound mailbox cannot be read by DMA";
  case MfcRule::signal_size:
    return "sndsig takes exactly 4 bytes";
  case MfcRule::signal_target:
    return "sndsig must go to a signal notification register";
  case MfcRule::line_alignment:
    return "LS and EA of a lock-line command must be 128-byte aligned";
  case MfcRule::line_in_memory:
    return "a lock line must lie in main memory or in a local store";
  case MfcRule::list_in_local_store:
    return "the list must lie in this SPE's local store";
  case MfcRule::list_alignment:
    return "the list must be 8-byte aligned";
  case MfcRule::list_length:
    return "the list must be a multiple of 8 bytes, up to 2048 elements";
  case MfcRule::list_end:
    return "the list must not cross the end of local store";
  case MfcRule::element_region:
    return "a list element must not cross a 4 GB boundary";
  }
  return "unknown rule";
}

MfcRule broken_transfer_rule(const MfcCommand& command, EaKind target) {
  const auto [opcode, tag, lsa, size, ea] = command;
  if (lsa >= kLocalStoreBytes) return MfcRule::in_local_store;
  if (kind_of(opcode) == CommandKind::send_signal) {
    const MfcRule rule = broken_signal_rule(command, target);
    if (rule != MfcRule::none) return rule;
  }
  if (!is_transfer_size(size)) return MfcRule::transfer_size;
  if (size == 0) return MfcRule::none;
  if (lsa + size > kLocalStoreBytes) return MfcRule::local_store_end;
  if (target == EaKind::unmapped) return MfcRule::mapped_address;
  if (target == EaKind::no_register) return MfcRule::register_exists;
  if (is_register(target)) return broken_register_rule(command, target);
  if (((lsa ^ ea) & 15) != 0) return MfcRule::same_low_bits;
  if (size < 16) return (ea & (size - 1)) == 0 ? MfcRule::none : MfcRule::natural_alignment;
  return (ea & 15) == 0 ? MfcRule::none : MfcRule::quadword_alignment;
}

MfcRule broken_list_rule(const MfcCommand& command) {
  const auto list = static_cast<std::uint32_t>(command.ea);
  if (command.lsa >= kLocalStoreBytes) return MfcRule::in_local_store;
  if (list >= kLocalStoreBytes) return MfcRule::list_in_local_store;
  if ((list & 7) != 0) return MfcRule::list_alignment;
  if ((command.size & 7) != 0 || command.size > kMaxListElements * sizeof(ListElement))
    return MfcRule::list_length;
  if (list + command.size > kLocalStoreBytes) return MfcRule::list_end;
  return MfcRule::none;
}

MfcCommand element_command(const MfcCommand& list, const ListElement& element, std::uint32_t quadword) {
  // The hardware looks at 15 bits of the size only.
  constexpr std::uint32_t kSizeBits = 0x7FFF;
  const MfcOpcode opcode = kind_of(list.opcode) == CommandKind::get ? MfcOpcode::get : MfcOpcode::put;
  const ea_t region = list.ea & ~ea_t{0xFFFFFFFF};
  return {opcode, list.tag, quadword | (element.ea_low & 15), element.notify_and_size & kSizeBits,
          region | element.ea_low};
}

MfcRule broken_element_rule(const MfcCommand& part, EaKind target) {
  if ((part.ea & 0xFFFFFFFF) + part.size > ea_t{1} << 32) return MfcRule::element_region;
  return broken_transfer_rule(part, target);
}

MfcRule broken_lock_line_rule(const MfcCommand& command, EaKind target) {
  if (command.lsa >= kLocalStoreBytes) return MfcRule::in_local_store;
  if (((command.lsa | command.ea) & (kLineBytes - 1)) != 0) return MfcRule::line_alignment;
  if (target == EaKind::unmapped) return MfcRule::mapped_address;
  if (target != EaKind::main_memory && target != EaKind::local_store) return MfcRule::line_in_memory;
  return MfcRule::none;
}

MfcRule broken_common_rule(const MfcCommand& command) {
  if (kind_of(command.opcode) == CommandKind::unknown) return MfcRule::known_command;
  if (command.tag >= kMfcTags) return MfcRule::tag_range;
  return MfcRule::none;
}

std::string describe(const MfcCommand& command) {
  char text[160];
  const char* const name = name_of(command.opcode);
  const char* const arrow =
      kind_of(command.opcode) == CommandKind::get || command.opcode == MfcOpcode::getllar ? "<-" : "->";
  const char* const where = command.lsa == kOutsideLocalStore ? "outside" : "0x";
  char lsa[16] = "";
  if (command.lsa != kOutsideLocalStore) std::snprintf(lsa, sizeof lsa, "%" PRIx32, command.lsa);
  if (kind_of(command.opcode) == CommandKind::unknown) {
    std::snprintf(text, sizeof text, "command 0x%" PRIx32, static_cast<std::uint32_t>(command.opcode));
  } else if (kind_of(command.opcode) == CommandKind::barrier) {
    std::snprintf(text, sizeof text, "%s, tag %" PRIu32, name, command.tag);
  } else if (is_list(command.opcode)) {
    std::snprintf(text, sizeof text,
                  "%s of %" PRIu32 " bytes of list at LS 0x%" PRIx32 ", LS %s%s %s EA 0x%" PRIx32
                  "........, tag %" PRIu32,
                  name, command.size, static_cast<std::uint32_t>(command.ea), where, lsa, arrow,
                  static_cast<std::uint32_t>(command.ea >> 32), command.tag);
  } else {
    std::snprintf(text, sizeof text, "%s %" PRIu32 " bytes, LS %s%s %s EA 0x%" PRIx64 ", tag %" PRIu32, name,
                  command.size, where, lsa, arrow, command.ea, command.tag);
  }
  return text;
}

} // namespace celltrace::cell_emu
