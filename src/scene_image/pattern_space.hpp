// The spaces that patterns are in, and the steps from one to the next.
#pragma once

#include "celltrace/scene.hpp"
#include "records/pattern.hpp"

#include <vector>

namespace celltrace {

kernel::TurbulenceWords words_of(const Turbulence& turbulence);

/// Of the maps around a pattern: what comes between its own space and the scene, or the surface. In no map
/// there is nothing.
struct PatternSpace {
  std::vector<SpaceStep> steps;
  bool uv_mapping = false;
  Transform of_normals; ///< with uv_mapping: from there to the scene

  bool is_scene() const { return steps.empty() && !uv_mapping; }
};

bool is_still(const Turbulence& turbulence);
/// Whether the turbulence of such a pattern moves the points that it is asked at.
bool is_moved_by_turbulence(const pattern::Kind& kind);

/// From a pattern's space to the scene, without displacements, as normals go through it.
Transform whole_map(const PatternSpace& space);
/// From the pattern's own space to the scene or the surface, for a pattern inside maps whose patterns are in
/// `outer`.
PatternSpace space_of(const Pattern& pattern, const PatternSpace& outer);
/// What the patterns inside a map are in, whose pattern is in `outer` itself.
PatternSpace space_inside(const Pattern& pattern, const PatternSpace& outer);

/// Returns the record of a step; a transformation is what its record's neighbours have.
kernel::SpaceStepRecord record_of(const SpaceStep& step);
bool reads_features(const kernel::SpaceStepRecord& step);

} // namespace celltrace
