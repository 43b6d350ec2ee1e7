// Spheres that are so large beside their distance that single precision would not do.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/eye.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace celltrace {

/// A scene in which such spheres, planets under a camera's feet, are quadrics about the point of their
/// surface that is nearest to the camera. What rays are measured from is near then; from the middle of a
/// sphere the digits of its radius would be missing from all distances. Spheres whose materials ask for
/// surface coordinates stay as they are, as a quadric has others; so do inverse and clipped ones, and those
/// behind the first few.
class SceneWithLargeSpheres {
public:
  /// `scene` stays as it is as long as this lives. `material_flags`: those of objects that consist of a
  /// material.
  SceneWithLargeSpheres(const Scene& scene, const std::vector<std::uint32_t>& material_flags, const Eye& eye);

  const Scene& scene() const { return copy_ ? *copy_ : scene_; }

private:
  const Scene& scene_;
  std::optional<Scene> copy_; ///< none if there are no such spheres
};

} // namespace celltrace
