// The options of `render` for the picture's file.
#pragma once

#include "cli/command_line.hpp"

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

/// Texts that CLI11 fills in besides the request.
struct OutputTexts {
  std::string file_type; ///< empty: by the extension
  std::string pov_name;  ///< name of the picture by POV-Ray's rule; used if RenderRequest::output is empty
  std::string picture = "on";
  std::string alpha = "off";
  std::string first_hits = "off";
  std::string grey = "off";
  std::string compression = "none";
  std::string file_gamma = "srgb";
  std::optional<int> bits; ///< none: the format's default
};

void add_output_options(CLI::App& command, RenderRequest& request, OutputTexts& texts);

/// Returns the file that POV-Ray writes for a name given to +O: the extension is appended unless the name
/// ends with exactly this one; a dot at the end is dropped first; a name that ends with a slash is a folder,
/// for the scene's name. `extension` includes the dot.
std::filesystem::path pov_output(const std::string& name, const std::filesystem::path& scene,
                                 const std::string& extension);

/// Completes the output, after the request's scene, model, region, antialiasing, animation and statistics are
/// known. Throws InputError for pictures that a format cannot hold, and for output that cannot go to stdout.
void finish_output(RenderRequest& request, const OutputTexts& texts);

} // namespace celltrace::cli
