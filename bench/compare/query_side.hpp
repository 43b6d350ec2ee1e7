// What is asked of ray queries: closest hits of rays that are given.
#pragma once

#include "celltrace/ray.hpp"
#include "model.hpp"

#include <memory>
#include <span>
#include <vector>

namespace celltrace::compare {

class QuerySide {
public:
  virtual ~QuerySide() = default;
  /// The distances to the closest hits of rays whose directions have length 1, asked for one by one; infinity
  /// where nothing is hit.
  virtual void closest_hits(std::span<const Ray> rays, std::span<float> distances) = 0;
};

/// rtcIntersect1(). Throws Error if Embree fails. Only where there is an embree_version().
std::unique_ptr<QuerySide> make_embree_queries(const Model& model);

/// Through the middle of each pixel of a square picture, in blocks of 4x4 pixels, 4x4 of them in blocks, too.
std::vector<Ray> primary_rays(const Model& model, int size);

/// From where such rays hit something, into any direction of the side that they come from.
std::vector<Ray> scattered_rays(std::span<const Ray> rays, std::span<const float> distances);

} // namespace celltrace::compare
