// backends(), and the simulator if the build has machine code for it.
#pragma once

#include "render/backends.hpp"
#include "render/tracer_program.hpp"

namespace celltrace::test {

inline std::vector<TestBackend> all_machines() {
  std::vector<TestBackend> all = backends();
  if (tracer_program().image("cell_sim").empty())
    WARN("skipped on cell_sim: machine code needs CELLTRACE_SPU_GXX");
  else
    all.push_back({Backend::cell_sim, SimdLevel::automatic}); // whose words have the other byte order
  return all;
}

} // namespace celltrace::test
