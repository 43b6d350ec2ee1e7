// Which voxels an object touches: bounding boxes and overlap tests. Kernel dialect.
#pragma once

#include "kernel/records.hpp"
#include "kernel/scalar.hpp"
#include "kernel/scalar_work.hpp"

namespace celltrace::kernel {

struct Box {
  float min[3];
  float max[3];
};

/// The object's axis-aligned bounding box. An ellipsoid's half extent along an axis is the length of that row
/// of the map from the unit sphere to the world, whose inverse the record holds.
inline Box bounding_box(const ObjectRecord& object) {
  const float* g = object.geometry;
  Box box;
  switch (static_cast<ObjectKind>(object.kind_and_flags & object_flag::kind_mask)) {
  case ObjectKind::sphere:
    for (int i = 0; i < 3; ++i) {
      box.min[i] = g[i] - g[3];
      box.max[i] = g[i] + g[3];
    }
    return box;
  case ObjectKind::ellipsoid: {
    const float cofactor[3][3] = {
        {g[5] * g[10] - g[6] * g[9], g[2] * g[9] - g[1] * g[10], g[1] * g[6] - g[2] * g[5]},
        {g[6] * g[8] - g[4] * g[10], g[0] * g[10] - g[2] * g[8], g[2] * g[4] - g[0] * g[6]},
        {g[4] * g[9] - g[5] * g[8], g[1] * g[8] - g[0] * g[9], g[0] * g[5] - g[1] * g[4]}};
    const float inverse = 1.0f / (g[0] * cofactor[0][0] + g[1] * cofactor[1][0] + g[2] * cofactor[2][0]);
    for (int i = 0; i < 3; ++i) {
      float centre = 0.0f;
      float square = 0.0f;
      for (int j = 0; j < 3; ++j) {
        const float m = cofactor[i][j] * inverse;
        centre -= m * g[j * 4 + 3];
        square += m * m;
      }
      const float half = square_root(square) * 1.00001f;
      box.min[i] = centre - half;
      box.max[i] = centre + half;
    }
    return box;
  }
  default:
    for (int i = 0; i < 3; ++i) {
      box.min[i] = smaller(g[i], smaller(g[3 + i], g[6 + i]));
      box.max[i] = larger(g[i], larger(g[3 + i], g[6 + i]));
    }
    return box;
  }
}

/// The smallest box around both.
inline Box box_around(const Box& a, const Box& b) {
  Box both;
  for (int i = 0; i < 3; ++i) {
    both.min[i] = smaller(a.min[i], b.min[i]);
    both.max[i] = larger(a.max[i], b.max[i]);
  }
  return both;
}

/// The surface of a sphere touches a box if the box's nearest point is inside and its farthest one is
/// outside.
inline bool sphere_overlaps(const ObjectRecord& object, const Box& box) {
  const float* g = object.geometry;
  float nearest = 0.0f;
  float farthest = 0.0f;
  for (int i = 0; i < 3; ++i) {
    const float to_min = box.min[i] - g[i];
    const float to_max = g[i] - box.max[i];
    const float outside = larger(0.0f, larger(to_min, to_max));
    const float across = larger(magnitude(to_min), magnitude(to_max));
    nearest += outside * outside;
    farthest += across * across;
  }
  const float square = g[3] * g[3];
  return nearest <= square * 1.0001f && farthest >= square * 0.9999f;
}

/// Conservative: the box, mapped to the space of the unit sphere, against a ball around it.
inline bool ellipsoid_overlaps(const ObjectRecord& object, const Box& box) {
  const float* g = object.geometry;
  float distance = 0.0f;
  float reach = 0.0f;
  for (int row = 0; row < 3; ++row) {
    float centre = g[row * 4 + 3];
    float extent = 0.0f;
    for (int i = 0; i < 3; ++i) {
      centre += g[row * 4 + i] * 0.5f * (box.min[i] + box.max[i]);
      extent += magnitude(g[row * 4 + i]) * 0.5f * (box.max[i] - box.min[i]);
    }
    distance += centre * centre;
    reach += extent * extent;
  }
  return square_root(distance) <= 1.0f + square_root(reach) * 1.0001f;
}

/// Separating axes of a triangle and a box (Akenine-Moeller 2001): the box's axes are those of the candidate
/// voxels already; left are the triangle's normal and the nine cross products of edges.
inline bool triangle_overlaps(const ObjectRecord& object, const Box& box) {
  float vertex[3][3];
  float half[3];
  for (int i = 0; i < 3; ++i) {
    const float centre = 0.5f * (box.min[i] + box.max[i]);
    half[i] = 0.5f * (box.max[i] - box.min[i]);
    for (int v = 0; v < 3; ++v)
      vertex[v][i] = object.geometry[v * 3 + i] - centre;
  }
  const auto separates = [&](float x, float y, float z) {
    const float reach = half[0] * magnitude(x) + half[1] * magnitude(y) + half[2] * magnitude(z);
    float low = 0.0f;
    float high = 0.0f;
    for (int v = 0; v < 3; ++v) {
      const float along = vertex[v][0] * x + vertex[v][1] * y + vertex[v][2] * z;
      low = v == 0 ? along : smaller(low, along);
      high = v == 0 ? along : larger(high, along);
    }
    const float slack = reach * 1e-4f;
    return low > reach + slack || high < -reach - slack;
  };
  float edge[3][3];
  for (int e = 0; e < 3; ++e)
    for (int i = 0; i < 3; ++i)
      edge[e][i] = vertex[(e + 1) % 3][i] - vertex[e][i];
  if (separates(edge[0][1] * edge[1][2] - edge[0][2] * edge[1][1],
                edge[0][2] * edge[1][0] - edge[0][0] * edge[1][2],
                edge[0][0] * edge[1][1] - edge[0][1] * edge[1][0]))
    return false;
  for (int e = 0; e < 3; ++e) {
    const float* d = edge[e];
    if (separates(0.0f, d[2], -d[1]) || separates(-d[2], 0.0f, d[0]) || separates(d[1], -d[0], 0.0f))
      return false;
  }
  return true;
}

inline bool overlaps(const ObjectRecord& object, const Box& box) {
  switch (static_cast<ObjectKind>(object.kind_and_flags & object_flag::kind_mask)) {
  case ObjectKind::sphere:
    return sphere_overlaps(object, box);
  case ObjectKind::ellipsoid:
    return ellipsoid_overlaps(object, box);
  default:
    return triangle_overlaps(object, box);
  }
}

/// Calls `visit(cell)` for each voxel that the object touches. Voxels count as a little larger than they are,
/// by more than what the rounding of rays and points amounts to.
template <class Spu, class Visit>
void for_each_voxel(Spu& spu, const GridRecord& grid, const ObjectRecord& object, Visit visit) {
  const uint32_t kind = object.kind_and_flags & object_flag::kind_mask;
  spu.compute(scalar_work::kBounds[kind]);
  const Box bounds = bounding_box(object);
  int32_t low[3];
  int32_t high[3];
  float margin[3];
  for (int i = 0; i < 3; ++i) {
    margin[i] = 1e-3f * grid.cell_size[i];
    const float last = static_cast<float>(grid.cells[i] - 1);
    const float from = (bounds.min[i] - margin[i] - grid.min[i]) * grid.inverse_cell_size[i];
    const float to = (bounds.max[i] + margin[i] - grid.min[i]) * grid.inverse_cell_size[i];
    low[i] = static_cast<int32_t>(smaller(larger(from, 0.0f), last));
    high[i] = static_cast<int32_t>(smaller(larger(to, 0.0f), last));
  }
  const bool single = low[0] == high[0] && low[1] == high[1] && low[2] == high[2];
  uint32_t slice =
      static_cast<uint32_t>(low[2]) * grid.row_of_cells + static_cast<uint32_t>(low[1]) * grid.cells[0];
  for (int32_t z = low[2]; z <= high[2]; ++z, slice += grid.row_of_cells) {
    uint32_t row = slice;
    for (int32_t y = low[1]; y <= high[1]; ++y, row += grid.cells[0]) {
      for (int32_t x = low[0]; x <= high[0]; ++x) {
        if (!single) {
          spu.compute(scalar_work::kOverlap[kind]);
          const int32_t at[3] = {x, y, z};
          Box voxel;
          for (int i = 0; i < 3; ++i) {
            voxel.min[i] = grid.min[i] + static_cast<float>(at[i]) * grid.cell_size[i] - margin[i];
            voxel.max[i] = voxel.min[i] + grid.cell_size[i] + 2.0f * margin[i];
          }
          if (!overlaps(object, voxel)) continue;
        }
        visit(row + static_cast<uint32_t>(x));
      }
    }
  }
}

} // namespace celltrace::kernel
