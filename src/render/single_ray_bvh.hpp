// Makes the BVH for single rays.
#pragma once

#include "kernel/direct/query_bvh.hpp"
#include "scene_image/scene_image.hpp"

#include <cstdint>
#include <vector>

namespace celltrace {

class SingleRayBvh {
public:
  /// From the BVH of `image`, whose root is at `root`.
  SingleRayBvh(const SceneImage& image, std::uint32_t root);
  /// Valid as long as this lives where it is.
  kernel::QueryBvh get() const { return {nodes_.data(), blocks_.data(), others_.data()}; }

private:
  class Builder;

  std::vector<kernel::QueryNode> nodes_;
  std::vector<kernel::TriangleBlock> blocks_;
  std::vector<std::uint32_t> others_;
};

} // namespace celltrace
