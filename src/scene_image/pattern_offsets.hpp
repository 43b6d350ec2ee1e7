// Patterns far from their own origins, in numbers that single precision has digits for.
#pragma once

#include "celltrace/texture.hpp"

#include <vector>

namespace celltrace {

/// A pattern, what is done to space before it is asked, and what is added to its numbers.
struct PlacedPattern {
  pattern::Kind kind;
  std::vector<SpaceStep> space;
  double phase;
};

/// Returns a pattern that has the same values where the scene is, and is asked nearer to its origin, if
/// `space` takes the scene's origin more than some thousand units away from it: by whole periods of it.
/// `pattern` says all but the space. Where nothing changes, the steps are those given.
PlacedPattern near_own_origin(const Pattern& pattern, const std::vector<SpaceStep>& space);

} // namespace celltrace
