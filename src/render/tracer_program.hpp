// The SPE programs of the tracer in this build: one entry point per SPU type.
#pragma once

#include "celltrace/spe/program.hpp"

namespace celltrace {

// Defined by the build (cmake/celltrace_spe_program.cmake).

/// Returns the tracer that uses a BVH; on machines with direct memory, any accelerator.
SpeProgram tracer_program();
/// Returns the tracer that uses a uniform grid, for other machines.
SpeProgram grid_tracer_program();

/// Returns an entry for each CPU of the native backend that fills in its kernel::RayQueryFunctions; no SPE
/// runs it.
SpeProgram ray_queries_program();

} // namespace celltrace
