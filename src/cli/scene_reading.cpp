#include "cli/scene_reading.hpp"

#include "celltrace/error.hpp"
#include "celltrace/load.hpp"
#include "cli/declares.hpp"
#include "cli/interrupt.hpp"
#include "cli/povray_client.hpp"

#include <algorithm>
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

/// Permits what POV-Ray does. Adds the files that the scene may write to `written`.
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
    // Skips files that the scene itself writes: it writes them anew.
    if (!request.writable_folders.empty() && !read.files.empty()) return;
    std::error_code error;
    if (!written.empty() && written.count(std::filesystem::canonical(path, error)) != 0) return;
    const auto known = [&](const auto& file) { return file.first == path.string(); };
    if (std::none_of(read.files.begin(), read.files.end(), known))
      read.files.emplace_back(path.string(), file_stamp(path));
  };
  try {
    read.scene = load_scene(request.scene, options);
  } catch (const Cancelled&) {
  }
  read.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return read;
}

} // namespace celltrace::cli
