#include "prepare/passes.hpp"

#include "prepare/coplanar_faces.hpp"
#include "prepare/deep_cuts.hpp"
#include "prepare/large_spheres.hpp"
#include "prepare/projectors.hpp"

#include <utility>

namespace celltrace {

std::span<const Pass> passes() {
  static constexpr Pass kPasses[] = {
      // Comes first, because faces are compared where they end up: a shallow cut is moved farther than faces
      // of one plane are, and may come to lie in the plane of another object's face, or leave that plane.
      deepen_cuts,
      move_faces_apart,
      // Spheres have no faces, so that this pass could also come earlier. Later passes find quadrics in place
      // of some spheres.
      centre_large_spheres,
      // Comes last: rays do not see projectors, so that other passes should neither spend time on projectors
      // nor move faces because of them.
      add_projectors,
  };
  return kPasses;
}

PreparedScene::PreparedScene(const Scene& scene, const PassContext& context) : given_(scene) {
  for (const Pass pass : passes())
    if (std::optional<Scene> changed = pass(this->scene(), context)) changed_ = std::move(changed);
}

} // namespace celltrace
