// Limits to what is done so that a picture shows what POV-Ray shows.
#pragma once

#include "celltrace/export.hpp"

#include <cstdint>
#include <string>

namespace celltrace {

/// POV-Ray computes in double precision, the SPEs in single precision. Where that would show, objects are
/// compared with each other and moved a little before records are made of them, and there are limits to how
/// many are. Beyond a limit all is as it was, and a picture may differ from POV-Ray's.
enum class PictureLimit : std::uint8_t {
  coplanar_objects,     ///< objects of a scene in which faces in one plane are put in order
  coplanar_comparisons, ///< pairs of faces in one plane that are looked at
  coplanar_pairs,       ///< pairs of these that overlap
  coplanar_layers,      ///< faces in one plane that lie on one another
  shallow_cuts,         ///< comparisons of what is cut out with what it is cut out of
  large_spheres,        ///< spheres that the camera is near, for their size
  coincident_objects,   ///< objects of a scene in which surfaces that coincide are put in order
  coincident_pairs,     ///< pairs of surfaces that coincide
  far_camera_objects,   ///< objects that are looked at where the camera is far away, but among them
  camera_interiors      ///< interiors that the camera is inside of
};

/// Returns how many there may be before the rest is left as it is.
constexpr std::uint64_t most_of(PictureLimit limit) {
  constexpr std::uint64_t kMost[] = {8192, 1 << 20, 1 << 16, 32, 1 << 22, 8, 4095, 1 << 16, 4096, 8};
  return kMost[static_cast<unsigned>(limit)];
}
/// Returns the limit's name in the statistics: "coplanar_pairs".
CELLTRACE_EXPORT const char* name_of(PictureLimit limit);
/// Says what has passed the limit, and what that means for the picture: "more than 65536 pairs of ...".
CELLTRACE_EXPORT std::string text_of(PictureLimit limit);

} // namespace celltrace
