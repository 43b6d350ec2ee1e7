// The emulated Cell: a 256 KB local store per SPE, and strict checks of every MFC command.
//
// If a program breaks a rule, it ends with an SpeError that names the SPE, the command, the addresses, the
// tag and the rule. The machine can be used again after such an error, once all SPEs have been waited for; it
// cannot be used after interrupt(). A kernel that runs for ever without accessing a channel that may stall
// cannot be interrupted.
#pragma once

#include "celltrace/spe/machine.hpp"

#include <memory>

namespace celltrace::cell_emu {

/// Makes the machine. Throws InputError for more than 256 SPEs, for a signal mode that does not exist, if
/// code and stack leave no arena, and for an EmulationConfig out of range.
std::unique_ptr<Machine> make_machine(const MachineConfig& config);

} // namespace celltrace::cell_emu
