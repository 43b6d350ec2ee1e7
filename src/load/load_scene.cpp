#include "celltrace/load.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <string>

namespace celltrace {

namespace {

using Reader = Scene (*)(const std::filesystem::path&, const ParseOptions&);

/// A row of the table of formats: an extension in lower case, and the function that reads such files. Add a
/// row for each further format.
struct Format {
  const char* extension;
  Reader read;
};
constexpr Format kFormats[] = {
    {".pov", parse_file},
    {".inc", parse_file},
};

Reader reader_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto* const format = std::find_if(std::begin(kFormats), std::end(kFormats),
                                          [&](const Format& each) { return extension == each.extension; });
  return format != std::end(kFormats) ? format->read : parse_file;
}

} // namespace

Scene load_scene(const std::filesystem::path& path, const ParseOptions& options) {
  return reader_of(path)(path, options);
}

} // namespace celltrace
