#include "picture_side.hpp"

#include "celltrace/error.hpp"
#include "celltrace/pov.hpp"
#include "process.hpp"

namespace celltrace::compare {

namespace {

RenderOptions options_of(const PictureRequest& request) {
  RenderOptions options;
  options.width = request.width;
  options.height = request.height;
  options.spes = request.threads;
  return options;
}

} // namespace

SceneFile::SceneFile(const PictureRequest& request) : renderer_(options_of(request)) {
  ParseOptions parse;
  parse.width = request.width;
  parse.height = request.height;
  parse.message = [](std::string_view) {};
  const Scene scene = parse_file(request.scene, parse);
  camera_ = scene.camera;
  renderer_.render(scene);
}

Seconds SceneFile::trace() {
  const Stopwatch stopwatch;
  const double wall = renderer_.render(camera_).statistics.render_seconds;
  return {wall, stopwatch.elapsed().processor};
}

Seconds run_celltrace(const PictureRequest& request) {
  const ProcessResult result =
      run({CELLTRACE_PROGRAM, "render", request.scene.filename().string(), "-o", request.picture.string(),
           "-W", std::to_string(request.width), "-H", std::to_string(request.height), "--spes",
           std::to_string(request.threads), "--quiet"},
          request.scene.parent_path());
  if (result.exit_code != 0) throw Error("celltrace fails: " + result.output);
  return result.seconds;
}

} // namespace celltrace::compare
