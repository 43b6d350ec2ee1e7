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
  std::string pov_name;  ///< of the picture, by POV-Ray's rule; counts if RenderRequest::output is empty
  std::string picture = "on";
  std::string alpha = "off";
  std::string first_hits = "off";
  std::string grey = "off";
  std::string compression = "none";
  std::string file_gamma = "srgb";
  std::optional<int> bits; ///< none: as many as the format has anyway
};

void add_output_options(CLI::App& command, RenderRequest& request, OutputTexts& texts);

/// Returns the file that POV-Ray writes for a name that +O gives it: the extension is appended unless the
/// name ends with just this one; a dot at the end is dropped before; a name that ends with a slash is a
/// folder, for the scene's name. `extension` has a dot.
std::filesystem::path pov_output(const std::string& name, const std::filesystem::path& scene,
                                 const std::string& extension);

/// After the request's scene, model, region, antialiasing, animation and statistics are known. Throws
/// InputError for what a format cannot hold, and for what cannot go to stdout.
void finish_output(RenderRequest& request, const OutputTexts& texts);

} // namespace celltrace::cli
