// Models of any number of primitives, the same at every run.
#pragma once

#include "model.hpp"

namespace celltrace::compare {

/// A hilly surface, tessellated into at least `triangles` with shared vertices.
Model hills(std::size_t triangles);
/// `triangles` in random places and directions, smaller the more there are: nothing that a packet's rays
/// share.
Model random_triangles(std::size_t triangles);
/// `spheres` with nine smaller ones on each, level by level.
Model sphere_flake(std::size_t spheres);

} // namespace celltrace::compare
