#include "pov/standard_includes.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace celltrace::pov {

namespace {

/// In alphabetical order.
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

} // namespace

bool is_standard_include(std::string_view name) {
  const auto is_name = [name](std::string_view other) {
    return std::equal(name.begin(), name.end(), other.begin(), other.end(),
                      [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
  };
  return std::any_of(std::begin(kNames), std::end(kNames), is_name);
}

} // namespace celltrace::pov
