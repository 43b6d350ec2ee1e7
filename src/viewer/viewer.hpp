// An interactive window on a scene.
#pragma once

#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace celltrace::viewer {

struct ViewOptions {
  std::filesystem::path scene;
  ParseOptions parse; ///< without its functions
  /// Width and height are the window's at first; antialiasing is for pictures at rest.
  RenderOptions render;
  std::filesystem::path font;  ///< TrueType; empty: one of the system's
  std::filesystem::path state; ///< a line of JSON for each change of what is seen; empty: none
  /// Pressed one after the other, each when the picture before is final: for demonstrations and tests. Names
  /// of keys as SDL has them, or WIDTHxHEIGHT, drag:X,Y, look:X,Y, click:X,Y and wheel:N.
  std::vector<std::string> keys;
};

/// Opens the window and stays in it until the user quits. Errors of the scene are shown and go to stderr.
/// Returns false if it could never be read. Throws Error where there is no display, InputError for options
/// that are unusable.
bool view(const ViewOptions& options);

} // namespace celltrace::viewer
