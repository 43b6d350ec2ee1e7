// The interface of the passes that prepare a scene for single precision.
#pragma once

#include "celltrace/picture_limit.hpp"
#include "celltrace/scene.hpp"
#include "prepare/eye.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace celltrace {

using PassedLimits = std::set<PictureLimit>;

/// The inputs of passes besides the scene, and the set to which passes add limits.
struct PassContext {
  const Eye& eye;
  std::span<const std::uint32_t> material_flags; ///< index: material; flags of objects that consist of it
  PassedLimits* limits = nullptr;                ///< null if limits are not needed

  /// Records that the scene passes a limit.
  void pass(PictureLimit limit) const {
    if (limits != nullptr) limits->insert(limit);
  }
};

/// A pass over a scene: returns the changed scene, or nothing if it changes nothing.
using Pass = std::optional<Scene> (*)(const Scene& scene, const PassContext& context);

/// Returns the scene with each object replaced for which `change(object)` returns a new object; nothing if
/// there is no new object.
template <class Change> std::optional<Scene> with_objects_changed(const Scene& scene, const Change& change) {
  std::optional<Scene> copy;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    std::optional<Object> object = change(scene.objects[i]);
    if (!object) continue;
    if (!copy) copy = scene;
    copy->objects[i] = *std::move(object);
  }
  return copy;
}

} // namespace celltrace
