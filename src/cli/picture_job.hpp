// Functions shared by rendering a picture and rendering an animation.
#pragma once

#include "cli/command_line.hpp"
#include "cli/output_files.hpp"
#include "cli/partial_picture.hpp"
#include "cli/rows_file.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace celltrace {
class CacheTraceWriter;
}

namespace celltrace::cli {

/// The traces that a request asks for, and the diagnostics of broken rules.
class RunReports {
public:
  explicit RunReports(const RenderRequest& request);
  ~RunReports();

  /// Makes a renderer with these options report here, as long as it lives.
  void attach(RenderOptions& options);
  /// Prints the emulated machine's diagnostics since the last call, except for `error`, which is printed as
  /// the error anyway.
  void print_diagnostics(const std::string& error = {});
  void finish();

private:
  OutputFile events_, cache_;
  std::unique_ptr<CacheTraceWriter> cache_writer_;
  std::vector<Diagnostic> diagnostics_;
};

struct PictureOutcome {
  RenderStatistics statistics; ///< statistics of everything rendered now
  bool complete = true;
  int rows_to_go = 0; ///< rows that a continued run has to render
};

/// Renders the prepared scene to `path`, which may be empty. Rows in `kept` are not rendered again, and new
/// rows are added to it; `costs` determines the progress. `renderer` has RenderOptions::rows_at_once as
/// rows_at_once() returns it. If `progress` stops the rendering, the rest of the picture is blank.
/// `use_image` is called for pictures that are complete and completely in memory.
PictureOutcome render_picture(Renderer& renderer, const RenderRequest& request,
                              const std::filesystem::path& path, RowsFile& kept, const RowCosts& costs,
                              const Progress& progress,
                              const std::function<void(const Image&)>& use_image = {});

/// Saves a picture to a file or, if `path` is kStandardOutput, to stdout. If the picture is encoded in blocks
/// only now, `statistics` get the quality of the blocks.
void save_picture(const RenderRequest& request, const std::filesystem::path& path,
                  const PartialPicture& picture, RenderStatistics& statistics);

/// Prints on stderr why the picture may differ from the scene: dropped rays, and limits that the scene
/// passes.
void print_warnings(const RenderStatistics& statistics);

/// Returns a line such as "32x18, native.avx2, 2 SPEs; parse 0.01 s, build 0.00 s, render 0.02 s; 1.23
/// million rays/s".
std::string summary_of(const RenderStatistics& statistics, double parse_seconds);

} // namespace celltrace::cli
