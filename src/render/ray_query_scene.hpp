// The scene of ray queries: the image and the BVH of a renderer's scene, until the renderer retires them.
#pragma once

#include "celltrace/ray_queries.hpp"
#include "kernel/direct/ray_queries.hpp"
#include "render/single_ray_bvh.hpp"
#include "scene_image/scene_image.hpp"

#include <atomic>
#include <memory>
#include <string_view>

namespace celltrace {

class RayQueryScene {
public:
  /// Refers to `image` and to the BVH in `frame`; both must outlive all queries before retire(). `origin` is
  /// the image's origin in the coordinates of rays. `spu_key` is the SPU type whose CPU the query code is
  /// compiled for. Throws InputError if `frame` has no BVH.
  RayQueryScene(const kernel::FrameBlock& frame, const SceneImage& image, const Vec3& origin,
                std::string_view spu_key);

  static RayQueries queries(std::shared_ptr<const RayQueryScene> scene);

  /// Makes all further queries throw InputError.
  void retire() noexcept { is_current_.store(false, std::memory_order_relaxed); }
  /// Throws InputError if the scene has been retired.
  void check() const;

  const kernel::FrameBlock& frame() const { return frame_; }
  kernel::QueryBvh bvh() const { return bvh_.get(); }
  const std::uint32_t* owners() const { return image_.owners().data(); }
  const kernel::RayQueryFunctions& functions() const { return functions_; }
  const Vec3& origin() const { return origin_; }
  /// Returns the object of the scene to which a record in the image belongs.
  std::uint32_t object_at(std::uint32_t record) const { return image_.owner_of(record); }

private:
  kernel::FrameBlock frame_;
  const SceneImage& image_;
  const Vec3 origin_;
  SingleRayBvh bvh_;
  kernel::RayQueryFunctions functions_{};
  std::atomic<bool> is_current_ = true;
};

} // namespace celltrace
