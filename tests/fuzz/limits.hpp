// What the fuzz targets share: limits that keep one input from taking all of the time.
#pragma once

#include "celltrace/pov.hpp"

namespace celltrace::test {

inline ParseOptions fuzzing_options() {
  ParseOptions options;
  options.width = options.height = 16;
  options.message = [](std::string_view) {};
  ParseLimits& limits = options.limits;
  limits.macro_depth = 100;
  limits.loop_iterations = 10'000;
  limits.recorded_tokens = 100'000;
  limits.tokens = 1'000'000;
  limits.array_elements = 100'000;
  limits.list_entries = 100'000;
  limits.string_bytes = 1u << 16;
  limits.text_bytes = 4u << 20;
  limits.memory = 64u << 20;
  limits.seconds = 5;
  limits.objects = 10'000;
  limits.triangles = 100'000;
  limits.map_entries = 100'000;
  return options;
}

} // namespace celltrace::test
