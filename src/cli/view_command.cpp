#include "cli/view_command.hpp"

#include "cli/scene_reading.hpp"
#include "cli/unreadable_file.hpp"
#include "viewer/viewer.hpp"

namespace celltrace::cli {

int run_view(const ViewRequest& request) {
  // A scene with errors may be corrected while its window is open; a wrong name may not.
  std::error_code none;
  const std::filesystem::path& scene = request.render.scene;
  if (!std::filesystem::exists(scene, none) || std::filesystem::is_directory(scene, none))
    throw unreadable(scene);
  viewer::ViewOptions options;
  options.scene = request.render.scene;
  options.parse = parse_options(request.render, 0);
  options.render = request.render.options;
  options.font = request.font;
  options.state = request.state;
  options.keys = request.keys;
  return viewer::view(options) ? 0 : 1;
}

} // namespace celltrace::cli
