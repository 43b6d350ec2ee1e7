// The spaces in which patterns are evaluated, and the steps from one to the next.
#pragma once

#include "celltrace/scene.hpp"
#include "records/pattern.hpp"

#include <vector>

namespace celltrace {

kernel::TurbulenceWords words_of(const Turbulence& turbulence);

/// The steps from a pattern's own space to the scene, or to the surface, which the maps around the pattern
/// add; empty if no map is around it.
struct PatternSpace {
  std::vector<SpaceStep> steps;
  bool uv_mapping = false;
  Transform of_normals; ///< with uv_mapping: transformation from that space to the scene

  bool is_scene() const { return steps.empty() && !uv_mapping; }
};

bool is_still(const Turbulence& turbulence);
/// Returns whether the turbulence of such a pattern moves the points at which it is evaluated.
bool is_moved_by_turbulence(const pattern::Kind& kind);

/// Returns the transformation from a pattern's space to the scene as it applies to normals, without
/// displacements.
Transform whole_map(const PatternSpace& space);
/// Returns the space of a pattern inside maps whose patterns are in `outer`.
PatternSpace space_of(const Pattern& pattern, const PatternSpace& outer);
/// Returns the space of the patterns inside a map whose own pattern is in `outer`.
PatternSpace space_inside(const Pattern& pattern, const PatternSpace& outer);

/// Returns the record of a step; the record of a transformation stands for all neighbouring ones.
kernel::SpaceStepRecord record_of(const SpaceStep& step);
bool reads_features(const kernel::SpaceStepRecord& step);

} // namespace celltrace
