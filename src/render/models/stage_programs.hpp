// The programs of the stages as this build has them; defined by it (cmake/celltrace_spe_program.cmake).
#pragma once

#include "celltrace/spe/program.hpp"

namespace celltrace {

SpeProgram stage_generator_program();
SpeProgram stage_searcher_program();
SpeProgram stage_shader_program();

} // namespace celltrace
