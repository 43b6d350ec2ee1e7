#include "cli/animation_options.hpp"

#include "celltrace/error.hpp"
#include "cli/choice.hpp"
#include "cli/declares.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

namespace celltrace::cli {

namespace {

/// Reads an integer from the front of a text and removes it.
bool take_number(std::string_view& text, unsigned& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

FrameRate parse_frame_rate(const std::string& text) {
  constexpr unsigned kMost = 1'000'000;
  FrameRate rate;
  std::string_view rest = text;
  bool valid = take_number(rest, rate.frames);
  if (valid && !rest.empty()) {
    valid = rest[0] == '/';
    rest.remove_prefix(1);
    valid = valid && take_number(rest, rate.seconds) && rest.empty();
  }
  if (!valid || rate.frames == 0 || rate.seconds == 0 || rate.frames > kMost || rate.seconds > kMost)
    throw InputError("--frame-rate: '" + text +
                     "' is neither a whole number nor a fraction such as 30000/1001");
  return rate;
}

/// Takes the clock of +Declare=clock=X, since `clock` is a word of the language itself.
void take_declared_clock(RenderRequest& request) {
  for (auto declare = request.declares.begin(); declare != request.declares.end();) {
    if (declare->first != "clock") {
      ++declare;
      continue;
    }
    const auto value = declared_value(declare->second);
    const double* const number = std::get_if<double>(&value);
    if (!number) throw InputError("--declare: the clock has to be a number, not '" + declare->second + "'");
    request.clock = *number;
    declare = request.declares.erase(declare);
  }
}

} // namespace

void add_animation_options(CLI::App& command, RenderRequest& request, AnimationTexts& texts) {
  Animation& animation = request.animation;
  const CLI::Range frames(0, kMaxFrame);
  command.add_option("--clock", request.clock, "The clock of a still picture; default: 0");
  command
      .add_option("--initial-frame", texts.initial_frame, "Number of an animation's first frame; default: 1")
      ->check(frames);
  command
      .add_option("--final-frame", texts.final_frame,
                  "Number of an animation's last frame; without it and --initial-frame the picture is still")
      ->check(frames);
  command.add_option("--initial-clock", animation.initial_clock, "The clock in the first frame")
      ->capture_default_str();
  command.add_option("--final-clock", animation.final_clock, "The clock in the last frame")
      ->capture_default_str();
  add_choice(command, "--cyclic", texts.cyclic, {{"on", "off"}, {}},
             "Whether the animation loops: the last frame leads into the first");
  command
      .add_option("--start-frame", animation.start_frame,
                  "The first frame to render: its number or, below 1, a fraction of the final frame's number")
      ->check(number_range(0, std::numeric_limits<double>::infinity()))
      ->type_name("N|FRACTION");
  command
      .add_option("--end-frame", animation.end_frame, "The last frame to render, given as for --start-frame")
      ->check(number_range(0, std::numeric_limits<double>::infinity()))
      ->type_name("N|FRACTION");
  command.add_option("--frame-step", animation.step, "Render only every N-th frame")
      ->check(CLI::Range(1, kMaxFrame))
      ->capture_default_str();
  command.add_option("--frame-rate", texts.frame_rate, "Frames per second of a film")
      ->type_name("N|N/M")
      ->capture_default_str();
  command.add_flag("--resume", request.resume, "Finish what a stopped run with the same options began");
}

void set_frames(Animation& animation, const AnimationTexts& texts) {
  const int initial = texts.initial_frame.value_or(0), final = texts.final_frame.value_or(0);
  if (initial == final && initial <= 1) return;
  animation.initial_frame = texts.initial_frame.value_or(1);
  animation.final_frame = std::max(animation.initial_frame, final);
  animation.has_one_frame = animation.initial_frame == animation.final_frame;
}

void finish_animation(RenderRequest& request, const AnimationTexts& texts) {
  Animation& animation = request.animation;
  animation.cyclic = texts.cyclic == "on";
  take_declared_clock(request);
  if (request.clock) check_number(*request.clock, "--clock");
  check_number(animation.initial_clock, "--initial-clock");
  check_number(animation.final_clock, "--final-clock");
  if (animation.start_frame) check_number(*animation.start_frame, "--start-frame");
  if (animation.end_frame) check_number(*animation.end_frame, "--end-frame");
  if (animation.is_on()) frames_to_render(animation);
  request.frame_rate = parse_frame_rate(texts.frame_rate);
  if (request.film == FilmFormat::none) return;
  if (request.bits != 8) throw InputError("a film has 8 bits a channel");
  if (request.resume)
    throw InputError("a film cannot be resumed: render pictures, and make a film of them in the end");
}

} // namespace celltrace::cli
