// POV-Ray's solid noise in double precision, on the host: what the language computes with it.
#pragma once

#include "celltrace/transform.hpp"

namespace celltrace {

/// Three coordinates, about 0.
Vec3 noise_vector(const Vec3& p);
/// Octaves of it, each `lambda` times finer and `omega` times weaker than the one before.
Vec3 turbulence_vector(const Vec3& p, int octaves, double lambda, double omega);
/// In 0..1. Generators 1 and 2 are POV-Ray's; number 3, its gradient noise, too.
double noise_value(const Vec3& p, int generator);

} // namespace celltrace
