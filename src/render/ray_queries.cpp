#include "celltrace/error.hpp"
#include "render/ray_query_scene.hpp"
#include "render/tracer_program.hpp"

#include <algorithm>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace celltrace {

RayQueryScene::RayQueryScene(const kernel::FrameBlock& frame, const SceneImage& image, const Vec3& origin,
                             std::string_view spu_key)
    : frame_(frame), image_(image), origin_(origin), bvh_(image, frame.bvh.node_offset) {
  // Queries read the image in the host's memory, even if SPEs have a copy.
  frame_.image = reinterpret_cast<std::uintptr_t>(image.base());
  const SpeProgram::Entry entry = ray_queries_program().entry(std::string(spu_key));
  if (!entry) throw InputError("this build has no ray queries for " + std::string(spu_key));
  entry(nullptr, reinterpret_cast<std::uintptr_t>(&functions_));
}

void RayQueryScene::check() const {
  if (!is_current_.load(std::memory_order_relaxed))
    throw InputError("the scene of these ray queries has changed: the renderer has newer ones");
}

/// The working memory of one thread.
class RayQueries::Impl {
public:
  explicit Impl(std::shared_ptr<const RayQueryScene> scene)
      : scene_(std::move(scene)), functions_(scene_->functions()), bvh_(scene_->bvh()),
        state_(::operator new(functions_.state_bytes, alignment())) {
    functions_.open(state_, scene_->frame(), bvh_, scene_->owners());
  }
  Impl(const Impl& other) : Impl(other.scene_) {}
  Impl& operator=(const Impl&) = delete;
  ~Impl() { ::operator delete(state_, alignment()); }

  RayHit closest_hit(const Ray& ray) {
    scene_->check();
    RayHit hit;
    functions_.closest_hit(state_, is_moved_ ? moved(ray) : ray, hit);
    return hit;
  }
  bool occluded(const Ray& ray) {
    scene_->check();
    return functions_.occluded(state_, is_moved_ ? moved(ray) : ray);
  }
  void closest_hits(std::span<const Ray> rays, std::span<RayHit> hits) {
    check_size(rays, hits.size());
    std::vector<Ray> from_origin;
    if (is_moved_) {
      from_origin.resize(rays.size());
      std::transform(rays.begin(), rays.end(), from_origin.begin(),
                     [this](const Ray& ray) { return moved(ray); });
      rays = from_origin;
    }
    // Batches are whole bundles whose number fits into 32 bits.
    constexpr std::size_t kMost = std::size_t{1} << 20;
    for (std::size_t first = 0; first < rays.size(); first += kMost)
      functions_.closest_hits(state_, rays.data() + first, hits.data() + first,
                              static_cast<std::uint32_t>(std::min(kMost, rays.size() - first)));
  }
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results) {
    check_size(rays, results.size());
    std::transform(rays.begin(), rays.end(), results.begin(), [this](const Ray& ray) {
      return static_cast<std::uint8_t>(functions_.occluded(state_, ray) ? 1 : 0);
    });
  }
  RaySurface surface(const Ray& ray, const RayHit& hit) {
    scene_->check();
    if (!hit || scene_->object_at(hit.record) != hit.object)
      throw InputError("there is no surface where a ray hits nothing of this scene");
    RaySurface surface;
    functions_.surface(state_, is_moved_ ? moved(ray) : ray, hit, surface);
    if (is_moved_)
      for (int axis = 0; axis < 3; ++axis)
        surface.point[axis] = static_cast<float>(double{surface.point[axis]} + scene_->origin()[axis]);
    return surface;
  }

private:
  /// Returns a ray in the image's coordinates.
  Ray moved(Ray ray) const {
    for (int axis = 0; axis < 3; ++axis)
      ray.origin[axis] = static_cast<float>(double{ray.origin[axis]} - scene_->origin()[axis]);
    return ray;
  }
  std::align_val_t alignment() const { return std::align_val_t{functions_.state_alignment}; }
  void check_size(std::span<const Ray> rays, std::size_t results) const {
    scene_->check();
    if (rays.size() != results)
      throw InputError(std::to_string(rays.size()) + " rays have " + std::to_string(results) + " results");
  }

  std::shared_ptr<const RayQueryScene> scene_;
  const kernel::RayQueryFunctions& functions_;
  const kernel::QueryBvh bvh_;
  const bool is_moved_ = scene_->origin() != Vec3(0);
  void* state_;
};

RayQueries RayQueryScene::queries(std::shared_ptr<const RayQueryScene> scene) {
  return RayQueries(std::make_unique<RayQueries::Impl>(std::move(scene)));
}

RayQueries::RayQueries(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
}
RayQueries::~RayQueries() = default;
RayQueries::RayQueries(const RayQueries& other) : impl_(std::make_unique<Impl>(*other.impl_)) {
}
RayQueries& RayQueries::operator=(const RayQueries& other) {
  if (this != &other) impl_ = std::make_unique<Impl>(*other.impl_);
  return *this;
}
RayQueries::RayQueries(RayQueries&&) noexcept = default;
RayQueries& RayQueries::operator=(RayQueries&&) noexcept = default;

RayHit RayQueries::closest_hit(const Ray& ray) {
  return impl_->closest_hit(ray);
}
void RayQueries::closest_hits(std::span<const Ray> rays, std::span<RayHit> hits) {
  impl_->closest_hits(rays, hits);
}
bool RayQueries::occluded(const Ray& ray) {
  return impl_->occluded(ray);
}
void RayQueries::occluded(std::span<const Ray> rays, std::span<std::uint8_t> results) {
  impl_->occluded(rays, results);
}
RaySurface RayQueries::surface(const Ray& ray, const RayHit& hit) {
  return impl_->surface(ray, hit);
}

} // namespace celltrace
