// Reads scene files; the extension of a file's name decides its format:
//
//   const Scene scene = load_scene("scene.pov");
#pragma once

#include "celltrace/pov.hpp"

#include <filesystem>

namespace celltrace {

/// Reads a scene in the format that the extension of `path` stands for, in upper or lower case. An unknown
/// extension, or none, stands for POV-Ray's language, because programs that call a renderer name temporary
/// files as they like. Throws the exceptions of the format's reader: for POV-Ray, those of parse_file().
/// Thread-safe.
CELLTRACE_EXPORT Scene load_scene(const std::filesystem::path& path, const ParseOptions& options = {});

} // namespace celltrace
