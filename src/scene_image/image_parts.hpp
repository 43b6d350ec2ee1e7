// The parts that a scene image is made of, whether it is built anew or updated in place.
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

/// The textures and the light sets of a scene.
struct SurfaceParts {
  TextureTables textures;
  LightSets light_sets;

  explicit SurfaceParts(const Scene& scene) : textures(scene), light_sets(scene) {}

  /// Writes the tables of textures and lights, in which offsets replace the textures' indices.
  void write(TableWriter& writer, std::span<const std::uint32_t> projector_sizes) {
    writer.write_lights(light_sets, projector_sizes);
    writer.write_surfaces(textures);
  }
};

/// All parts of an image except the places of its objects. Each part is built from the parts before it.
struct ImageParts {
  /// Builds the parts. `given` must be valid, and must not change while this object lives. Throws InputError
  /// if the image cannot hold the scene.
  ImageParts(const Scene& given, Eye eye, unsigned threads);

  const Scene& given;
  Eye eye;
  PassedLimits limits;
  const std::optional<Scene> with_projectors; ///< the given scene, in which projectors have a material
  SurfaceParts surfaces;
  const PreparedScene prepared;
  const InstancedMeshes instanced;
  const MeshInstances instances;
  SceneObjects objects;

  /// Returns the prepared scene, whose objects the image holds.
  const Scene& scene() const { return prepared.scene(); }
  /// Returns the number of threads to use if each thread is to have at least `objects_a_thread` objects.
  unsigned threads_for(std::uint32_t objects_a_thread, unsigned threads) const;
  std::vector<ObjectForm> forms() const;
  /// Returns for each object record the index of the scene's object that the record belongs to. Objects that
  /// are no instances have the order `in_order`.
  std::vector<Index> owners(std::span<const PlacedObject> in_order) const;

  /// Returns the header of the image with objects in these places. Its bounds are not set: write() writes
  /// them.
  kernel::ImageHeader header(const ObjectPlaces& places) const;
  /// Returns a writer of the tables of an image that begins at `base` with this header.
  TableWriter writer(std::byte* base, const kernel::ImageHeader& header) const {
    return {base, header, scene(), surfaces.textures, other_extras()};
  }
  /// Writes all tables.
  void write(std::byte* base, const kernel::ImageHeader& header, const ObjectPlaces& places,
             unsigned threads);

private:
  /// Returns the number of ExtraRecords of projectors, unbounded objects and shared meshes, which follow the
  /// ExtraRecords of objects in the accelerator.
  std::uint32_t other_extras() const { return objects.unbounded_extras() + instanced.extra_count(); }
};

} // namespace celltrace
