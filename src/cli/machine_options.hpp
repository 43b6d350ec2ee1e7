// The options of `render` and `view` that say what renders, and how it is shared among SPEs.
#pragma once

#include "celltrace/render.hpp"
#include "cli/emulation_options.hpp"

#include <string>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

/// What CLI11 fills in besides the options.
struct MachineTexts {
  std::string backend = "native";
  std::string simd = "auto";
  std::string cache = "4x128:fifo";
  std::string balance = "gde";
  std::string accelerator = "auto";
  std::string model = "shared";
  EmulationTexts emulation;
};

void add_machine_options(CLI::App& command, RenderOptions& options, MachineTexts& texts);

/// Throws InputError for texts that contradict each other, and for no cache. Where none is said, the schedule
/// is `default_schedule`.
void finish_machine(RenderOptions& options, const MachineTexts& texts, Schedule default_schedule);

/// `off`, `WAYSxSETS` or `WAYSxSETS:random|fifo|lru`. Throws InputError for any other text and for sizes that
/// a cache cannot have.
CacheConfig parse_cache(const std::string& text);

} // namespace celltrace::cli
