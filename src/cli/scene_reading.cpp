#include "cli/scene_reading.hpp"

#include "celltrace/error.hpp"
#include "celltrace/version.hpp"
#include "cli/declares.hpp"
#include "cli/interrupt.hpp"
#include "cli/povray_client.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <set>
#include <system_error>
#include <utility>

namespace celltrace::cli {

ParseOptions parse_options(const RenderRequest& request, int frame) {
  ParseOptions options;
  options.library_paths = request.library_paths;
  options.readable_folders = request.readable_folders;
  options.writable_folders = request.writable_folders;
  options.limits = request.limits;
  options.width = request.options.width;
  options.height = request.options.height;
  options.lenient = request.lenient;
  options.version = request.language_version;
  options.quality = request.options.quality;
  if (request.animation.is_on()) {
    options.clock = clock_of(request.animation, frame);
    options.frame = frame_of(request.animation, frame);
  } else {
    options.clock = static_cast<float>(request.clock.value_or(0)); // POV-Ray's precision
    options.frame.clock_on = request.clock.has_value();
  }
  for (const auto& [name, text] : request.declares)
    options.declares.emplace_back(name, declared_value(text));
  options.header = request.header;
  return options;
}

namespace {

/// Permits what POV-Ray does. Adds the files that the scene then may write to `written`.
void permit(ParseOptions& options, std::set<std::filesystem::path>& written) {
  std::vector<std::string> warnings;
  permit_as_povray(options, povray_places(), warnings);
  for (const std::string& warning : warnings)
    options.message("warning: " + warning + '\n');
  options.permits = [permits = std::move(options.permits), &written](const std::filesystem::path& file,
                                                                     FileUse use) {
    const bool yes = permits(file, use);
    if (yes && use == FileUse::write) written.insert(file);
    return yes;
  };
}

std::string text_of(double number) {
  char text[32];
  const auto end = std::to_chars(std::begin(text), std::end(text), number).ptr;
  return {text, end};
}

} // namespace

ReadScene read_scene(const RenderRequest& request, int frame,
                     const std::function<void(std::string_view)>& message,
                     const std::function<void(double fraction)>& progress) {
  const auto start = std::chrono::steady_clock::now();
  ReadScene read;
  ParseOptions options = parse_options(request, frame);
  options.message = message;
  options.progress = [&](std::uint64_t bytes, std::uint64_t total) {
    if (total > 0) progress(static_cast<double>(bytes) / static_cast<double>(total));
    return !interrupted();
  };
  std::set<std::filesystem::path> written;
  if (request.stands_in_for_povray) permit(options, written);
  options.reads_file = [&](const std::filesystem::path& path) {
    // What a scene writes itself, it writes anew.
    if (!request.writable_folders.empty() && !read.files.empty()) return;
    std::error_code error;
    if (!written.empty() && written.count(std::filesystem::canonical(path, error)) != 0) return;
    const auto known = [&](const auto& file) { return file.first == path.string(); };
    if (std::none_of(read.files.begin(), read.files.end(), known))
      read.files.emplace_back(path.string(), file_stamp(path));
  };
  try {
    read.scene = parse_file(request.scene, options);
  } catch (const Cancelled&) {
  }
  read.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return read;
}

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
  // A line for each.
  for (auto& [name, value] : settings)
    std::replace(value.begin(), value.end(), '\n', ' ');
  return settings;
}

} // namespace celltrace::cli
