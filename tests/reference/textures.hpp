// Patterns without noise and the pigments that are made of them, in double precision, to compare with.
#pragma once

#include "celltrace/texture.hpp"

namespace celltrace::reference {

/// Where a pattern or a pigment is asked.
struct SurfacePoint {
  Vec3 at;
  Vec3 coordinates{0}; ///< u, v, 0 of the surface
  Vec3 normal{0};      ///< on the viewer's side
};

/// The number of a pattern at a point of its own space, without its wave. Throws std::logic_error of kinds
/// that are not among those here.
double number_of(const pattern::Kind& kind, const Vec3& p);
/// What a pattern's wave, frequency and phase make of a number.
double wave(const Pattern& pattern, double number);
/// Both.
double value_of(const Pattern& pattern, const SurfacePoint& p);

/// From the space around a pattern to its own, which has no turbulence in it.
Transform to_own_space(const Pattern& pattern);

/// The colour at a point, without a map.
Pigment pigment_at(const Pigment& pigment, const SurfacePoint& point);

} // namespace celltrace::reference
