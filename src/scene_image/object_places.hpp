// Where the objects that are no instances lie in a scene image: in an order of their own, or where they were.
#pragma once

#include "memory/aligned_block.hpp"
#include "scene_image/object_order.hpp"
#include "scene_image/object_records.hpp"
#include "scene_image/scene_objects.hpp"
#include "scene_image/table_writer.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace celltrace {

/// Work memory for ordering objects.
struct OrderMemory {
  PlacedObject* objects;
  PlacedObject* spare;
  std::uint32_t* cells;

  OrderMemory(AlignedBlock& block, std::uint32_t count);
};

/// The places of an image's objects, as its tables are written with them.
struct ObjectPlaces {
  ObjectCensus census;                                   ///< of the objects that can be hit
  std::span<const std::uint32_t> groups;                 ///< of these objects
  std::optional<std::span<const PlacedObject>> in_order; ///< these objects as they lie in the image
  std::uint32_t* cells = nullptr;                        ///< with `in_order`: work memory, a word per object
  std::span<const std::uint32_t> by_object; ///< without `in_order`: the place of each object, or kNoPlace
  bool are_known = false;                   ///< the image's objects had these places before
  bool are_written = false;                 ///< the objects' records are written already
};

/// Places objects in an order along a curve, or in the scene's if they are few.
class NewPlaces {
public:
  /// `work` stays as it is as long as this lives. `copies`: there are copies of meshes besides.
  NewPlaces(const SceneObjects& objects, bool copies, AlignedBlock& work, unsigned threads);

  ObjectPlaces places() const;
  /// Returns the place of each object, or kNoPlace for those that cannot be hit.
  std::vector<std::uint32_t> by_object() const;
  std::vector<std::uint32_t> take_groups() { return std::move(groups_); }

private:
  const SceneObjects& objects_;
  OrderMemory memory_;
  ObjectCensus census_;
  std::vector<std::uint32_t> groups_;
};

/// Returns the census of objects that have places already, `places` by object; nothing if one that can be hit
/// has none.
std::optional<ObjectCensus> count_placed(const SceneObjects& objects, std::span<const std::uint32_t> places,
                                         unsigned threads);
/// Does so and writes their records, which are those of plain triangles.
std::optional<ObjectCensus> send_placed(TableWriter& writer, const SceneObjects& objects,
                                        std::span<const std::uint32_t> places, unsigned threads);
/// Returns the objects that have places already, of which there are `placed`, as they lie in the image, but
/// without their centres.
std::span<const PlacedObject> in_order_of(std::span<const std::uint32_t> places, std::uint32_t placed,
                                          const OrderMemory& memory);

} // namespace celltrace
