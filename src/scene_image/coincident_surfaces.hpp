// The order in which POV-Ray tests objects that have a surface in common: parts of two CSGs that are of one
// shape at one place. There rounding is the same for both, and the one is seen that is tested first.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"
#include "scene_image/csg_parts.hpp"

#include <cstddef>
#include <vector>

namespace celltrace {

/// Numbers of the first `count` objects of a scene, of which `parts` are the CSGs': in the scene's order,
/// CSGs behind the others, but for those that have to come before others so that they are seen. Not if there
/// are very many: then their order does not matter.
/// Says which limits the scene passes.
std::vector<std::size_t> order_of_tests(const Scene& scene, const Eye& eye, std::size_t count,
                                        const CsgParts& parts, PassedLimits& limits);

/// Whether any may have to come before others: there are CSGs, and not very many objects.
bool has_order_of_tests(std::size_t count, const CsgParts& parts);

} // namespace celltrace
