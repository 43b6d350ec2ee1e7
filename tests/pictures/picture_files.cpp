#include "picture_files.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

#include <unistd.h>

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

std::optional<Image> pov_ray_picture(const fs::path& scene) {
  const fs::path beside = fs::path(scene).replace_extension(".png");
  if (fs::exists(beside)) return load_image(beside);
  if (std::system("command -v povray >/dev/null 2>&1") != 0) return std::nullopt;
  const fs::path out = fs::temp_directory_path() /
                       ("celltrace-" + std::to_string(getpid()) + "-" + scene.stem().string() + ".png");
  const std::string command = "cd '" + scene.parent_path().string() + "' && povray '+I" +
                              scene.filename().string() + "' '+O" + out.string() +
                              "' +W640 +H480 -A -D +FN8 -J >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0) return std::nullopt;
  Image picture = load_image(out);
  fs::remove(out);
  return picture;
}

} // namespace celltrace::test
