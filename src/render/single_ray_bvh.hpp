// Builds the BVH for single rays.
#pragma once

#include "kernel/direct/query_bvh.hpp"
#include "scene_image/scene_image.hpp"

#include <cstdint>
#include <vector>

namespace celltrace {

class SingleRayBvh {
public:
  /// Builds the BVH from the BVH of `image`, whose root is at `root`.
  SingleRayBvh(const SceneImage& image, std::uint32_t root);
  /// Returns pointers that are valid as long as this object lives and is not moved.
  kernel::QueryBvh get() const { return {nodes_.data(), blocks_.data(), others_.data()}; }

private:
  class Builder;

  std::vector<kernel::QueryNode> nodes_;
  std::vector<kernel::TriangleBlock> blocks_;
  std::vector<std::uint32_t> others_;
};

} // namespace celltrace
