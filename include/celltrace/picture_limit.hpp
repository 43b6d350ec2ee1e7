// Limits on the corrections that make pictures match POV-Ray's in spite of single precision.
#pragma once

#include "celltrace/export.hpp"

#include <cstdint>
#include <string>

namespace celltrace {

/// Limits on corrections for single precision. POV-Ray computes in double precision, the SPEs in single
/// precision. Where the difference would show, objects are compared with each other and moved a little before
/// records are made of them. Beyond a limit objects are not corrected, and the picture may differ from
/// POV-Ray's.
enum class PictureLimit : std::uint8_t {
  coplanar_objects,     ///< objects of a scene in which coplanar faces are put in order
  coplanar_comparisons, ///< pairs of coplanar faces that are compared
  coplanar_pairs,       ///< pairs of coplanar faces that overlap
  coplanar_layers,      ///< coplanar faces that lie on one another
  shallow_cuts,         ///< comparisons of subtracted CSG parts with the parts that they are subtracted from
  large_spheres,        ///< spheres to which the camera is near, compared with their size
  coincident_objects,   ///< objects of a scene in which coincident surfaces are put in order
  coincident_pairs,     ///< pairs of coincident surfaces
  far_camera_objects, ///< objects of a scene whose camera is far from what it shows, but among other objects
  camera_interiors    ///< interiors that the camera is inside of
};

/// Returns the largest number that `limit` allows.
constexpr std::uint64_t most_of(PictureLimit limit) {
  constexpr std::uint64_t kMost[] = {8192, 1 << 20, 1 << 16, 32, 1 << 22, 8, 4095, 1 << 16, 4096, 8};
  return kMost[static_cast<unsigned>(limit)];
}
/// Returns the limit's name in the statistics: "coplanar_pairs".
CELLTRACE_EXPORT const char* name_of(PictureLimit limit);
/// Returns a sentence for people that says what exceeds the limit: "more than 65536 pairs of ...".
CELLTRACE_EXPORT std::string text_of(PictureLimit limit);

} // namespace celltrace
