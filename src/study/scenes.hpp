// The study's own scenes, from a few spheres to 100,000 triangles.
#pragma once

#include "celltrace/scene.hpp"

#include <string>
#include <vector>

namespace celltrace::study {

struct StudyScene {
  std::string name;
  std::string what; ///< one line of description
  Scene scene;
};

/// Returns `few`, `molecule`, `corner`, `cage`, `flake`, `terrain` and `mountains`, in this order. The same
/// on every machine.
std::vector<StudyScene> make_scenes();

} // namespace celltrace::study
