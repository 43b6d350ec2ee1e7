// The spaces in which patterns are evaluated, and the steps from one to the next.
#pragma once

#include "celltrace/scene.hpp"
#include "records/pattern.hpp"

#include <vector>

namespace celltrace {

kernel::TurbulenceWords words_of(const Turbulence& turbulence);

/// The space of the maps around a pattern: the steps from there to the scene, or to surface coordinates.
/// There are no steps if no map is around the pattern.
struct PatternSpace {
  std::vector<SpaceStep> steps;
  bool uv_mapping = false;
  Transform of_normals; ///< if uv_mapping: transformation of normals to the scene

  bool is_scene() const { return steps.empty() && !uv_mapping; }
};

bool is_still(const Turbulence& turbulence);
/// Returns whether the turbulence of a pattern of this kind moves the points at which it is evaluated.
bool is_moved_by_turbulence(const pattern::Kind& kind);

/// Returns the transformation from a pattern's space to the scene as it applies to normals, without
/// displacements.
Transform whole_map(const PatternSpace& space);
/// Returns the space of a pattern; `outer` is the space of the maps around it.
PatternSpace space_of(const Pattern& pattern, const PatternSpace& outer);
/// Returns the space of the patterns inside a pattern's map; `outer` is the space of the maps around it.
PatternSpace space_inside(const Pattern& pattern, const PatternSpace& outer);

/// Returns the record of a step. Transformations have no record: neighbouring records hold them.
kernel::SpaceStepRecord record_of(const SpaceStep& step);
bool reads_features(const kernel::SpaceStepRecord& step);

} // namespace celltrace
