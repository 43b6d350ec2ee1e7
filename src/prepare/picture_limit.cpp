#include "celltrace/picture_limit.hpp"

namespace celltrace {

namespace {

/// The name and the message of a limit. The message has the number between `before` and `after`.
struct LimitText {
  const char* name;
  const char* before;
  const char* after;
};

constexpr LimitText kTexts[] = {
    {"coplanar_objects", "the scene has more than ",
     " objects: where several faces lie in one plane, rounding says which one is seen"},
    {"coplanar_comparisons", "more than ",
     " pairs of faces in one plane are near each other: rounding says which of the rest are seen"},
    {"coplanar_pairs", "more than ",
     " pairs of faces in one plane overlap: rounding says which of the rest are seen"},
    {"coplanar_layers", "more than ",
     " faces in one plane lie on one another, or they do in circles: rounding says which one is seen"},
    {"shallow_cuts", "the CSG takes more than ",
     " comparisons of faces: holes that are hardly deeper than what they are cut out of may stay closed"},
    {"large_spheres", "the camera is very near the surfaces of more than ",
     " spheres for their size: surfaces of the rest are rough"},
    {"coincident_objects", "the scene has more than ",
     " objects: of surfaces that coincide another one may be seen than in POV-Ray"},
    {"coincident_pairs", "more than ",
     " pairs of surfaces coincide: of the rest another one may be seen than in POV-Ray"},
    {"far_camera_objects",
     "the camera is far away from what it shows, and among objects that are instances of meshes or more "
     "than ",
     ": what is seen may be rough"},
    {"camera_interiors", "the camera is inside of more than ",
     " objects with interiors: the outermost ones do not count"},
};

const LimitText& text(PictureLimit limit) {
  return kTexts[static_cast<unsigned>(limit)];
}

} // namespace

const char* name_of(PictureLimit limit) {
  return text(limit).name;
}

std::string text_of(PictureLimit limit) {
  return text(limit).before + std::to_string(most_of(limit)) + text(limit).after;
}

} // namespace celltrace
