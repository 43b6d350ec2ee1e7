// The order of objects in a scene image: neighbours in space are neighbours in memory.
#pragma once

#include <cstdint>
#include <vector>

namespace celltrace {

/// An object of the scene, at the double of the centre of its bounding box.
struct alignas(16) PlacedObject {
  float centre[3];
  std::uint32_t source; ///< its number
};

/// Where a scene has fewer objects, they keep its order.
constexpr std::uint32_t kMinObjectsToOrder = 4096;
/// A group has no more objects, unless nothing tells them apart.
constexpr std::uint32_t kMaxRun = 256;

/// Orders `count` objects along a Morton curve through the cells of a grid over their centres; cells with
/// many objects have grids of their own. Stable within a cell. `spare` has room for as many, `cells` for a
/// word each. Returns where the groups of objects in one cell begin, and `count` at last; what comes out does
/// not depend on the number of threads.
std::vector<std::uint32_t> order_along_curve(PlacedObject* objects, PlacedObject* spare, std::uint32_t* cells,
                                             std::uint32_t count, unsigned threads);

} // namespace celltrace
