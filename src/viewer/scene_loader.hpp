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

/// The result of reading.
struct Loaded {
  std::shared_ptr<const Scene> scene; ///< null: it could not be read
  ObjectNames names;                  ///< names of its objects
  std::string error;                  ///< set if there is no scene
  std::string warnings;
};

/// Loads and watches a scene. Thread safety: for one thread.
class SceneLoader {
public:
  /// Begins to read. The reading thread calls `notify` whenever take() has something. `options` are
  /// those of parse_file(), except its functions.
  SceneLoader(std::filesystem::path scene, ParseOptions options, std::function<void()> notify);
  /// Cancels reading.
  ~SceneLoader();
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  /// Checks whether a file of the scene was written since it was read, and reads it again then. Cheap: call
  /// it several times a second.
  void check_files();
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
  std::mutex mutex_; ///< guards the next three members
  std::optional<Loaded> loaded_;
  std::vector<Watched> files_;
  bool is_reading_ = false;
  std::atomic<bool> quits_ = false;
  std::thread thread_;
};

} // namespace celltrace::viewer
