// POV-Ray's solid noise in double precision on the host, for the scene language.
#pragma once

#include "celltrace/transform.hpp"

namespace celltrace {

/// Returns noise with three components, distributed about 0.
Vec3 noise_vector(const Vec3& p);
/// Returns the sum of octaves of noise_vector(), each `lambda` times finer and `omega` times weaker than the
/// octave before.
Vec3 turbulence_vector(const Vec3& p, int octaves, double lambda, double omega);
/// Returns noise from 0 to 1 of one of POV-Ray's generators 1 to 3; generator 3 is gradient noise.
double noise_value(const Vec3& p, int generator);

} // namespace celltrace
