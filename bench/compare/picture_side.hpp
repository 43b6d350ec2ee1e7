// celltrace on scene files: in this process for the trace time, as a program for the whole.
#pragma once

#include "celltrace/render.hpp"
#include "povray_side.hpp"

namespace celltrace::compare {

/// A scene file, read once and traced again and again.
class SceneFile {
public:
  /// Throws SceneError for what celltrace does not support.
  explicit SceneFile(const PictureRequest& request);
  /// What POV-Ray's trace time is compared with: it bounds meshes before that, as celltrace builds its grid.
  Seconds trace();

private:
  Renderer renderer_;
  Camera camera_;
};

/// Runs the program `celltrace` that was built with this one. Throws Error if it fails.
Seconds run_celltrace(const PictureRequest& request);

} // namespace celltrace::compare
