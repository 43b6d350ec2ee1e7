// Meshes as solids of CSG: which points are inside, and which crossings are found. Kernel dialect.
#pragma once

#include "records/csg.hpp"

#include <stdint.h>

namespace celltrace::kernel {

// The inside of a mesh: a point is in it if the ray from there along the mesh's inside vector crosses an odd
// number of triangles. So that few of them need be looked at, a grid lies across that vector: coordinates
// (column, row, height) are those of a space whose third axis is along the vector, and in which cell (i, j)
// reaches from (i, j) to (i + 1, j + 1).

/// SolidRecord: a mesh. `geometry` is the map from the world to the coordinates of the grid whose
/// MeshGridRecord is at `extra`.
constexpr uint32_t kMeshSolid = kEmptySolid - 1;

/// Cell (i, j) has number j * columns + i. Its list is a word a triangle, the offset of its
/// MeshTriangleRecord. It lies between two offsets that follow each other in the words at `starts`: the one
/// that has the cell's number, and the next one.
struct alignas(16) MeshGridRecord {
  uint32_t starts; ///< offset of the first of columns * rows + 1 words
  uint32_t columns, rows;
  uint32_t unused;
};
static_assert(sizeof(MeshGridRecord) == 16, "eight a line");
constexpr uint32_t kMaxMeshGridSide = 1024; ///< columns or rows: single precision counts the cells exactly

/// A triangle of a mesh, in the coordinates of the grid. Its corners 0, 1, 2 are in the order of their rows;
/// an edge is the same numbers in all triangles that have it.
struct alignas(64) MeshTriangleRecord {
  float row[3];
  float column[2];   ///< of corners 0 and 1
  float slope[3];    ///< columns a row, of the edges 0-1, 1-2, 0-2
  float height;      ///< of corner 0
  float gradient[2]; ///< of the height, by column and row
  float least_height, greatest_height;
  uint32_t unused[3];
};
static_assert(sizeof(MeshTriangleRecord) == 64, "two a line");

// A mesh without an inside vector in CSG. POV-Ray looks at the boxes of its triangles in the order in which a
// ray enters them, and stops before the first one that it enters behind the crossing found last: CSG shows
// what was found until then.

/// SolidRecord: which crossings with such a mesh are found. `geometry` is the map from the world to the
/// mesh's own space, `extra` the offset of the first of its CrossedMeshRecords.
constexpr uint32_t kCrossedMeshSolid = kEmptySolid - 2;

/// A triangle of such a mesh, or a box around those between this record and the one at `next`: a tree of
/// boxes in depth-first order. The first record is the box around all.
struct alignas(64) CrossedMeshRecord {
  float corner[3][3];   ///< of a box: the least and the greatest one
  uint32_t next;        ///< offset of the record behind it and what is in it
  uint32_t is_triangle; ///< 0 or 1
  uint32_t unused[5];
};
static_assert(sizeof(CrossedMeshRecord) == 64, "two a line");

} // namespace celltrace::kernel
