// The native machine: every SPE is a thread of the host.
#pragma once

#include "celltrace/spe/machine.hpp"

#include <memory>

namespace celltrace::native {

/// Makes the machine from `spes`, `simd` and `signal_mode` of the configuration. Throws InputError for a SIMD
/// level that the build or the CPU lacks, and for more than 256 SPEs.
std::unique_ptr<Machine> make_machine(const MachineConfig& config);

} // namespace celltrace::native
