#include "picture_files.hpp"

#include <algorithm>

namespace celltrace::test {

namespace fs = std::filesystem;

std::vector<fs::path> scenes_in(const fs::path& folder) {
  std::vector<fs::path> scenes;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing))
    if (entry.path().extension() == ".pov") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

} // namespace celltrace::test
