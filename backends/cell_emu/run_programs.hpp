// One program on every SPE of a machine, from its start to its end.
#pragma once

#include "celltrace/emulator.hpp"

namespace celltrace::cell_emu {

/// What emulate_program() and simulate() do with the machine that they made.
EmulatedRun run_programs(Machine& machine, const SpeProgram& program, ea_t argument, const EmulatedPpe& ppe);

} // namespace celltrace::cell_emu
