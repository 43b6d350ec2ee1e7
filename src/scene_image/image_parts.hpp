// The parts that a scene image is made of, whether it is a new one or one that is updated in place.
#pragma once

#include "celltrace/scene.hpp"
#include "prepare/eye.hpp"
#include "prepare/passes.hpp"
#include "records/image.hpp"
#include "scene_image/instanced_meshes.hpp"
#include "scene_image/light_sets.hpp"
#include "scene_image/mesh_instances.hpp"
#include "scene_image/object_form.hpp"
#include "scene_image/object_places.hpp"
#include "scene_image/scene_objects.hpp"
#include "scene_image/table_writer.hpp"
#include "scene_image/textures.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace celltrace {

/// How a scene's surfaces look and what lights them.
struct SurfaceParts {
  TextureTables textures;
  LightSets light_sets;

  explicit SurfaceParts(const Scene& scene) : textures(scene), light_sets(scene) {}

  /// Writes their tables. References among the textures become offsets.
  void write(TableWriter& writer, std::span<const std::uint32_t> projector_sizes) {
    writer.write_lights(light_sets, projector_sizes);
    writer.write_surfaces(textures);
  }
};

/// All parts of an image but the places of its objects; each is made of those before it.
struct ImageParts {
  /// `given` is valid and stays as it is as long as this lives. Throws InputError if a scene that is valid
  /// cannot be laid out.
  ImageParts(const Scene& given, Eye eye, unsigned threads);

  const Scene& given;
  Eye eye;
  PassedLimits limits;
  const std::optional<Scene> with_projectors; ///< of the scene as given: projectors have a material
  SurfaceParts surfaces;
  const PreparedScene prepared;
  const InstancedMeshes instanced;
  const MeshInstances instances;
  SceneObjects objects;

  /// Returns the scene whose objects are the image's.
  const Scene& scene() const { return prepared.scene(); }
  /// Returns how many threads are worth while if each is to have so many objects at least.
  unsigned threads_for(std::uint32_t objects_a_thread, unsigned threads) const;
  /// Returns the form of each of the scene's objects.
  std::vector<ObjectForm> forms() const;
  /// Returns the object of the scene that each record of an object is of, with objects that are no instances
  /// as they lie in the image.
  std::vector<Index> owners(std::span<const PlacedObject> in_order) const;

  /// Returns the header of the image with objects in these places; their bounds are written with them.
  kernel::ImageHeader header(const ObjectPlaces& places) const;
  /// Returns what writes the tables of an image with such a header, at `base`.
  TableWriter writer(std::byte* base, const kernel::ImageHeader& header) const {
    return {base, header, scene(), surfaces.textures, other_extras()};
  }
  /// Writes all tables.
  void write(std::byte* base, const kernel::ImageHeader& header, const ObjectPlaces& places,
             unsigned threads);

private:
  /// Returns how many ExtraRecords lie behind those of objects that an accelerator has.
  std::uint32_t other_extras() const { return objects.unbounded_extras() + instanced.extra_count(); }
};

} // namespace celltrace
