#include "cli/frame_numbers.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace celltrace::cli {

namespace {

/// Returns POV-Ray's final_frame, which in a cyclic animation is one more than there is.
int last_number(const Animation& animation) {
  return animation.final_frame + (animation.cyclic ? 1 : 0);
}

float clock_step(const Animation& animation) {
  const int steps = last_number(animation) - animation.initial_frame;
  if (steps == 0) return 0;
  return (static_cast<float>(animation.final_clock) - static_cast<float>(animation.initial_clock)) /
         static_cast<float>(steps);
}

/// Returns a frame, given as its number or as a fraction of final_frame, in POV-Ray's precision.
int frame_at(double value, const Animation& animation, const char* option) {
  if (value > kMaxFrame)
    throw InputError(std::string(option) + ": frames are numbered up to " + std::to_string(kMaxFrame));
  const float frame = value < 1 ? static_cast<float>(value) * static_cast<float>(animation.final_frame)
                                : static_cast<float>(value);
  return static_cast<int>(frame);
}

} // namespace

std::vector<int> frames_to_render(const Animation& animation) {
  int first = animation.initial_frame, last = animation.final_frame;
  if (animation.start_frame)
    first = std::max(first, frame_at(*animation.start_frame, animation, "--start-frame"));
  if (animation.end_frame) last = frame_at(*animation.end_frame, animation, "--end-frame");
  last = std::max(first, last);
  std::vector<int> frames;
  for (int frame = first; frame <= last; frame += animation.step)
    frames.push_back(frame);
  return frames;
}

double clock_of(const Animation& animation, int frame) {
  return static_cast<float>(animation.initial_clock) +
         static_cast<float>(frame - animation.initial_frame) * clock_step(animation);
}

AnimationFrame frame_of(const Animation& animation, int frame) {
  AnimationFrame facts;
  facts.clock_on = true;
  facts.number = frame;
  facts.initial_number = animation.initial_frame;
  facts.final_number = last_number(animation);
  facts.initial_clock = animation.initial_clock;
  facts.final_clock = animation.final_clock;
  char digits[32];
  std::snprintf(digits, sizeof digits, "%g", static_cast<double>(clock_step(animation)));
  facts.clock_delta = std::strtod(digits, nullptr);
  return facts;
}

std::filesystem::path picture_of(const std::filesystem::path& output, const Animation& animation, int frame) {
  if (!animation.is_on()) return output;
  const std::size_t width = std::to_string(last_number(animation)).size();
  std::string number = std::to_string(frame);
  number.insert(0, width - std::min(width, number.size()), '0');
  return output.parent_path() / (output.stem().string() + number + output.extension().string());
}

} // namespace celltrace::cli
