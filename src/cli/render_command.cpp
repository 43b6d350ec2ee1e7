#include "cli/render_command.hpp"

#include "celltrace/image.hpp"
#include "celltrace/render.hpp"
#include "cli/animation.hpp"
#include "cli/interrupt.hpp"
#include "cli/output_files.hpp"
#include "cli/partial_picture.hpp"
#include "cli/picture_job.hpp"
#include "cli/poster.hpp"
#include "cli/pov_report.hpp"
#include "cli/progress_line.hpp"
#include "cli/resume_state.hpp"
#include "cli/scene_reading.hpp"
#include "image/file.hpp"

#include <chrono>
#include <iostream>
#include <optional>
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

/// A picture that was broken off before its scene was ready: it has the rows that are kept.
PictureOutcome save_kept(Renderer& renderer, const RenderRequest& request, const Scene& scene,
                         RowsFile& kept) {
  PartialPicture picture(request.options);
  picture.take(kept);
  RenderStatistics statistics = renderer.render(scene).statistics; // which is broken off, too
  if (!request.output.empty()) save_picture(request, request.output, picture, statistics);
  return {statistics, false, picture.missing_rows()};
}

/// Renders what is missing of the picture, and writes it. None: there is not a pixel of it.
std::optional<PictureOutcome> render_with_progress(const ReadScene& read, const RenderRequest& request,
                                                   RunReports& reports, PovReport& report, RowsFile& kept) {
  const bool visible = !request.quiet && stderr_is_terminal();
  ProgressLine building(std::cerr, visible, "building ", std::chrono::milliseconds(500));
  RenderOptions options = request.options;
  options.rows_at_once = rows_at_once(request);
  reports.attach(options);
  options.build_progress = [&building](double fraction) {
    building.update(fraction);
    if (fraction >= 1) building.wipe();
    return !interrupted();
  };
  Renderer renderer(options);
  if (!renderer.prepare(*read.scene)) {
    if (options.rows_at_once != 0) return std::nullopt;
    return save_kept(renderer, request, *read.scene, kept);
  }
  RowCosts costs(height_of(options));
  std::optional<RenderStatistics> preparation;
  if (visible && request.most_seconds == 0) // else there is no time to lose
    costs = measured_costs(
        renderer, options, [](double) { return !interrupted(); }, preparation);
  ProgressLine line(std::cerr, visible);
  report.begin_rendering(options);
  PictureOutcome outcome =
      render_picture(renderer, request, request.output, kept, costs, [&](double fraction) {
        line.update(fraction);
        report.update(fraction);
        return !interrupted();
      });
  if (preparation) take_preparation(outcome.statistics, *preparation);
  return outcome;
}

int interrupted_early() {
  std::cerr << interruption() << " before the first pixel\n";
  return 2;
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
  if (!read.scene || interrupted()) return interrupted_early();
  interrupt_after(request.most_seconds);
  if (!request.resume) state.remove();
  RowsFile kept = state.rows_of(kStill, read.files);
  const int height = height_of(request.options);
  if (kept.count() > 0 && !request.quiet)
    std::cerr << name << ": " << height - kept.count() << " of " << height << " rows to go\n";

  RunReports reports(request);
  std::optional<PictureOutcome> rendered;
  try {
    rendered = render_with_progress(read, request, reports, report, kept);
  } catch (const std::exception& error) {
    reports.print_diagnostics(error.what());
    throw;
  }
  report.finish(rendered ? rendered->statistics.render_seconds : 0);
  reports.print_diagnostics();
  if (!rendered) return interrupted_early();
  const PictureOutcome& outcome = *rendered;
  if (outcome.complete && request.resume)
    state.finish_frame(kStill, request.output);
  else if (outcome.complete)
    state.remove();
  reports.finish();
  if (!request.stats.empty()) write_statistics(request.stats, outcome.statistics, read.seconds);
  if (!request.quiet) {
    const RenderStatistics& s = outcome.statistics;
    print_warnings(s);
    std::cerr << name << ": " << (outcome.complete ? "" : std::string(interruption()) + ", partial, ")
              << s.width << 'x' << height << ", " << summary_of(s, read.seconds) << '\n';
    if (!outcome.complete && state.is_kept() && outcome.rows_to_go < height)
      std::cerr << "the same command with +C goes on with the " << outcome.rows_to_go
                << " rows that are missing\n";
  }
  return outcome.complete ? 0 : 2;
}

} // namespace celltrace::cli
