// The SPE programs of the tracer as this build has them: one entry point per SPU type.
#pragma once

#include "celltrace/spe/program.hpp"

namespace celltrace {

// Defined by the build (cmake/celltrace_spe_program.cmake).

/// Finds objects by a BVH; on machines with direct memory, by any accelerator.
SpeProgram tracer_program();
/// By a uniform grid, on other machines.
SpeProgram grid_tracer_program();

/// No program of SPEs: for each CPU of the native backend, what enters its kernel::RayQueryFunctions.
SpeProgram ray_queries_program();

} // namespace celltrace
