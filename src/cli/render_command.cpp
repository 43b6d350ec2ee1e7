#include "cli/render_command.hpp"

#include "celltrace/image.hpp"
#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress_line.hpp"

#include <charconv>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>

namespace celltrace::cli {

namespace {

RenderOptions render_options(const RenderRequest& request) {
  RenderOptions options;
  options.width = request.width;
  options.height = request.height;
  options.backend = request.backend;
  options.spes = request.spes;
  options.simd = request.simd;
  options.cache = request.cache;
  options.balance = request.balance == "gde" ? Balance::gde : Balance::fixed;
  options.max_trace_level = request.max_level;
  options.adc_bailout = request.adc;
  return options;
}

} // namespace

int run_render(const RenderRequest& request) {
  check_image_path(request.output);
  catch_interrupts();
  return 0;
}

} // namespace celltrace::cli
