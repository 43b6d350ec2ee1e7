// Offsets of the tables in a scene image.
#pragma once

#include "celltrace/scene.hpp"
#include "records/image.hpp"
#include "scene_image/instanced_meshes.hpp"
#include "scene_image/light_sets.hpp"
#include "scene_image/mesh_instances.hpp"
#include "scene_image/object_records.hpp"
#include "scene_image/scene_objects.hpp"
#include "scene_image/textures.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace celltrace {

/// Returns a size rounded up to whole cache lines.
std::size_t whole_lines(std::size_t bytes);

/// Returns how many records are reserved for objects without bounds, in front of the other objects: whole
/// cache lines.
std::uint32_t room_of_unbounded(std::uint32_t count);

/// Returns the header of an image of all objects, without their bounds. `groups` are the groups of the
/// objects that are no instances. Throws InputError if the image would pass 4 GB.
kernel::ImageHeader make_header(const Scene& scene, const LightSets& light_sets,
                                const TextureTables& textures, const SceneObjects& objects,
                                const ObjectCounts& counts, std::span<const std::uint32_t> groups,
                                const InstancedMeshes& instanced, const MeshInstances& instances,
                                bool has_near_surfaces);

/// Returns `old` with new places for the tables of surfaces and lights, for a scene whose objects have not
/// changed. `own_interiors` is the number of interior records of objects without an interior.
kernel::ImageHeader with_surfaces(const kernel::ImageHeader& old, const Scene& scene,
                                  std::size_t own_interiors, const LightSets& light_sets,
                                  const TextureTables& textures);

/// Returns whether all tables have the same offsets in both images.
bool have_same_layout(const kernel::ImageHeader& a, const kernel::ImageHeader& b);

} // namespace celltrace
