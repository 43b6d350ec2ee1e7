#include "pov/standard_includes.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "pov/sources.hpp"

namespace celltrace::pov {

namespace {

/// The names in alphabetical order.
constexpr std::string_view kNames[] = {
    "arrays.inc",   "ash.map",      "benediti.map",  "bubinga.map",  "bumpmap_.png",  "cedar.map",
    "chars.inc",    "colors.inc",   "consts.inc",    "crystal.ttf",  "cyrvetic.ttf",  "debug.inc",
    "finish.inc",   "fract003.png", "functions.inc", "glass.inc",    "glass_old.inc", "golds.inc",
    "ior.inc",      "logo.inc",     "makegrass.inc", "marbteal.map", "math.inc",      "meshmaker.inc",
    "metals.inc",   "mount1.png",   "mount2.png",    "mtmandj.png",  "orngwood.map",  "pinkmarb.map",
    "plasma2.png",  "plasma3.png",  "povlogo.ttf",   "povmap.png",   "rad_def.inc",   "rand.inc",
    "rdgranit.map", "screen.inc",   "shapes.inc",    "shapes2.inc",  "shapes3.inc",   "shapes_old.inc",
    "shapesq.inc",  "skies.inc",    "spiral.df3",    "stage1.inc",   "stars.inc",     "stdcam.inc",
    "stdinc.inc",   "stoneold.inc", "stones.inc",    "stones1.inc",  "stones2.inc",   "strings.inc",
    "sunpos.inc",   "teak.map",     "test.png",      "textures.inc", "timrom.ttf",    "transforms.inc",
    "whiteash.map", "woodmaps.inc", "woods.inc",
};

bool is_name_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Returns whether `#declare` or `#macro` stands in front of the name anywhere in the text.
bool declares(std::string_view text, std::string_view name) {
  for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if (end < text.size() && is_name_letter(text[end])) continue;
    std::string_view before = text.substr(0, at);
    const std::size_t last = before.find_last_not_of(" \t");
    if (last == before.npos || last + 1 == at) continue;
    before = before.substr(0, last + 1);
    for (const std::string_view directive : {"#declare", "#macro"})
      if (before.size() >= directive.size() && before.substr(before.size() - directive.size()) == directive)
        return true;
  }
  return false;
}

} // namespace

bool is_standard_include(std::string_view name) {
  const auto is_name = [name](std::string_view other) {
    return std::equal(name.begin(), name.end(), other.begin(), other.end(),
                      [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
  };
  return std::any_of(std::begin(kNames), std::end(kNames), is_name);
}

std::string include_that_declares(std::string_view name) {
  for (const char* const folder : installed_include_folders())
    for (const std::string_view include : kNames) {
      std::ifstream file(std::filesystem::path(folder) / include, std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      if (declares(text, name)) return std::string(include);
    }
  return "";
}

} // namespace celltrace::pov
