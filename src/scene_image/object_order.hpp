// The order of objects in a scene image: neighbours in space are neighbours in memory.
#pragma once

#include <cstdint>
#include <vector>

namespace celltrace {

/// An object, and twice the centre of its bounding box.
struct alignas(16) PlacedObject {
  float centre[3];
  std::uint32_t source; ///< the object's number
};

/// Least number of objects that are ordered along a curve; scenes with fewer objects keep their order.
constexpr std::uint32_t kMinObjectsToOrder = 4096;
/// Limit on objects in a group, unless all of them are at one place.
constexpr std::uint32_t kMaxRun = 256;

/// Orders `count` objects along a Morton curve through the cells of a grid over their centres; cells with
/// many objects have grids of their own. The order within a cell is stable. `spare` has room for `count`
/// objects, `cells` for a word per object. Returns the indices where the groups of objects in one cell begin,
/// followed by `count`; the result does not depend on the number of threads.
std::vector<std::uint32_t> order_along_curve(PlacedObject* objects, PlacedObject* spare, std::uint32_t* cells,
                                             std::uint32_t count, unsigned threads);

} // namespace celltrace
