// The SPE program of the tracer as this build has it: one entry point per SPU type.
#pragma once

#include "celltrace/spe/program.hpp"

namespace celltrace {

const SpeProgram& tracer_program();

} // namespace celltrace
