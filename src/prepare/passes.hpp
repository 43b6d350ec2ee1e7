// The passes that prepare a scene for single precision, in their order.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"

#include <optional>
#include <span>

namespace celltrace {

/// Returns the passes in their order; passes.cpp gives the reasons. The renderer chooses the scene's origin
/// before all of them (scene_origin.hpp), since its cameras and rays move with the scene.
std::span<const Pass> passes();

/// A scene after all passes.
class PreparedScene {
public:
  /// Runs the passes. `scene` must not change while this object lives.
  PreparedScene(const Scene& scene, const PassContext& context);

  const Scene& scene() const { return changed_ ? *changed_ : given_; }
  /// Returns the number of the given scene's own objects; the objects after them are projectors.
  std::size_t own_objects() const { return given_.objects.size(); }

private:
  const Scene& given_;
  std::optional<Scene> changed_; ///< nothing if no pass changes anything
};

} // namespace celltrace
