// Instructions of the SPU: the table of all opcodes, decoding and disassembly. Source: SPU Instruction Set
// Architecture 1.2.
#pragma once

#include "backends/cell_emu/isa/state.hpp"
#include "celltrace/spe/spu_instructions.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace celltrace::isa {

/// Layouts of instruction words. The opcode is in the high bits that the format's fields leave free.
enum class Format : std::uint8_t {
  rr,   ///< opcode of 11 bits; rb, ra, rt of 7 bits each
  rrr,  ///< opcode of 4 bits; rt, rb, ra, rc
  ri7,  ///< opcode of 11 bits; immediate of 7, ra, rt
  ri8,  ///< opcode of 10 bits; immediate of 8, ra, rt
  ri10, ///< opcode of 8 bits; immediate of 10, ra, rt
  ri16, ///< opcode of 9 bits; immediate of 16, rt
  ri18, ///< opcode of 7 bits; immediate of 18, rt
};

/// Execution units. The unit decides an instruction's pipe and latency.
enum class Unit : std::uint8_t {
  // Even pipe.
  fx2, ///< simple fixed point, logic, compares
  fx3, ///< word rotates and shifts
  fxb, ///< byte operations
  fp6, ///< single precision
  fp7, ///< integer multiply, conversions, interpolation
  fpd, ///< double precision
  nop,
  // Odd pipe.
  ls,   ///< loads and stores
  shuf, ///< shuffles, quadword rotates, estimates
  br,   ///< branches, stops
  hbr,  ///< branch hints
  spr,  ///< channels and special registers
  lnop,
};
constexpr bool is_even(Unit unit) {
  return unit <= Unit::nop;
}

/// The assembly syntax of an instruction, which also defines Instruction::immediate.
enum class Syntax : std::uint8_t {
  none,
  features, ///< a letter behind the mnemonic for a feature bit: syncc
  rt,
  rt_ra,
  rt_ra_rb,
  rt_ra_rb_rc,
  ra_features,     ///< letters for the feature bits: bid, bie
  rt_ra_features,  ///< bisld, bizd
  rt_ra_i7,        ///< immediate: I7, sign-extended
  rt_i7_ra,        ///< $3,4($5); immediate: I7, sign-extended
  rt_ra_i10,       ///< immediate: I10, sign-extended, whatever the size of the parts
  rt_displacement, ///< $3,16($5); immediate: I10 in bytes, a multiple of 16
  rt_ra_scale_173, ///< to integers; immediate: the binary exponent to multiply by, 173 - I8
  rt_ra_scale_155, ///< from integers; immediate: the binary exponent to divide by, 155 - I8
  rt_i16,          ///< immediate: I16, sign-extended
  rt_u16,          ///< immediate: I16, not sign-extended
  rt_u18,          ///< immediate: I18, not sign-extended
  relative,        ///< immediate: the offset from this instruction in bytes
  rt_relative,
  absolute, ///< immediate: the address in local store, a multiple of 4
  rt_absolute,
  hint_register, ///< immediate: offset in bytes of the hinted branch; its target is in ra
  hint_relative, ///< immediate: the offset of the branch's target
  hint_absolute, ///< immediate: the address of the branch's target
  stop,          ///< immediate: the stop code, which is not printed
  rt_spr,
  spr_rt,
  rt_channel, ///< the channel's number is in ra
  channel_rt,
};

struct Instruction;
using Execute = void (*)(State& state, const Instruction& instruction);

/// Bits that say which registers an instruction reads and writes.
namespace operand {
constexpr std::uint8_t reads_ra = 1, reads_rb = 2, reads_rc = 4, reads_rt = 8, writes_rt = 16;
}

struct OpcodeInfo {
  const char* mnemonic;
  Opcode opcode;
  Format format;
  std::uint16_t code; ///< bits of the opcode; the format decides their number
  Unit unit;
  Syntax syntax;
  std::uint8_t operands; ///< bits of namespace `operand`
  Execute execute;
};

/// Returns all opcodes, indexed by Opcode.
std::span<const OpcodeInfo> opcodes();
/// Returns the opcode of an instruction word, or null if the word is invalid.
const OpcodeInfo* find_opcode(std::uint32_t word);

/// The register number that stands for no register.
constexpr std::uint8_t kNoRegister = 128;

/// An instruction word, decoded.
struct Instruction {
  Execute execute; ///< calls Environment::invalid_instruction() for an invalid word
  std::uint32_t word;
  std::int32_t immediate; ///< see Syntax; 0 if there is none
  /// Fields of the instruction word; 0 if the format lacks the field. rt is set even if the instruction does
  /// not use it.
  std::uint8_t rt, ra, rb, rc;
  std::uint8_t source[3]; ///< registers that the instruction reads, else kNoRegister
  std::uint8_t target;    ///< register that the instruction writes, else kNoRegister
  Opcode opcode;          ///< stop for an invalid word
  Unit unit;
};

Instruction decode(std::uint32_t word);

/// Returns the address of the branch that a hint (Unit::hbr) at `pc` predicts.
std::uint32_t hinted_branch(const Instruction& hint, std::uint32_t pc);

/// Returns the instruction in the assembler's syntax, with a tab between mnemonic and operands, as
/// spu-elf-objdump prints it without symbols: "ai\t$3,$4,-16", branch targets as addresses, immediates above
/// 16 repeated in hexadecimal
/// ("brsl\t$0,0x1a0\t# 1a0").
std::string disassemble(std::uint32_t word, std::uint32_t address);

} // namespace celltrace::isa
