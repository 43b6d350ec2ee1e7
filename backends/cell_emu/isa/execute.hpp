// Functions that execute instructions: one for each Opcode, with the same name.
#pragma once

#include "backends/cell_emu/isa/instruction.hpp"

namespace celltrace::isa::execute {

#define SPU_OPCODE(name, mnemonic, format, code, unit, syntax, operands)                                     \
  void name(State& state, const Instruction& i);
#include "celltrace/spe/opcodes.def"
#undef SPU_OPCODE

void invalid(State& state, const Instruction& i);

} // namespace celltrace::isa::execute
