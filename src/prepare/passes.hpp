// The passes over a scene that single precision needs, in their order.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"

#include <optional>
#include <span>

namespace celltrace {

/// Returns the passes as they follow each other; passes.cpp says why. The scene's origin is chosen before all
/// of them (scene_origin.hpp), by the renderer, whose cameras and rays are moved with the scene.
std::span<const Pass> passes();

/// A scene after all passes.
class PreparedScene {
public:
  /// `scene` stays as it is as long as this lives.
  PreparedScene(const Scene& scene, const PassContext& context);

  const Scene& scene() const { return changed_ ? *changed_ : given_; }
  /// Returns how many objects are the scene's own; those behind them are projectors.
  std::size_t own_objects() const { return given_.objects.size(); }

private:
  const Scene& given_;
  std::optional<Scene> changed_; ///< none if no pass changes anything
};

} // namespace celltrace
