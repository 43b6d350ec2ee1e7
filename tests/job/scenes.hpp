// What the tests of jobs render.
#pragma once

#include "celltrace/job.hpp"

namespace celltrace::test {

inline constexpr const char* kScene = R"(
  camera { location <0, 2, -6> look_at 0 }
  light_source { <4, 6, -5>, 1 }
  plane { y, -1 pigment { checker rgb 1, rgb 0.2 } finish { reflection 0.3 } }
  #for (I, 1, 40)
    sphere { <2 * cos(I), 0.05 * I - 1, 2 * sin(I)>, 0.3 pigment { rgb <I / 40, 0.5, 1 - I / 40> } }
  #end
)";

/// Small pictures, by two SPEs.
inline JobOptions small_options() {
  JobOptions options;
  options.render.width = 64;
  options.render.height = 48;
  options.render.spes = 2;
  return options;
}

} // namespace celltrace::test
