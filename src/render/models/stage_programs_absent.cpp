// Replaces the programs of the stages in builds with CELLTRACE_MODELS=OFF.
#include "celltrace/error.hpp"
#include "render/models/stage_programs.hpp"

namespace celltrace {

namespace {

[[noreturn]] SpeProgram throw_absent() {
  throw InputError(
      "this build has the programming model shared alone: it was configured with CELLTRACE_MODELS=OFF");
}

} // namespace

SpeProgram stage_generator_program() {
  throw_absent();
}
SpeProgram stage_searcher_program() {
  throw_absent();
}
SpeProgram stage_shader_program() {
  throw_absent();
}

} // namespace celltrace
