#include "povray_side.hpp"

#include "celltrace/error.hpp"
#include "process.hpp"

#include <regex>

namespace celltrace::compare {

namespace {

/// POV-Ray prints "Trace Time: 0 hours 0 minutes 4 seconds (4.621 seconds)" and on the next line
/// "using 1 thread(s) with 1.740 CPU-seconds total".
Seconds trace_time(const std::string& output) {
  static const std::regex pattern(
      R"(Trace Time:[^(]*\(([0-9.]+) seconds\)\s*using \d+ thread\(s\) with ([0-9.]+))");
  std::smatch match;
  if (!std::regex_search(output, match, pattern)) throw Error("POV-Ray printed no trace time: " + output);
  return {std::stod(match[1]), std::stod(match[2])};
}

} // namespace

std::optional<std::string> povray_version() {
  if (!find_program("povray")) return std::nullopt;
  const std::string output = run({"povray", "--version"}, ".").output;
  std::smatch match;
  static const std::regex pattern(R"(POV-Ray (\d[0-9.]*\d))");
  return std::regex_search(output, match, pattern) ? match[0].str() : "POV-Ray";
}

PictureTimes render_with_povray(const PictureRequest& request) {
  // POV-Ray may only read in the current folder, which also is where its scenes look for their includes.
  const ProcessResult result =
      run({"povray", "+I" + request.scene.filename().string(), "+O" + request.picture.string(),
           "+W" + std::to_string(request.width), "+H" + std::to_string(request.height),
           "+WT" + std::to_string(request.threads), "-A", "-D", "+FN8"},
          request.scene.parent_path());
  if (result.exit_code != 0) throw Error("POV-Ray fails: " + result.output);
  return {result.seconds, trace_time(result.output)};
}

} // namespace celltrace::compare
