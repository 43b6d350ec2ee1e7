// Indices of the interior records of objects. Rays tell objects apart by these records, so that an object
// without an interior has a record of its own, behind the records of the scene's interiors.
#pragma once

#include "celltrace/scene.hpp"

#include <cstddef>

namespace celltrace {

/// Returns the index of the record of an object without an interior; `object` is its index in the scene.
inline Index own_interior(const Scene& scene, std::size_t object) {
  return static_cast<Index>(scene.interiors.size() + object);
}

/// Returns the index of the record of a part: `interior` if the part has one, else the record of the whole
/// object.
inline Index interior_or_own(Index interior, const Scene& scene, std::size_t whole) {
  if (interior != kNoIndex) return interior;
  const Index shared = scene.objects[whole].interior;
  return shared != kNoIndex ? shared : own_interior(scene, whole);
}

std::size_t interior_records(const Scene& scene);

} // namespace celltrace
