// What lights are projected through, beside the scene's own objects.
#pragma once

#include "celltrace/scene.hpp"

#include <optional>

namespace celltrace {

/// A scene to whose objects the projectors of its lights are added, in the order of the lights. They have no
/// meshes: triangles are polygons.
class SceneWithProjectors {
public:
  /// `scene` stays as it is as long as this lives. Throws InputError if a mesh is a part of a projector's
  /// CSG, or of what clips it.
  explicit SceneWithProjectors(const Scene& scene);

  const Scene& scene() const { return copy_ ? *copy_ : scene_; }
  /// How many objects are the scene's own; those behind them are projectors.
  std::size_t own_objects() const { return scene_.objects.size(); }

private:
  const Scene& scene_;
  std::optional<Scene> copy_; ///< none if no light has a projector
};

} // namespace celltrace
