// Other programs, run to their end and timed.
#pragma once

#include "stopwatch.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace celltrace::compare {

struct ProcessResult {
  int exit_code = 0;
  Seconds seconds;    ///< from start to end, and of the processor as the kernel accounts it
  std::string output; ///< stdout and stderr
};

/// Runs `arguments[0]`, found on PATH, in `folder`. Throws Error if it cannot be started or is killed.
ProcessResult run(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

/// Where PATH finds a program.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// A new folder for temporary files, removed at the end.
class TemporaryFolder {
public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

} // namespace celltrace::compare
