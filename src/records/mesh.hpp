// Meshes as solids of CSG: records for tests of points and for the choice of crossings. Kernel dialect.
#pragma once

#include "records/csg.hpp"

#include <stdint.h>

namespace celltrace::kernel {

// Meshes with an inside vector. A point is inside if the ray from it along the vector crosses an odd number
// of triangles. A grid perpendicular to the vector limits the triangles that have to be tested: coordinates
// (column, row, height) belong to a space whose third axis is parallel to the vector, and cell (i, j) reaches
// from (i, j) to (i + 1, j + 1).

/// Kind of the SolidRecord of a mesh with an inside vector. `geometry` is the map from the world to the
/// coordinates of the grid, whose MeshGridRecord is at `extra`.
constexpr uint32_t kMeshSolid = kEmptySolid - 1;

/// The grid of a mesh. Cell (i, j) has number n = j * columns + i and a list of words, the offsets of its
/// MeshTriangleRecords. Words n and n + 1 of the words at `starts` are the offsets of the list's begin and
/// end.
struct alignas(16) MeshGridRecord {
  uint32_t starts; ///< offset of columns * rows + 1 words
  uint32_t columns, rows;
  uint32_t unused;
};
static_assert(sizeof(MeshGridRecord) == 16, "eight a line");
constexpr uint32_t kMaxMeshGridSide = 1024; ///< columns or rows; single precision counts the cells exactly

/// A triangle of a mesh, in the coordinates of the grid. Corners 0, 1, 2 are sorted by row. An edge has the
/// same numbers in all triangles that share it.
struct alignas(64) MeshTriangleRecord {
  float row[3];
  float column[2];   ///< columns of corners 0 and 1
  float slope[3];    ///< columns per row along the edges 0-1, 1-2, 0-2
  float height;      ///< height of corner 0
  float gradient[2]; ///< change of the height per column and per row
  float least_height, greatest_height;
  uint32_t unused[3];
};
static_assert(sizeof(MeshTriangleRecord) == 64, "two a line");

// Meshes without an inside vector in CSG. POV-Ray visits the boxes of a mesh's triangles in the order in
// which a ray enters them, and stops before the first box that the ray enters behind the crossing found last.
// CSG shows the crossings found until then.

/// Kind of the SolidRecord of a mesh without an inside vector, by which CSG finds the mesh's crossings.
/// `geometry` is the map from the world to the mesh's own space, `extra` the offset of the mesh's first
/// CrossedMeshRecord.
constexpr uint32_t kCrossedMeshSolid = kEmptySolid - 2;

/// A triangle of a mesh without an inside vector, or the box around the triangles between this record and the
/// one at `next`. The records of a mesh are a tree of boxes in depth-first order; the first one is the box
/// around all.
struct alignas(64) CrossedMeshRecord {
  float corner[3][3];   ///< vertices, or least and greatest corner of a box
  uint32_t next;        ///< offset of the first record behind this one and its contents
  uint32_t is_triangle; ///< 0 or 1
  uint32_t unused[5];
};
static_assert(sizeof(CrossedMeshRecord) == 64, "two a line");

} // namespace celltrace::kernel
