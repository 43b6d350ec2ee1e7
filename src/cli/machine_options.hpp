// The options of `render` and `view` that choose the machine, and how work is shared among SPEs.
#pragma once

#include "celltrace/render.hpp"
#include "cli/emulation_options.hpp"

#include <string>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

/// Texts that CLI11 fills in besides the options.
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

/// Completes the options. Throws InputError for texts that contradict each other, and for an invalid cache.
/// The schedule is `default_schedule` if none is given.
void finish_machine(RenderOptions& options, const MachineTexts& texts, Schedule default_schedule);

/// Parses `off`, `WAYSxSETS` or `WAYSxSETS:random|fifo|lru`. Throws InputError for any other text and for
/// sizes that a cache cannot have.
CacheConfig parse_cache(const std::string& text);

} // namespace celltrace::cli
