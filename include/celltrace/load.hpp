// Scene files of any format, by the extensions of their names:
//
//   const Scene scene = load_scene("scene.pov");
#pragma once

#include "celltrace/pov.hpp"

#include <filesystem>

namespace celltrace {

/// Reads a scene in the format that the extension of `path` stands for, in upper or lower case. Any other
/// extension, or none, stands for POV-Ray's language: programs that call a renderer name temporary files as
/// they like. Throws what the format's reader throws, which parse_file() does for POV-Ray. Thread-safe.
CELLTRACE_EXPORT Scene load_scene(const std::filesystem::path& path, const ParseOptions& options = {});

} // namespace celltrace
