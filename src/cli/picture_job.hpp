// What rendering a picture and rendering an animation share.
#pragma once

#include "cli/command_line.hpp"
#include "cli/output_files.hpp"
#include "cli/partial_picture.hpp"
#include "cli/resume_state.hpp"

#include <chrono>
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

/// Keeps the rows of a picture now and then, while it is rendered.
class RowKeeper {
public:
  RowKeeper(ResumeState& state, int frame, const Settings& files, const PartialPicture& picture)
      : state_(state), frame_(frame), files_(files), picture_(picture) {}

  /// After some rows more. `at_once`: there will be no more.
  void save(bool at_once);

private:
  using Clock = std::chrono::steady_clock;

  ResumeState& state_;
  int frame_;
  const Settings& files_;
  const PartialPicture& picture_;
  Clock::time_point last_ = Clock::now();
};

/// To a file or, where `path` is kStandardOutput, to stdout. Of a picture that becomes blocks only now,
/// `statistics` get what these are worth.
void save_picture(const RenderRequest& request, const std::filesystem::path& path,
                  const PartialPicture& picture, RenderStatistics& statistics);

/// Says on standard error output if rays were dropped.
void print_dropped_rays(const RenderStatistics& statistics);

/// "32x18, native.avx2, 2 SPEs; parse 0.01 s, build 0.00 s, render 0.02 s; 1.23 million rays/s"
std::string summary_of(const RenderStatistics& statistics, double parse_seconds);

} // namespace celltrace::cli
