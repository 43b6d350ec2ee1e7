// Holes that are cut only a little deeper than what they are cut out of, and plates that are hardly thick.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/eye.hpp"

#include <optional>

namespace celltrace {

/// A scene in which the faces of what is cut out of a CSG that lie just beyond one of its faces, as people
/// put them so that a hole is open, lie a few millionths of their distance from the camera beyond it: in
/// single precision the two would else be one, and the hole closed. Faces are those of boxes, cylinders and
/// cones; CSGs may also have planes. Plates that are as thin, of CSGs that show what is inside of them, are
/// that thick: what lies on them would else be inside of them only here and there.
class SceneWithDeepCuts {
public:
  /// `scene` stays as it is as long as this lives.
  SceneWithDeepCuts(const Scene& scene, const Eye& eye);

  const Scene& scene() const { return copy_ ? *copy_ : scene_; }

private:
  const Scene& scene_;
  std::optional<Scene> copy_; ///< none if all cuts are deep enough
};

} // namespace celltrace
