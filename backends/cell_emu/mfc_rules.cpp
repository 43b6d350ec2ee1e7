#include "backends/cell_emu/mfc_rules.hpp"

#include <cinttypes>
#include <cstdio>

namespace celltrace::cell_emu {
namespace {

constexpr bool is_transfer_size(std::uint32_t size) {
  if (size > kMaxDmaBytes) return false;
  return (size & 15) == 0 || size == 1 || size == 2 || size == 4 || size == 8;
}

Rule broken_register_rule(const MfcCommand& command, EaKind target) {
  if (command.size != 4) return Rule::register_size;
  if ((command.lsa & 15) != 0xC) return Rule::register_word;
  if (kind_of(command.opcode) == CommandKind::get && target == EaKind::in_mailbox)
    return Rule::register_readable;
  return Rule::none;
}

Rule broken_signal_rule(const MfcCommand& command, EaKind target) {
  if (command.size != 4) return Rule::signal_size;
  if (target != EaKind::signal_1 && target != EaKind::signal_2) return Rule::signal_target;
  return Rule::none;
}

} // namespace

Rule broken_transfer_rule(const MfcCommand& command, EaKind target) {
  const auto [opcode, tag, lsa, size, ea] = command;
  if (lsa >= kLocalStoreBytes) return Rule::in_local_store;
  if (kind_of(opcode) == CommandKind::send_signal) {
    const Rule rule = broken_signal_rule(command, target);
    if (rule != Rule::none) return rule;
  }
  if (!is_transfer_size(size)) return Rule::transfer_size;
  if (size == 0) return Rule::none;
  if (lsa + size > kLocalStoreBytes) return Rule::local_store_end;
  if (target == EaKind::unmapped) return Rule::mapped_address;
  if (target == EaKind::no_register) return Rule::register_exists;
  if (is_register(target)) return broken_register_rule(command, target);
  if (((lsa ^ ea) & 15) != 0) return Rule::same_low_bits;
  if (size < 16) return (ea & (size - 1)) == 0 ? Rule::none : Rule::natural_alignment;
  return (ea & 15) == 0 ? Rule::none : Rule::quadword_alignment;
}

Rule broken_list_rule(const MfcCommand& command) {
  const auto list = static_cast<std::uint32_t>(command.ea);
  if (command.lsa >= kLocalStoreBytes) return Rule::in_local_store;
  if (list >= kLocalStoreBytes) return Rule::list_in_local_store;
  if ((list & 7) != 0) return Rule::list_alignment;
  if ((command.size & 7) != 0 || command.size > kMaxListElements * sizeof(ListElement))
    return Rule::list_length;
  if (list + command.size > kLocalStoreBytes) return Rule::list_end;
  return Rule::none;
}

MfcCommand element_command(const MfcCommand& list, const ListElement& element, std::uint32_t quadword) {
  // The hardware uses only 15 bits of the size.
  constexpr std::uint32_t kSizeBits = 0x7FFF;
  const MfcOpcode opcode = kind_of(list.opcode) == CommandKind::get ? MfcOpcode::get : MfcOpcode::put;
  const ea_t region = list.ea & ~ea_t{0xFFFFFFFF};
  return {opcode, list.tag, quadword | (element.ea_low & 15), element.notify_and_size & kSizeBits,
          region | element.ea_low};
}

Rule broken_element_rule(const MfcCommand& part, EaKind target) {
  if ((part.ea & 0xFFFFFFFF) + part.size > ea_t{1} << 32) return Rule::element_region;
  return broken_transfer_rule(part, target);
}

Rule broken_lock_line_rule(const MfcCommand& command, EaKind target) {
  if (command.lsa >= kLocalStoreBytes) return Rule::in_local_store;
  if (((command.lsa | command.ea) & (kLineBytes - 1)) != 0) return Rule::line_alignment;
  if (target == EaKind::unmapped) return Rule::mapped_address;
  if (target != EaKind::main_memory && target != EaKind::local_store) return Rule::line_in_memory;
  return Rule::none;
}

Rule broken_common_rule(const MfcCommand& command) {
  if (kind_of(command.opcode) == CommandKind::unknown) return Rule::known_command;
  if (command.tag >= kMfcTags) return Rule::tag_range;
  return Rule::none;
}

Rule broken_cache_control_rule(const MfcCommand& command, EaKind target) {
  if (command.size > kMaxDmaBytes) return Rule::transfer_size;
  if (target == EaKind::unmapped) return Rule::mapped_address;
  if (command.opcode != MfcOpcode::sdcrz) return Rule::none;
  if (target != EaKind::main_memory && target != EaKind::local_store) return Rule::line_in_memory;
  return ((command.ea | command.size) & (kLineBytes - 1)) == 0 ? Rule::none : Rule::line_alignment;
}

Rule broken_proxy_rule(const MfcCommand& command) {
  const CommandKind kind = kind_of(command.opcode);
  if ((kind != CommandKind::get && kind != CommandKind::put) || is_list(command.opcode))
    return Rule::proxy_command;
  return command.tag >= kProxyTags ? Rule::proxy_tag_range : Rule::none;
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

std::string to_hex(std::uint32_t value) {
  char text[9];
  std::snprintf(text, sizeof text, "%x", static_cast<unsigned>(value));
  return text;
}

} // namespace celltrace::cell_emu
