// Moves patterns that are far from their own origins to where single precision has enough digits.
#pragma once

#include "celltrace/texture.hpp"

#include <vector>

namespace celltrace {

/// A pattern, the steps that points go through before it is evaluated, and its phase.
struct PlacedPattern {
  pattern::Kind kind;
  std::vector<SpaceStep> space;
  double phase;
};

/// Returns a pattern with the same values in the scene that is evaluated nearer to its own origin: if `space`
/// takes the scene's origin more than some thousand units away from there, the pattern is moved by whole
/// periods. `pattern` gives everything but the space. If nothing changes, the result has the steps of
/// `space`.
PlacedPattern near_own_origin(const Pattern& pattern, const std::vector<SpaceStep>& space);

} // namespace celltrace
