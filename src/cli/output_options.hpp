// The options of `render` that say what becomes of the picture.
#pragma once

#include "cli/command_line.hpp"

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

/// What CLI11 fills in besides the request.
struct OutputTexts {
  std::string file_type; ///< empty: by the name
  std::string picture = "on";
  std::string alpha = "off";
  std::string first_hits = "off";
  std::optional<int> bits; ///< none: as many as the format has anyway
};

void add_output_options(CLI::App& command, RenderRequest& request, OutputTexts& texts);

/// After the request's scene, model, region, antialiasing, animation and statistics are known. Throws
/// InputError for what a format cannot hold, and for what cannot go to stdout.
void finish_output(RenderRequest& request, const OutputTexts& texts);

} // namespace celltrace::cli
