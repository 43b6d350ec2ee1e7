// Reads scenes with Python's lock released.
#pragma once

#include "python/watch.hpp"

#include "celltrace/pov.hpp"

#include <string>

namespace celltrace {

/// A file, or a text.
struct SceneSource {
  std::string text; ///< text of the scene, or name of its file
  bool is_file = false;
};

/// Reads a scene. Called with the interpreter's lock, which it releases. `watch` gets the progress; if it
/// ends the job, Cancelled is thrown.
Scene read_scene(const SceneSource& source, ParseOptions options, Watch& watch);

} // namespace celltrace
