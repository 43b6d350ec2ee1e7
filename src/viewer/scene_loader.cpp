#include "viewer/scene_loader.hpp"

#include "celltrace/error.hpp"
#include "celltrace/load.hpp"

#include <algorithm>
#include <exception>
#include <system_error>
#include <utility>

namespace celltrace::viewer {

SceneLoader::SceneLoader(std::filesystem::path scene, ParseOptions options, std::function<void()> notify)
    : scene_(std::move(scene)), options_(std::move(options)), notify_(std::move(notify)) {
  start();
}

SceneLoader::~SceneLoader() {
  quits_ = true;
  thread_.join();
}

SceneLoader::Watched SceneLoader::state_of(const std::filesystem::path& path) {
  // A file that vanishes for a moment, while an editor saves it, counts as another state.
  std::error_code none;
  Watched watched{path, std::filesystem::last_write_time(path, none), 0};
  watched.size = std::filesystem::file_size(path, none);
  return watched;
}

void SceneLoader::check_files() {
  {
    const std::lock_guard lock(mutex_);
    if (is_reading_) return;
    const bool changed = std::any_of(files_.begin(), files_.end(), [](const Watched& file) {
      return !(state_of(file.path) == file) && std::filesystem::exists(file.path);
    });
    if (!changed) return;
  }
  thread_.join();
  start();
}

std::optional<Loaded> SceneLoader::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(loaded_, std::nullopt);
}

void SceneLoader::start() {
  is_reading_ = true;
  thread_ = std::thread([this] { read(); });
}

void SceneLoader::read() {
  Loaded loaded;
  std::vector<Watched> files;
  ParseOptions options = options_;
  options.message = [&](std::string_view text) { loaded.warnings += text; };
  options.progress = [this](std::uint64_t, std::uint64_t) { return !quits_; };
  options.places_object = [&](Index object, const ObjectOrigin& origin) { loaded.names.add(object, origin); };
  options.reads_file = [&](const std::filesystem::path& path) { files.push_back(state_of(path)); };
  try {
    loaded.scene = std::make_shared<const Scene>(load_scene(scene_, options));
  } catch (const Cancelled&) {
  } catch (const std::exception& error) {
    loaded.error = error.what();
  }
  {
    const std::lock_guard lock(mutex_);
    files_ = std::move(files);
    is_reading_ = false;
    if (!quits_) loaded_ = std::move(loaded);
  }
  notify_();
}

} // namespace celltrace::viewer
