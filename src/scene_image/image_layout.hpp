// Where the tables of a scene image lie.
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

/// Rounded up to lines.
std::size_t whole_lines(std::size_t bytes);

/// How many records are before those of other objects for ones without bounds: whole lines.
std::uint32_t room_of_unbounded(std::uint32_t count);

/// Of all objects, but for their bounds; `groups` are those of the objects that are no instances. Throws
/// InputError if the image would pass 4 GB.
kernel::ImageHeader make_header(const Scene& scene, const LightSets& light_sets,
                                const TextureTables& textures, const SceneObjects& objects,
                                const ObjectCensus& census, std::span<const std::uint32_t> groups,
                                const InstancedMeshes& instanced, const MeshInstances& instances,
                                bool has_near_surfaces);

/// As `old`, but for the tables of a scene whose objects are where they were; `own_interiors` are the records
/// of those without an interior.
kernel::ImageHeader with_surfaces(const kernel::ImageHeader& old, const Scene& scene,
                                  std::size_t own_interiors, const LightSets& light_sets,
                                  const TextureTables& textures);

/// Whether all tables have the same places.
bool have_same_layout(const kernel::ImageHeader& a, const kernel::ImageHeader& b);

} // namespace celltrace
