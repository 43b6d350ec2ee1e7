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
#include "cli/render_settings.hpp"
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

/// The frame number of a still picture, as in POV-Ray.
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

/// Saves the kept rows of a picture that was stopped before its scene was ready.
PictureOutcome save_kept(Renderer& renderer, const RenderRequest& request, const Scene& scene,
                         RowsFile& kept) {
  PartialPicture picture(request.options);
  picture.take(kept);
  RenderStatistics statistics = renderer.render(scene).statistics; // stopped at once, too
  if (!request.output.empty()) save_picture(request, request.output, picture, statistics);
  return {statistics, false, picture.missing_rows()};
}

/// Renders the missing rows of the picture, and writes it. Returns nothing if no pixel is finished.
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
  if (visible && request.most_seconds == 0) // a time limit leaves no time for measuring
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

void write_statistics(const std::string& where, const RenderStatistics& statistics, double parse_seconds) {
  auto json = nlohmann::ordered_json::parse(to_json(statistics));
  json["seconds"]["parse"] = parse_seconds;
  write_report(where, json.dump(2) + "\n");
}

/// A still picture from its scene file to its own file, continuing an interrupted run if there is one.
class StillPicture {
public:
  explicit StillPicture(const RenderRequest& request)
      : request_(request), state_(request.output, settings_of(request)),
        report_(std::cerr, report_parts(request, stderr_is_terminal())) {}

  /// Loads the rows of an earlier run. Returns whether the picture is finished.
  bool resume() {
    state_.load();
    std::set<std::filesystem::path> files = state_.files();
    files.insert(request_.output);
    image::remove_abandoned_parts(files);
    return state_.has_frame(kStill, request_.output);
  }
  /// Returns whether there is a scene to render.
  bool parse() {
    report_.begin_parsing();
    read_ = read_with_progress(request_);
    return read_.scene && !interrupted();
  }
  /// Renders and saves the picture. Returns whether any pixel is finished.
  bool render() {
    interrupt_after(request_.most_seconds);
    if (!request_.resume) state_.remove();
    RowsFile kept = state_.rows_of(kStill, read_.files);
    if (kept.count() > 0)
      say(std::to_string(height() - kept.count()) + " of " + std::to_string(height()) + " rows to go");
    reports_.emplace(request_);
    try {
      outcome_ = render_with_progress(read_, request_, *reports_, report_, kept);
    } catch (const std::exception& error) {
      reports_->print_diagnostics(error.what());
      throw;
    }
    report_.finish(outcome_ ? outcome_->statistics.render_seconds : 0);
    reports_->print_diagnostics();
    if (outcome_ && outcome_->complete) forget_progress();
    return outcome_.has_value();
  }
  /// Writes and prints reports on the picture. Returns whether it is complete.
  bool report() {
    reports_->finish();
    const RenderStatistics& statistics = outcome_->statistics;
    if (!request_.stats.empty()) write_statistics(request_.stats, statistics, read_.seconds);
    if (request_.quiet) return outcome_->complete;
    print_warnings(statistics);
    const std::string partial = outcome_->complete ? "" : std::string(interruption()) + ", partial, ";
    say(partial + std::to_string(statistics.width) + 'x' + std::to_string(height()) + ", " +
        summary_of(statistics, read_.seconds));
    if (!outcome_->complete && state_.is_kept() && outcome_->rows_to_go < height())
      std::cerr << "missing rows: " << outcome_->rows_to_go
                << "; to finish, run the same command with --resume (+C)\n";
    return outcome_->complete;
  }

  /// Prints a line about the picture, unless the run is quiet.
  void say(const std::string& text) const {
    if (request_.quiet) return;
    std::cerr << (request_.output.empty()              ? "no picture"
                  : request_.output == kStandardOutput ? "standard output"
                                                       : request_.output.string())
              << ": " << text << '\n';
  }

private:
  int height() const { return height_of(request_.options); }
  void forget_progress() {
    if (request_.resume)
      state_.finish_frame(kStill, request_.output);
    else
      state_.remove();
  }

  const RenderRequest& request_;
  ResumeState state_;
  PovReport report_;
  std::optional<RunReports> reports_; ///< made by render(): a scene that cannot be read leaves no reports
  ReadScene read_;
  std::optional<PictureOutcome> outcome_;
};

int interrupted_early() {
  std::cerr << interruption() << " before the first pixel\n";
  return 2;
}

void check_output(const RenderRequest& request) {
  if (request.output == kStandardOutput)
    check_standard_output_is_open();
  else if (!request.output.empty())
    check_image_path(request.output, request.format);
}

} // namespace

int run_render(const RenderRequest& request) {
  if (request.animation.is_on() || request.film != FilmFormat::none) return run_animation(request);
  check_output(request);
  catch_interrupts();
  StillPicture picture(request);
  if (request.resume && picture.resume()) {
    picture.say("finished already");
    return 0;
  }
  if (!picture.parse() || !picture.render()) return interrupted_early();
  return picture.report() ? 0 : 2;
}

} // namespace celltrace::cli
