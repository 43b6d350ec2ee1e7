#include "cli/animation.hpp"

#include "celltrace/image.hpp"
#include "celltrace/render.hpp"
#include "cli/film.hpp"
#include "cli/frame_numbers.hpp"
#include "cli/frame_source.hpp"
#include "cli/interrupt.hpp"
#include "cli/output_files.hpp"
#include "cli/picture_job.hpp"
#include "cli/poster.hpp"
#include "cli/pov_report.hpp"
#include "cli/progress_line.hpp"
#include "cli/render_settings.hpp"
#include "cli/resume_state.hpp"
#include "cli/scene_reading.hpp"
#include "image/file.hpp"

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

namespace celltrace::cli {

namespace {

class AnimationRun {
public:
  explicit AnimationRun(const RenderRequest& request)
      : request_(request),
        frames_(request.animation.is_on() ? frames_to_render(request.animation) : std::vector<int>{0}),
        state_(is_film() ? std::filesystem::path() : request.output, settings_of(request)),
        line_(std::cerr, !request.quiet && stderr_is_terminal()),
        report_(std::cerr, report_parts(request, stderr_is_terminal())) {}

  int run() {
    catch_interrupts();
    interrupt_after(request_.most_seconds);
    if (!request_.output.empty() && !is_film()) check_image_path(request_.output, request_.format);
    if (request_.resume) leave_out_finished();
    if (frames_.empty()) {
      if (!request_.quiet) std::cerr << what() << ": all frames are finished already\n";
      return 0;
    }
    if (is_film()) film_ = open_film(request_.output, request_.film, request_.frame_rate);
    bool complete = false;
    try {
      complete = render_frames();
    } catch (...) {
      finish_film();
      throw;
    }
    line_.wipe();
    finish_film();
    if (complete && !request_.resume) state_.remove();
    if (!request_.stats.empty()) write_report(request_.stats, statistics_.dump(2) + "\n");
    if (!request_.quiet) print_summary(complete);
    return complete ? 0 : 2;
  }

private:
  bool is_film() const { return request_.film != FilmFormat::none; }
  std::filesystem::path picture(int frame) const {
    return request_.output.empty() ? request_.output : picture_of(request_.output, request_.animation, frame);
  }
  std::string what() const {
    if (request_.output.empty()) return "no pictures";
    if (is_film()) return request_.output == "-" ? "film" : request_.output.string();
    return picture(request_.animation.initial_frame).string() + "...";
  }

  void leave_out_finished() {
    state_.load();
    std::set<std::filesystem::path> files = state_.files();
    for (const int frame : frames_)
      files.insert(picture(frame));
    image::remove_abandoned_parts(files);
    const auto is_finished = [&](int frame) { return state_.has_frame(frame, picture(frame)); };
    const auto rest = std::remove_if(frames_.begin(), frames_.end(), is_finished);
    const std::ptrdiff_t finished = frames_.end() - rest;
    frames_.erase(rest, frames_.end());
    if (finished > 0 && !frames_.empty() && !request_.quiet)
      std::cerr << what() << ": " << finished << " frames are finished, " << frames_.size() << " to go\n";
  }

  /// Finishes a film that was stopped with the frames that it has.
  void finish_film() {
    if (film_ && done_ > 0) film_->finish();
  }

  /// Renders the frames. Returns false if it was interrupted.
  bool render_frames() {
    RunReports reports(request_);
    bool complete = true;
    try {
      RenderOptions options = request_.options;
      options.rows_at_once = rows_at_once(request_);
      reports.attach(options);
      FrameSource source(request_, options, frames_);
      while (complete && !source.is_at_end())
        complete = render(source, reports);
    } catch (const std::exception& error) {
      line_.wipe();
      reports.print_diagnostics(error.what());
      throw;
    }
    reports.print_diagnostics();
    reports.finish();
    return complete;
  }

