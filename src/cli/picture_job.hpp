// What rendering a picture and rendering an animation share.
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

/// The traces that a request asks for, and the diagnostics of what broke a rule.
class RunReports {
public:
  explicit RunReports(const RenderRequest& request);
  ~RunReports();

  /// Lets a renderer that these options make report here, which it does until it is gone.
  void attach(RenderOptions& options);
  /// Prints what an emulated machine found wrong since the last call. `error` is what is printed as the error
  /// anyway.
  void print_diagnostics(const std::string& error = {});
  void finish();

private:
  OutputFile events_, cache_;
  std::unique_ptr<CacheTraceWriter> cache_writer_;
  std::vector<Diagnostic> diagnostics_;
};

/// Result of rendering a picture.
struct PictureOutcome {
  RenderStatistics statistics; ///< of all that was rendered now
  bool complete = true;
  int rows_to_go = 0; ///< that a run which goes on has to render
};

/// Renders the scene that is prepared to `path`, which may be empty, but for the rows that `kept` has, and
/// adds others to these, `costs` saying how far it is. `renderer` has RenderOptions::rows_at_once as
/// rows_at_once() says. If `progress` breaks it off, the rest of the picture is blank. `use_image` is for
/// pictures that are complete and in memory whole.
PictureOutcome render_picture(Renderer& renderer, const RenderRequest& request,
                              const std::filesystem::path& path, RowsFile& kept, const RowCosts& costs,
                              const Progress& progress,
                              const std::function<void(const Image&)>& use_image = {});

/// To a file or, where `path` is kStandardOutput, to stdout. Of a picture that becomes blocks only now,
/// `statistics` get what these are worth.
void save_picture(const RenderRequest& request, const std::filesystem::path& path,
                  const PartialPicture& picture, RenderStatistics& statistics);

/// Says on standard error output why the picture may not be what the scene says: rays that were dropped, and
/// limits that the scene passes.
void print_warnings(const RenderStatistics& statistics);

/// "32x18, native.avx2, 2 SPEs; parse 0.01 s, build 0.00 s, render 0.02 s; 1.23 million rays/s"
std::string summary_of(const RenderStatistics& statistics, double parse_seconds);

} // namespace celltrace::cli
