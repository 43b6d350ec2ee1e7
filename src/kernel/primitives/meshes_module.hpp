// The code module of meshes: tests of points against their insides. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/modules.hpp"
#include "kernel/primitives/local_shape.hpp"
#include "kernel/scene_access.hpp"

namespace celltrace::kernel {

namespace module_meshes {

/// Returns the points that have the triangle above them. A point exactly under an edge or a corner counts for
/// as many triangles as a point beside it: triangles that share the edge or corner compute its column by the
/// same operations, and rows and columns are half-open intervals.
template <class S>
[[gnu::always_inline]] inline uint32_t under(const MeshTriangleRecord& triangle, const V3<S>& points) {
  using F = typename S::F;
  const F from_0 = points.y - F(triangle.row[0]), from_1 = points.y - F(triangle.row[1]);
  const F longest = F(triangle.column[0]) + from_0 * F(triangle.slope[2]);
  const F other =
      S::select(points.y < F(triangle.row[1]), F(triangle.column[0]) + from_0 * F(triangle.slope[0]),
                F(triangle.column[1]) + from_1 * F(triangle.slope[1]));
  // The gradient of triangles that are nearly parallel to the inside vector is inaccurate.
  const F height = F(triangle.height) + (points.x - F(triangle.column[0])) * F(triangle.gradient[0]) +
                   from_0 * F(triangle.gradient[1]);
  const F bounded = S::max(F(triangle.least_height), S::min(F(triangle.greatest_height), height));
  return ((points.y >= F(triangle.row[0])) & (points.y < F(triangle.row[2])) &
          (points.x >= S::min(longest, other)) & (points.x < S::max(longest, other)) & (points.z < bounded))
      .bits();
}

/// Returns the points of `lanes` that are inside a mesh. `solid` is part of the mesh's SolidRecord.
template <class Spu>
CELLTRACE_ONE_COPY uint32_t inside(SceneAccess<Spu>& scene, const ObjectRecord& solid,
                                   const V3<typename Spu::simd>& points, uint32_t lanes) {
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;
  scene.spu().run_in_module(modules::kMeshes);
  const V3<S> local = to_local<S>(solid.geometry, points, 1.0f);
  Kept<Spu, MeshGridRecord> grid = *scene.mesh_grid(solid.extra);
  const F columns(static_cast<float>(grid.columns)), rows(static_cast<float>(grid.rows));
  const auto in_grid = (local.x >= F(0.0f)) & (local.x < columns) & (local.y >= F(0.0f)) & (local.y < rows);
  lanes &= in_grid.bits();
  const auto whole = [&](const F& number) {
    return S::to_float(S::to_int(S::select(in_grid, number, F(0.0f))));
  };
  const I cells = S::to_int(whole(local.y) * columns + whole(local.x));
  alignas(64) int32_t cell_of[kSimdLanes];
  cells.store(cell_of);
  uint32_t odd = 0;
  while (lanes != 0) {
    // Points of a packet are near each other: most of them are in few cells.
    const int32_t cell = cell_of[__builtin_ctz(lanes)];
    const uint32_t here = (cells == I::splat(cell)).bits() & lanes;
    lanes &= ~here;
    const uint32_t start = grid.starts + static_cast<uint32_t>(cell) * 4;
    const uint32_t list = scene.list_word(start), end = scene.list_word(start + 4);
    scene.for_each_listed(list, (end - list) / 4, [&](uint32_t triangle) {
      odd ^= under<S>(*scene.mesh_triangle(triangle), local) & here;
      return false;
    });
  }
  return odd;
}

} // namespace module_meshes

} // namespace celltrace::kernel
