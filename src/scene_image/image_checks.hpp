// Checks that the tables of a scene image are well formed, whoever wrote the image, so that kernels can
// follow its offsets. All functions take the image's first byte and its header; each table must lie within
// the image.
#pragma once

#include "records/image.hpp"

#include <cstddef>
#include <cstdint>

namespace celltrace {

/// Returns true if `offset` is the offset of a record in a table of `count` records.
inline bool refers_to(std::uint32_t offset, std::uint32_t table, std::uint32_t count, std::size_t record) {
  return offset >= table && (offset - table) % record == 0 && (offset - table) / record < count;
}

/// Returns true if objects have known kinds, and refer to materials, interiors and the tables that their
/// kinds need.
bool objects_are_valid(const std::byte* base, const kernel::ImageHeader& h);

bool lights_are_valid(const std::byte* base, const kernel::ImageHeader& h);

/// Returns true if every reference among textures leads to a record of the right table, walks through maps
/// and layers are short enough, and objects' flags say what their textures need. Objects and blends must be
/// valid.
bool textures_are_valid(const std::byte* base, const kernel::ImageHeader& h);

/// Returns true if conditions and their programs end, and solids have known kinds.
bool csg_is_valid(const std::byte* base, const kernel::ImageHeader& h);

/// Returns true if solids that are meshes have grids, and each cell of a grid has a list of triangles.
bool mesh_insides_are_valid(const std::byte* base, const kernel::ImageHeader& h);

/// Returns true if the boxes around triangles of crossed meshes are nested, and each solid that is a crossed
/// mesh refers to a record of their trees.
bool crossed_meshes_are_valid(const std::byte* base, const kernel::ImageHeader& h);

/// Returns true if each instance has a mesh and numbers of triangles that no other instance has, and the
/// nodes of these meshes lead to their triangles in at most kernel::kMaxMeshLevels levels.
bool instances_are_valid(const std::byte* base, const kernel::ImageHeader& h);

/// Returns true if there are no groups, or each object is in one group.
bool groups_are_valid(const std::byte* base, const kernel::ImageHeader& h);

/// Returns true if there are no copies, or each copy has as many objects as its prototype, and not many. The
/// groups must be valid.
bool prototypes_are_valid(const std::byte* base, const kernel::ImageHeader& h);

} // namespace celltrace
