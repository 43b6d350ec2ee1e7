// The SPE program of the tracer as this build has it: one entry point per SPU type.
#pragma once

#include "celltrace/spe/program.hpp"

namespace celltrace {

/// Defined by the build (cmake/celltrace_spe_program.cmake).
SpeProgram tracer_program();

} // namespace celltrace
