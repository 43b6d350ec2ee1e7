// Ray queries: find what an application's own rays hit in the scene of a renderer.
//
//   RenderOptions options;
//   options.ray_queries = true;
//   Renderer renderer(options);
//   renderer.render(scene);
//   RayQueries queries = renderer.ray_queries();
//   const RayHit hit = queries.closest_hit({{0, 1, -5}, {0, 0, 1}});
//   if (hit) std::cout << "object " << hit.object << " after " << hit.distance << '\n';
//
// Queries ignore textures and visibility flags: rays hit transparent surfaces like opaque surfaces, and also
// objects with `no_image` or `no_shadow`. Objects with Object::is_hidden are not hit. A surface closer than
// 1e-4 to the origin of a ray is not hit, so that rays can start on surfaces.
#pragma once

#include "celltrace/export.hpp"
#include "celltrace/ray.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace celltrace {

/// Answers queries about the scene as it was when Renderer::ray_queries() made this object. Copyable; a copy
/// takes some 200 KB. Thread safety: one thread at a time; give each thread a copy of its own. Queries may be
/// used while the renderer renders, but not while it changes its scene; after a change every call throws
/// InputError.
class CELLTRACE_EXPORT RayQueries {
public:
  ~RayQueries();
  RayQueries(const RayQueries&);
  RayQueries& operator=(const RayQueries&);
  RayQueries(RayQueries&&) noexcept;
  RayQueries& operator=(RayQueries&&) noexcept;

  /// Returns the closest hit of a ray. closest_hit() and closest_hits() give the same answers to the last
  /// bit, except where objects or triangles meet: there two queries may name different objects or triangles,
  /// at the same distance.
  RayHit closest_hit(const Ray& ray);
  /// Finds the closest hits of many rays, one for each. Much faster if the rays of each 16 in a row, and of
  /// each 256, have similar origins and directions. For rays through pixels, order them as 4x4 blocks of 4x4
  /// pixels. Throws InputError if `rays` and `hits` differ in number.
  void closest_hits(std::span<const Ray> rays, std::span<RayHit> hits);

  /// Returns whether the ray hits anything. Faster than closest_hit().
  bool occluded(const Ray& ray);
  /// Sets `results` to 1 for each ray that is occluded, to 0 for the others. Throws InputError as
  /// closest_hits() does.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results);

  /// Returns the surface at a hit of a ray. Throws InputError if there is no hit.
  RaySurface surface(const Ray& ray, const RayHit& hit);

private:
  friend class Renderer;
  friend class RayQueryScene;
  class Impl;
  explicit RayQueries(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

} // namespace celltrace
