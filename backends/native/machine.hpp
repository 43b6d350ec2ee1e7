// The native machine: every SPE is a thread of the host.
#pragma once

#include "celltrace/spe/machine.hpp"

#include <memory>

namespace celltrace::native {

/// Uses `spes`, `simd` and `signal_mode` of the configuration. Throws InputError for a SIMD that is unknown
/// or that the CPU lacks, and for more SPEs than 256.
std::unique_ptr<Machine> make_machine(const MachineConfig& config);

} // namespace celltrace::native