  bool render(FrameSource& source, RunReports& reports) {
    report_.begin_frame(done_, frames_.size());
    report_.begin_parsing();
    FrameSource::Frame frame = source.take(last_.accelerator_bytes);
    print_messages(frame.messages);
    if (!frame.is_prepared || interrupted()) return false;
    if (done_ == 0 && !request_.resume) state_.remove();
    RowsFile kept = state_.rows_of(frame.number, frame.read.files);
    const std::filesystem::path file = is_film() ? std::filesystem::path() : picture(frame.number);
    line_.set_job("frame " + std::to_string(frame.number) + ", ");
    report_.begin_rendering(request_.options);
    const PictureOutcome result = render_picture(
        *frame.renderer, request_, file, kept, RowCosts(height_of(request_.options)),
        [&](double fraction) {
          report_.update(fraction);
          line_.update((static_cast<double>(done_) + fraction) / static_cast<double>(frames_.size()));
          return !interrupted();
        },
        [&](const Image& image) {
          if (film_) add_to_film(image);
        });
    report_.finish(result.statistics.render_seconds);
    reports.print_diagnostics();
    if (!result.complete) {
      is_frame_cut_ = true;
      return false;
    }
    state_.finish_frame(frame.number, file);
    ++done_;
    add_statistics(frame, result.statistics);
    return true;
  }

  void add_to_film(const Image& image) {
    try {
      film_->add(image);
    } catch (...) {
      film_.reset(); // nothing is left to finish
      throw;
    }
  }

  void print_messages(const std::string& messages) {
    // Prints messages only if they differ, as most frames have the same ones.
    if (request_.quiet || messages == messages_) return;
    line_.wipe();
    std::cerr << messages << std::flush;
    messages_ = messages;
  }

  void add_statistics(const FrameSource::Frame& frame, const RenderStatistics& statistics) {
    parse_seconds_ += frame.read.seconds;
    last_ = statistics;
    RenderStatistics sum = statistics;
    if (sum_) add_rows(sum, *sum_);
    sum_ = std::move(sum);
    if (request_.stats.empty()) return;
    nlohmann::ordered_json json = {{"frame", frame.number}};
    json["clock"] =
        request_.animation.is_on() ? clock_of(request_.animation, frame.number) : request_.clock.value_or(0);
    json.update(nlohmann::ordered_json::parse(to_json(statistics)));
    json["seconds"]["parse"] = frame.read.seconds;
    statistics_.push_back(std::move(json));
  }

  void print_summary(bool complete) const {
    if (sum_) print_warnings(*sum_);
    std::cerr << what() << ": " << (complete ? "" : std::string(interruption()) + ", ") << done_
              << (done_ == 1 ? " frame" : " frames");
    if (sum_)
      std::cerr << ", " << request_.options.width << 'x' << request_.options.height << ", "
                << summary_of(*sum_, parse_seconds_);
    std::cerr << '\n';
    if (complete || !state_.is_kept() || (done_ == 0 && !is_frame_cut_ && !request_.resume)) return;
    std::cerr << "missing frames: " << frames_.size() - done_
              << "; to finish, run the same command with --resume (+C)\n";
  }

  const RenderRequest& request_;
  std::vector<int> frames_; ///< numbers of the frames to render
  ResumeState state_;
  ProgressLine line_;
  PovReport report_;
  std::unique_ptr<Film> film_;
  std::size_t done_ = 0;      ///< number of frames
  bool is_frame_cut_ = false; ///< a frame was stopped between its first pixel and its last
  std::string messages_;      ///< printed last
  RenderStatistics last_;
  std::optional<RenderStatistics> sum_;
  double parse_seconds_ = 0;
  nlohmann::ordered_json statistics_ = nlohmann::ordered_json::array();
};

} // namespace

int run_animation(const RenderRequest& request) {
  return AnimationRun(request).run();
}

} // namespace celltrace::cli
