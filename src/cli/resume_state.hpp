// The state from which a stopped run can be continued: beside the picture FILE, FILE.resume has the settings
// and the finished frames, and FILE.rows the finished rows of the next frame. Everything written by the time
// a run ends counts.
#pragma once

#include "cli/rows_file.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace celltrace::cli {

/// The settings that pictures depend on, by name. Texts have no line breaks.
using Settings = std::vector<std::pair<std::string, std::string>>;

class ResumeState {
public:
  /// `output` is the picture, or the name from which those of an animation's pictures are derived. If it is
  /// empty, or no regular file, nothing is kept.
  ResumeState(const std::filesystem::path& output, Settings settings);

  /// Loads the state of an earlier run. Throws InputError if that run had other settings.
  void load();
  bool has_frame(int frame, const std::filesystem::path& picture) const;
  /// Opens the rows of a frame from an earlier run, to which this run's are appended. Throws InputError if
  /// settings, or files from which the frame is read, have changed.
  RowsFile rows_of(int frame, const Settings& files) const;

  /// Records that the frame's picture is written, so that its rows are no longer needed.
  void finish_frame(int frame, const std::filesystem::path& picture);
  /// Removes the state, since everything is done.
  void remove();

  bool is_kept() const { return !journal_.empty(); }
  /// Returns the files of the state.
  std::set<std::filesystem::path> files() const {
    return is_kept() ? std::set{journal_, rows_} : std::set<std::filesystem::path>();
  }

private:
  void begin_journal();

  std::filesystem::path journal_, rows_; ///< empty if nothing is kept
  Settings settings_;
  std::map<int, std::uintmax_t> frames_; ///< finished frames, and the sizes of their files in bytes
  bool has_journal_ = false;             ///< this run has written its journal
};

/// Returns a file's size and the time of its last change, for settings.
std::string file_stamp(const std::filesystem::path& path);

} // namespace celltrace::cli
