// The SPE programs of the stages in this build (cmake/celltrace_spe_program.cmake).
#pragma once

#include "celltrace/spe/program.hpp"

namespace celltrace {

SpeProgram stage_generator_program();
SpeProgram stage_searcher_program();
SpeProgram stage_shader_program();

} // namespace celltrace
