// What a run leaves for one that goes on where it was stopped: beside the picture FILE, FILE.resume says by
// which settings it rendered and which frames are finished, and FILE.rows has the finished rows of the next
// one. Whenever the run ends, what was written by then counts.
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

/// What pictures depend on, by name. A text has no line breaks.
using Settings = std::vector<std::pair<std::string, std::string>>;

class ResumeState {
public:
  /// `output`: the picture, or that which the names of a film's pictures are made of. Empty, or no regular
  /// file: nothing is kept.
  ResumeState(const std::filesystem::path& output, Settings settings);

  /// What an earlier run left. Throws InputError if that had other settings.
  void load();
  bool has_frame(int frame, const std::filesystem::path& picture) const;
  /// Opens the rows of a frame that an earlier run left, to which those of this run are appended. Throws
  /// InputError if settings, or files that the frame is read from, are others than then.
  RowsFile rows_of(int frame, const Settings& files) const;

  /// Its picture is written. Its rows are not needed any more.
  void finish_frame(int frame, const std::filesystem::path& picture);
  /// All is done, and nobody is to go on.
  void remove();

  bool is_kept() const { return !journal_.empty(); }
  /// That it is kept in.
  std::set<std::filesystem::path> files() const {
    return is_kept() ? std::set{journal_, rows_} : std::set<std::filesystem::path>();
  }

private:
  void begin_journal();

  std::filesystem::path journal_, rows_; ///< empty: nothing is kept
  Settings settings_;
  std::map<int, std::uintmax_t> frames_; ///< finished ones, and how long their files are
  bool has_journal_ = false;             ///< of this run
};

/// How long a file is and when it was changed, for settings.
std::string file_stamp(const std::filesystem::path& path);

} // namespace celltrace::cli
