// The interface of the passes over a scene that single precision needs.
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

/// The limits that a scene passes.
using PassedLimits = std::set<PictureLimit>;

/// The things that passes are told besides the scene, and whom they tell of limits.
struct PassContext {
  const Eye& eye;
  std::span<const std::uint32_t> material_flags; ///< by material, the flags of objects that consist of it
  PassedLimits* limits = nullptr;                ///< null: nobody asks

  /// Says that the scene passes a limit.
  void pass(PictureLimit limit) const {
    if (limits != nullptr) limits->insert(limit);
  }
};

/// A pass returns the scene as it is to be, or nothing if it leaves all as it is.
using Pass = std::optional<Scene> (*)(const Scene& scene, const PassContext& context);

/// Returns the scene with the objects that `change(object)` returns in place of its own; nothing if it
/// returns none.
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
