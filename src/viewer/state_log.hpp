// Writes the state of a window as lines of JSON, for other programs.
#pragma once

#include "viewer/information.hpp"
#include "viewer/object_names.hpp"

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace celltrace::viewer {

struct State {
  Situation situation;
  const Frame* frame = nullptr;
  std::string backend;
  Model model = Model::shared;
  std::string error, message, screenshot;
  bool information = false, strips = false, costs = false, help = false, full_screen = false;
  bool antialiasing = false, is_final = false;
  int width = 0, height = 0; ///< size of the window
  double latency = 0;        ///< seconds
  double seconds = 0;        ///< seconds since the start
  std::optional<Camera> camera;
  std::optional<Picked> picked;
  const ObjectNames* names = nullptr; ///< names of the objects that may have been picked
  std::string hint;
  std::size_t help_pages = 0;
};

class StateLog {
public:
  /// Opens the file; an empty path writes nothing. Throws InputError if the file cannot be written.
  explicit StateLog(const std::filesystem::path& file);

  bool is_open() const { return out_.is_open(); }
  /// Writes a line; docs/viewer.md describes the keys.
  void write(const State& state);

private:
  std::ofstream out_;
};

} // namespace celltrace::viewer
