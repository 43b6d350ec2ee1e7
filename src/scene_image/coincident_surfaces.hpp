// The order in which POV-Ray tests objects that share a surface: parts of two CSGs with the same shape at the
// same place. Both crossings round alike, so that the object tested first is seen.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/pass.hpp"
#include "scene_image/csg_parts.hpp"

#include <cstddef>
#include <vector>

namespace celltrace {

/// Returns the numbers of the first `count` objects of a scene in the order of POV-Ray's tests; `parts` are
/// the parts of the CSGs. The order is the scene's with CSGs behind the others, except for objects that have
/// to come earlier so that they are seen. Scenes with very many objects skip these exceptions. Sets in
/// `limits` which limits the scene passes.
std::vector<std::size_t> order_of_tests(const Scene& scene, const Eye& eye, std::size_t count,
                                        const CsgParts& parts, PassedLimits& limits);

/// Returns whether an object may have to come earlier: there are CSGs, and not very many objects.
bool has_order_of_tests(std::size_t count, const CsgParts& parts);

} // namespace celltrace
