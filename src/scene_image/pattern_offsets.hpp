// Moves patterns that are far from their own origins to where single precision has enough digits.
#pragma once

#include "celltrace/texture.hpp"

#include <vector>

namespace celltrace {

/// A pattern, the steps that points go through before it is evaluated, and what is added to its values.
struct PlacedPattern {
  pattern::Kind kind;
  std::vector<SpaceStep> space;
  double phase;
};

/// Returns a pattern that has the same values in the scene, but is evaluated nearer to its origin if `space`
/// takes the scene's origin more than some thousand units away from it: the pattern is moved by whole
/// periods. `pattern` gives everything but the space. If nothing changes, the steps are those of `space`.
PlacedPattern near_own_origin(const Pattern& pattern, const std::vector<SpaceStep>& space);

} // namespace celltrace
