// backends(), and the simulator if the build has machine code for it.
#pragma once

#include "render/backends.hpp"
#include "render/tracer_program.hpp"

namespace celltrace::test {

inline std::vector<Backend> all_machines() {
  std::vector<Backend> all = backends();
  if (tracer_program().image("cell_sim").empty())
    WARN("skipped on cell_sim: machine code needs CELLTRACE_SPU_GXX");
  else
    all.push_back({"cell_sim", "auto"}); // whose words have the other byte order
  return all;
}

} // namespace celltrace::test
