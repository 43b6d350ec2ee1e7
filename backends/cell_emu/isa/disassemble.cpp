// Disassembles instructions in the assembler's syntax.
#include "backends/cell_emu/isa/instruction.hpp"

#include <cinttypes>
#include <cstdio>

namespace celltrace::isa {
namespace {

using Text = std::string;

Text reg(unsigned number) {
  return Text("$") + std::to_string(number);
}
Text hexadecimal(std::uint32_t value) {
  char text[16];
  std::snprintf(text, sizeof text, "%" PRIx32, value);
  return text;
}
Text address_text(std::uint32_t address) {
  return Text("0x") + hexadecimal(address);
}

/// Returns letters for the feature bits of sync, hbr and branches to a register. These bits are at the place
/// of rb.
Text features(std::uint32_t word, char first) {
  Text letters;
  if ((word >> 20 & 1) != 0) letters += first;
  if ((word >> 19 & 1) != 0) letters += 'd';
  if ((word >> 18 & 1) != 0) letters += 'e';
  return letters;
}
Text features(const Instruction& i, Syntax syntax) {
  switch (syntax) {
  case Syntax::features:
    return features(i.word, 'c');
  case Syntax::ra_features:
  case Syntax::rt_ra_features:
  case Syntax::hint_register:
    return features(i.word, 'p');
  default:
    return {};
  }
}

/// Returns the target of a relative branch; "0" for an offset of 0.
Text relative(std::int32_t offset, std::uint32_t pc) {
  return offset == 0 ? "0" : address_text((pc + static_cast<std::uint32_t>(offset)) & kLocalStoreLimit);
}
Text absolute(std::int32_t target) {
  return target == 0 ? "0" : address_text(static_cast<std::uint32_t>(target));
}

/// Returns the address of a hint's branch, which may be outside of local store.
Text hinted(const Instruction& i, std::uint32_t pc) {
  const std::uint32_t branch = hinted_branch(i, 0);
  const bool negative = branch > kLocalStoreLimit / 2;
  return address_text(pc + (negative ? branch - (kLocalStoreLimit + 1) : branch));
}

Text operands(const Instruction& i, Syntax syntax, std::uint32_t pc) {
  const Text rt = reg(i.rt), ra = reg(i.ra), rb = reg(i.rb), rc = reg(i.rc);
  const Text immediate = std::to_string(i.immediate);
  switch (syntax) {
  case Syntax::none:
  case Syntax::features:
  case Syntax::stop:
    return {};
  case Syntax::rt:
    return rt;
  case Syntax::ra_features:
    return ra;
  case Syntax::rt_ra:
  case Syntax::rt_ra_features:
    return rt + ',' + ra;
  case Syntax::rt_ra_rb:
    return rt + ',' + ra + ',' + rb;
  case Syntax::rt_ra_rb_rc:
    return rt + ',' + ra + ',' + rb + ',' + rc;
  case Syntax::rt_ra_i7:
  case Syntax::rt_ra_i10:
  case Syntax::rt_ra_scale_173:
  case Syntax::rt_ra_scale_155:
    return rt + ',' + ra + ',' + immediate;
  case Syntax::rt_i7_ra:
  case Syntax::rt_displacement:
    return rt + ',' + immediate + '(' + ra + ')';
  case Syntax::rt_i16:
  case Syntax::rt_u16:
  case Syntax::rt_u18:
    return rt + ',' + immediate;
  case Syntax::relative:
    return relative(i.immediate, pc);
  case Syntax::rt_relative:
    return rt + ',' + relative(i.immediate, pc);
  case Syntax::absolute:
    return absolute(i.immediate);
  case Syntax::rt_absolute:
    return rt + ',' + absolute(i.immediate);
  case Syntax::hint_register:
    return hinted(i, pc) + ',' + ra;
  case Syntax::hint_relative:
    return hinted(i, pc) + ',' + relative(i.immediate, pc);
  case Syntax::hint_absolute:
    return hinted(i, pc) + ',' + absolute(i.immediate);
  case Syntax::rt_spr:
    return rt + ",$sp" + std::to_string(i.ra);
  case Syntax::spr_rt:
    return Text("$sp") + std::to_string(i.ra) + ',' + rt;
  case Syntax::rt_channel:
    return rt + ",$ch" + std::to_string(i.ra);
  case Syntax::channel_rt:
    return Text("$ch") + std::to_string(i.ra) + ',' + rt;
  }
  return {};
}

/// Returns the number of an instruction that objdump repeats in hexadecimal if it is above 16.
std::int32_t remarked(const Instruction& i, Syntax syntax, std::uint32_t pc) {
  switch (syntax) {
  case Syntax::rt_ra_i7:
  case Syntax::rt_i7_ra:
  case Syntax::rt_ra_i10:
  case Syntax::rt_displacement:
  case Syntax::rt_i16:
  case Syntax::rt_u16:
  case Syntax::rt_u18:
    return i.immediate;
  case Syntax::relative:
  case Syntax::rt_relative:
  case Syntax::hint_relative:
    return i.immediate == 0 ? 0 : static_cast<std::int32_t>(pc + static_cast<std::uint32_t>(i.immediate));
  default:
    return 0;
  }
}

} // namespace

std::string disassemble(std::uint32_t word, std::uint32_t address) {
  const OpcodeInfo* info = find_opcode(word);
  if (info == nullptr) return Text(".long 0x") + hexadecimal(word);
  const Instruction i = decode(word);
  Text text = Text(info->mnemonic) + features(i, info->syntax);
  const Text written = operands(i, info->syntax, address);
  if (!written.empty()) text += Text("\t") + written;
  const std::int32_t number = remarked(i, info->syntax, address);
  if (number > 16) text += Text("\t# ") + hexadecimal(static_cast<std::uint32_t>(number));
  return text;
}

} // namespace celltrace::isa
