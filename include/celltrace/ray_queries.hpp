// Ray queries: what rays of the application's own hit in the scene of a renderer.
//
//   RenderOptions options;
//   options.ray_queries = true;
//   Renderer renderer(options);
//   renderer.render(scene);
//   RayQueries queries = renderer.ray_queries();
//   const RayHit hit = queries.closest_hit({{0, 1, -5}, {0, 0, 1}});
//   if (hit) std::cout << "object " << hit.object << " after " << hit.distance << '\n';
//
// Queries know shapes only: transparent surfaces are hit as others are, and so is what `no_image` or
// `no_shadow` hides from other rays. What is hidden by Object::is_hidden is not hit. A surface closer than
// 1e-4 to where a ray starts is not hit, so that rays can start on surfaces.
#pragma once

#include "celltrace/export.hpp"
#include "celltrace/ray.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace celltrace {

/// Answers queries about the scene as it was when Renderer::ray_queries() made this. Copyable; a copy takes
/// some 200 KB. Thread safety: one thread at a time; give each thread a copy of its own. They may ask while
/// the renderer renders, but not while it changes its scene; from then on, every call throws InputError.
class CELLTRACE_EXPORT RayQueries {
public:
  ~RayQueries();
  RayQueries(const RayQueries&);
  RayQueries& operator=(const RayQueries&);
  RayQueries(RayQueries&&) noexcept;
  RayQueries& operator=(RayQueries&&) noexcept;

  /// The closest hit of a ray. All queries of closest hits give the same answers to the last bit, but where
  /// objects or triangles meet: there one query may name another of them, at the same distance.
  RayHit closest_hit(const Ray& ray);
  /// Those of many rays, one for each; faster by far where 16 rays in a row, and 256, start and go similar
  /// ways. So give them in blocks: pixels, for example, as 4x4 of 4x4. Throws InputError if there is not the
  /// same number of both.
  void closest_hits(std::span<const Ray> rays, std::span<RayHit> hits);

  /// Whether anything is hit: as closest_hit(), which takes longer.
  bool occluded(const Ray& ray);
  /// 1 for each ray that is occluded, 0 for the others. Throws InputError as closest_hits() does.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results);

  /// The surface where a ray hits. Throws InputError if there is no hit.
  RaySurface surface(const Ray& ray, const RayHit& hit);

private:
  friend class Renderer;
  friend class RayQueryScene;
  class Impl;
  explicit RayQueries(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

} // namespace celltrace
