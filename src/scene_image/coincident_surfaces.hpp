// The order in which POV-Ray tests objects that share a surface, such as parts of two CSGs with the same
// shape at the same place. Crossings with such surfaces have equal distances, so that the object tested first
// is seen.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"
#include "scene_image/csg_parts.hpp"

#include <cstddef>
#include <vector>

namespace celltrace {

/// Returns the numbers of the first `count` objects of a scene in the order of POV-Ray's tests; `parts` are
/// the parts of the CSGs. This is the scene's order with CSGs behind the other objects, except that objects
/// come earlier if they have to be seen. Scenes with very many objects skip these exceptions. Sets in
/// `limits` which limits the scene passes.
std::vector<std::size_t> order_of_tests(const Scene& scene, const Eye& eye, std::size_t count,
                                        const CsgParts& parts, PassedLimits& limits);

/// Returns whether the scene's order may differ from the order of tests: true if there are CSGs and not very
/// many objects.
bool has_order_of_tests(std::size_t count, const CsgParts& parts);

} // namespace celltrace
