// Checks the values of a machine's configuration.
#pragma once

#include "celltrace/spe/emulation.hpp"

namespace celltrace::cell_emu {

constexpr unsigned kMaxSpes = 256;

/// Throws InputError, naming the member, for a value out of the range that emulation.hpp and timing.hpp
/// state.
void check_emulation(const EmulationConfig& config);

} // namespace celltrace::cell_emu
