#include "cli/view_command.hpp"

#include "cli/scene_reading.hpp"
#include "viewer/viewer.hpp"

namespace celltrace::cli {

int run_view(const ViewRequest& request) {
  viewer::ViewOptions options;
  options.scene = request.render.scene;
  options.parse = parse_options(request.render, 0);
  options.render = request.render.options;
  options.font = request.font;
  options.state = request.state;
  options.keys = request.keys;
  viewer::view(options);
  return 0;
}

} // namespace celltrace::cli
