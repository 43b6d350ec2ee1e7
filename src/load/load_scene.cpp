#include "celltrace/load.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace celltrace {

namespace {

/// A format, its extensions with a blank after each, and its reader. Another format is one more row.
struct Row {
  const char* name;
  std::string_view extensions;
  Scene (*read)(const std::filesystem::path&, const ParseOptions&);
};
constexpr Row kRows[] = {
    {"POV-Ray", ".pov .inc ", parse_file},
};

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

const Row& row_of(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string()) + ' ';
  const auto* const row = std::find_if(std::begin(kRows), std::end(kRows), [&](const Row& each) {
    return extension.size() > 1 && each.extensions.find(extension) != std::string_view::npos;
  });
  return row != std::end(kRows) ? *row : kRows[0];
}

} // namespace

Scene load_scene(const std::filesystem::path& path, const ParseOptions& options) {
  return row_of(path).read(path, options);
}

std::vector<SceneFormat> scene_formats() {
  std::vector<SceneFormat> formats;
  for (const Row& row : kRows) {
    formats.push_back({row.name, {}});
    for (std::string_view left = row.extensions; !left.empty(); left.remove_prefix(left.find(' ') + 1))
      formats.back().extensions.emplace_back(left.substr(0, left.find(' ')));
  }
  return formats;
}

} // namespace celltrace
