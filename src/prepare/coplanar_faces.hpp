// Faces of several objects in one plane: which one is seen.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/eye.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace celltrace {

/// A scene in which faces of boxes and planes that lie in one plane, and overlap, are moved apart, by a few
/// millionths of their distance from the camera, so that the one is in front that POV-Ray shows. There
/// rounding is the same for all of them and the first one counts that is tested (BoundingTree); single
/// precision would show now the one and now the other. Boxes may be parts of a CSG: of faces of one
/// intersection that of the last part is seen. Of boxes that are cut out, as rooms are, only what transparent
/// things stand on is moved. Where such a thing is a cylinder or cone, it stands behind what is opaque.
/// Scenes of very many objects stay as they are.
class SceneWithFacesApart {
public:
  /// `scene` stays as it is as long as this lives. `material_flags`: those of objects that consist of a
  /// material.
  SceneWithFacesApart(const Scene& scene, const std::vector<std::uint32_t>& material_flags, const Eye& eye);

  const Scene& scene() const { return copy_ ? *copy_ : scene_; }
  bool has_moved() const { return copy_.has_value(); }

private:
  const Scene& scene_;
  std::optional<Scene> copy_; ///< none if no faces are in one plane
};

} // namespace celltrace
