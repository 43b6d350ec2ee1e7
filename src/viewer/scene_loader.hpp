// Reads a scene in a thread of its own, and again when its files change.
#pragma once

#include "celltrace/pov.hpp"
#include "viewer/object_names.hpp"

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace celltrace::viewer {

/// What has come of reading it.
struct Loaded {
  std::shared_ptr<const Scene> scene; ///< null: it could not be read
  ObjectNames names;                  ///< of its objects
  std::string error;                  ///< then
  std::string warnings;
};

/// Thread safety: for one thread.
class SceneLoader {
public:
  /// Begins to read. `notify` is called by the reading thread whenever take() has something. `options` are
  /// those of parse_file(), but for its functions.
  SceneLoader(std::filesystem::path scene, ParseOptions options, std::function<void()> notify);
  /// Breaks off what is under way.
  ~SceneLoader();
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  /// Looks whether a file of the scene was written since it was read; if so reads it again. Cheap: call it
  /// several times a second.
  void look();
  std::optional<Loaded> take();

private:
  struct Watched {
    std::filesystem::path path;
    std::filesystem::file_time_type time;
    std::uintmax_t size;
    bool operator==(const Watched&) const = default;
  };

  static Watched state_of(const std::filesystem::path& path);
  void start();
  void read();

  const std::filesystem::path scene_;
  ParseOptions options_;
  const std::function<void()> notify_;
  std::mutex mutex_; ///< of the next three
  std::optional<Loaded> loaded_;
  std::vector<Watched> files_;
  bool is_reading_ = false;
  std::atomic<bool> quits_ = false;
  std::thread thread_;
};

} // namespace celltrace::viewer
