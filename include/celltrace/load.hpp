// Loading of scene files of any format, by the extensions of their names:
//
//   const Scene scene = load_scene("scene.pov");
#pragma once

#include "celltrace/pov.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace celltrace {

/// Reads a scene in the format that the extension of `path` stands for, in upper or lower case. Any other
/// extension, or none, stands for POV-Ray's language, because programs that call a renderer name temporary
/// files as they like. Throws what the format's reader throws (see parse_file() for POV-Ray). Thread-safe.
CELLTRACE_EXPORT Scene load_scene(const std::filesystem::path& path, const ParseOptions& options = {});

/// A format that load_scene() reads.
struct SceneFormat {
  std::string name;                    ///< "POV-Ray"
  std::vector<std::string> extensions; ///< in lower case, with their dots
};

/// Returns all formats. The first one is used for names with other extensions.
CELLTRACE_EXPORT std::vector<SceneFormat> scene_formats();

} // namespace celltrace
