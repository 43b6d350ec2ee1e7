// Instructions of the SPU: the table of all opcodes, and decoding by it. Source: SPU Instruction Set
// Architecture 1.2.
#pragma once

#include "backends/cell_emu/isa/state.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace celltrace::isa {

/// How an instruction word is laid out. The opcode is in the high bits, in as many as the format leaves.
enum class Format : std::uint8_t {
  rr,   ///< 11 bits: rb, ra, rt of 7 bits each
  rrr,  ///< 4 bits: rt, rb, ra, rc
  ri7,  ///< 11 bits: immediate of 7, ra, rt
  ri8,  ///< 10 bits: immediate of 8, ra, rt
  ri10, ///< 8 bits: immediate of 10, ra, rt
  ri16, ///< 9 bits: immediate of 16, rt
  ri18, ///< 7 bits: immediate of 18, rt
};

/// Who executes an instruction, which decides its pipe and its latency.
enum class Unit : std::uint8_t {
  // even pipe
  fx2,  ///< simple fixed point, logic, compares
  fx3,  ///< word rotates and shifts
  fxb,  ///< byte operations
  fp6,  ///< single precision
  fp7,  ///< integer multiply, conversions, interpolation
  fpd,  ///< double precision
  nop,
  // odd pipe
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

/// How an instruction is written in assembly.
enum class Syntax : std::uint8_t;

/// Named as in assembly, in the order of opcodes.def.
enum class Opcode : std::uint8_t;

struct Instruction;
using Execute = void (*)(State& state, const Instruction& instruction);

/// What a register of an operand field is for; bits.
namespace operand {
constexpr std::uint8_t reads_ra = 1, reads_rb = 2, reads_rc = 4, reads_rt = 8, writes_rt = 16;
}

struct OpcodeInfo {
  const char* mnemonic;
  Opcode opcode;
  Format format;
  std::uint16_t code; ///< the opcode's bits, as many as the format has
  Unit unit;
  Syntax syntax;
  std::uint8_t operands; ///< of `operand`
  Execute execute;
};

/// All of them, by Opcode. Not the word that none of them is.
std::span<const OpcodeInfo> opcodes();
/// The one whose code the word's high bits are, or null.
const OpcodeInfo* find_opcode(std::uint32_t word);

/// A register number that says: none.
constexpr std::uint8_t kNoRegister = 128;

/// An instruction word, decoded.
struct Instruction {
  Execute execute;      ///< calls Environment::invalid_instruction() for a word that is none
  std::uint32_t word;
  std::int32_t immediate; ///< sign-extended where the instruction does that; I16 and RI16 offsets in bytes
  std::uint8_t rt, ra, rb, rc;
  std::uint8_t source[3]; ///< registers that it reads; kNoRegister
  std::uint8_t target;    ///< register that it writes; kNoRegister
  Opcode opcode;
  Unit unit;
};

Instruction decode(std::uint32_t word);

/// In the assembler's words, tabs between mnemonic and operands, as spu-elf-objdump writes it: "ai\t$3,$4,-16",
/// branch targets as addresses ("brsl\t$0,0x1a0").
std::string disassemble(std::uint32_t word, std::uint32_t address);

} // namespace celltrace::isa
