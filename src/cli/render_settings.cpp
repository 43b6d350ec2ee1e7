#include "cli/render_settings.hpp"

#include "celltrace/version.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <string>

namespace celltrace::cli {

namespace {

std::string text_of(double number) {
  char text[32];
  const auto end = std::to_chars(std::begin(text), std::end(text), number).ptr;
  return {text, end};
}

} // namespace

Settings settings_of(const RenderRequest& request) {
  const RenderOptions& options = request.options;
  Settings settings = {
      {"version", std::string("celltrace ") + version()},
      {"scene", std::filesystem::absolute(request.scene).string()},
      {"scene file", file_stamp(request.scene)},
      {"width", std::to_string(options.width)},
      {"height", std::to_string(options.height)},
      {"bits", std::to_string(request.bits)},
      {"format", std::to_string(static_cast<int>(request.format))},
      {"alpha", options.alpha ? "on" : "off"},
      {"colours", options.colours ? "on" : "off"},
      {"first hits", options.first_hits ? "on" : "off"},
      {"backend", name_of(options.backend)},
      {"simd", name_of(options.simd)},
      {"model", std::to_string(static_cast<int>(options.model))},
      {"accelerator", std::to_string(static_cast<int>(options.accelerator))},
      {"quality", std::to_string(options.quality)},
      {"lenient", request.lenient ? "on" : "off"},
  };
  const auto add = [&](const char* name, const std::string& value) { settings.emplace_back(name, value); };
  if (options.max_trace_level) add("max level", std::to_string(*options.max_trace_level));
  if (!request.header.empty()) add("header", std::filesystem::absolute(request.header).string());
  if (request.language_version) add("language version", text_of(*request.language_version));
  if (options.adc_bailout) add("adc", text_of(*options.adc_bailout));
  if (const auto& region = options.region)
    add("region", std::to_string(region->left) + '-' + std::to_string(region->right) + ' ' +
                      std::to_string(region->top) + '-' + std::to_string(region->bottom));
  if (const auto& antialiasing = options.antialiasing)
    add("antialiasing", "method " + std::to_string(static_cast<int>(antialiasing->method) + 1) +
                            " threshold " + text_of(antialiasing->threshold) + " depth " +
                            std::to_string(antialiasing->depth) + " jitter " + text_of(antialiasing->jitter) +
                            " gamma " + text_of(antialiasing->gamma));
  if (request.animation.is_on()) {
    const Animation& animation = request.animation;
    add("frames", std::to_string(animation.initial_frame) + '-' + std::to_string(animation.final_frame));
    add("clocks", text_of(animation.initial_clock) + " to " + text_of(animation.final_clock) +
                      (animation.cyclic ? ", cyclic" : ""));
  } else if (request.clock) {
    add("clock", text_of(*request.clock));
  }
  for (const auto& [name, value] : request.declares)
    add("declare", name + '=' + value);
  for (const auto& folder : request.library_paths)
    add("library", std::filesystem::absolute(folder).string());
  // Each setting is one line.
  for (auto& [name, value] : settings)
    std::replace(value.begin(), value.end(), '\n', ' ');
  return settings;
}

} // namespace celltrace::cli
