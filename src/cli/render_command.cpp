#include "cli/render_command.hpp"

#include "celltrace/image.hpp"
#include "celltrace/render.hpp"
#include "cli/animation.hpp"
#include "cli/interrupt.hpp"
#include "cli/output_files.hpp"
#include "cli/picture_job.hpp"
#include "cli/pov_report.hpp"
#include "cli/progress_line.hpp"
#include "cli/scene_reading.hpp"
#include "image/file.hpp"

#include <chrono>
#include <csignal>
#include <iostream>
#include <set>

#include <nlohmann/json.hpp>

namespace celltrace::cli {

namespace {

/// Of a still picture, as POV-Ray numbers it.
constexpr int kStill = 0;

ReadScene read_with_progress(const RenderRequest& request) {
  ProgressLine line(std::cerr, !request.quiet && stderr_is_terminal(), "reading ",
                    std::chrono::milliseconds(500));
  return read_scene(
      request, kStill,
      [&](std::string_view text) {
        if (request.quiet) return;
        line.wipe();
        std::cerr << text;
      },
      [&](double fraction) { line.update(fraction); });
}

/// What of `picture` is missing.
RenderResult render_with_progress(const ReadScene& read, const RenderRequest& request, RunReports& reports,
                                  PovReport& report, ResumeState& state, PartialPicture& picture) {
  const bool visible = !request.quiet && stderr_is_terminal();
  ProgressLine building(std::cerr, visible, "building ", std::chrono::milliseconds(500));
  RenderOptions options = request.options;
  reports.attach(options);
  options.build_progress = [&building](double fraction) {
    building.update(fraction);
    if (fraction >= 1) building.wipe();
    return !interrupted();
  };
  Renderer renderer(options);
  if (!renderer.prepare(*read.scene)) return renderer.render(*read.scene); // which is broken off, too
  ProgressLine line(std::cerr, visible);
  RowKeeper keeper(state, kStill, read.files, picture);
  report.begin_rendering(options);
  return render_remaining(
      renderer, options, picture,
      [&](double fraction) {
        line.update(fraction);
        report.update(fraction);
        return !interrupted();
      },
      [&] { keeper.save(interrupted()); });
}

void write_statistics(const std::string& where, const RenderStatistics& statistics, double parse_seconds) {
  auto json = nlohmann::ordered_json::parse(to_json(statistics));
  json["seconds"]["parse"] = parse_seconds;
  write_report(where, json.dump(2) + "\n");
}

} // namespace

int run_render(const RenderRequest& request) {
  if (request.animation.is_on() || request.film != FilmFormat::none) return run_animation(request);
  if (request.output == kStandardOutput) {
    check_standard_output_is_open();
    std::signal(SIGPIPE, SIG_IGN); // a reader that is gone is an error like others
  } else if (!request.output.empty()) {
    check_image_path(request.output, request.format);
  }
  catch_interrupts();
  const std::string name = request.output.empty()              ? "no picture"
                           : request.output == kStandardOutput ? "standard output"
                                                               : request.output.string();
  ResumeState state(request.output, settings_of(request));
  if (request.resume) {
    state.load();
    std::set<std::filesystem::path> files = state.files();
    files.insert(request.output);
    image::remove_abandoned_parts(files);
    if (state.has_frame(kStill, request.output)) {
      if (!request.quiet) std::cerr << name << ": finished already\n";
      return 0;
    }
  }
  PovReport report(std::cerr, report_parts(request, stderr_is_terminal()));
  report.begin_parsing();
  const ReadScene read = read_with_progress(request);
  if (!read.scene || interrupted()) {
    std::cerr << "interrupted before the first pixel\n";
    return 2;
  }
  PartialPicture picture(request.options);
  if (!request.resume)
    state.remove();
  else if (state.load_rows(kStill, read.files, picture) && !request.quiet)
    std::cerr << name << ": " << picture.missing_rows() << " of " << picture.height() << " rows to go\n";

  RunReports reports(request);
  RenderResult result;
  try {
    result = render_with_progress(read, request, reports, report, state, picture);
  } catch (const std::exception& error) {
    reports.print_diagnostics(error.what());
    throw;
  }
  report.finish(result.statistics.render_seconds);
  reports.print_diagnostics();
  if (!request.output.empty()) save_picture(request, request.output, picture, result.statistics);
  if (result.complete && request.resume)
    state.finish_frame(kStill, request.output);
  else if (result.complete)
    state.remove();
  reports.finish();
  if (!request.stats.empty()) write_statistics(request.stats, result.statistics, read.seconds);
  if (!request.quiet) {
    const RenderStatistics& s = result.statistics;
    print_dropped_rays(s);
    std::cerr << name << ": " << (result.complete ? "" : "interrupted, partial, ") << s.width << 'x'
              << picture.height() << ", " << summary_of(s, read.seconds) << '\n';
    if (!result.complete && state.is_kept() && !picture.is_empty())
      std::cerr << "the same command with +C goes on with the " << picture.missing_rows()
                << " rows that are missing\n";
  }
  return result.complete ? 0 : 2;
}

} // namespace celltrace::cli
