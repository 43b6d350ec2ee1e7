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
  /// Options of rendering. Width and height are the window's initial size; antialiasing is for pictures at
  /// rest.
  RenderOptions render;
  std::filesystem::path font;  ///< TrueType; empty: one of the system's
  std::filesystem::path state; ///< file that gets a line of JSON for each change of the display; empty: none
  /// Steps to play one after the other, each when the picture before is final: for demonstrations and tests.
  /// Names of keys as SDL has them, or WIDTHxHEIGHT, drag:X,Y, look:X,Y, click:X,Y and wheel:N.
  std::vector<std::string> keys;
};

/// Opens the window and stays in it until the user quits. Errors of the scene are shown and go to stderr.
/// Returns false if the scene could never be read. Throws Error if there is no display, InputError for
/// options that are unusable.
bool view(const ViewOptions& options);

} // namespace celltrace::viewer
