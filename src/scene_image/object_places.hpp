// Places in a scene image of the objects that are no instances: in a new order, or where they were before.
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

struct OrderMemory {
  PlacedObject* objects;
  PlacedObject* spare;
  std::uint32_t* cells;

  OrderMemory(AlignedBlock& block, std::uint32_t count);
};

/// The places of an image's objects, from which its tables are written.
struct ObjectPlaces {
  ObjectCounts counts;                   ///< counts of the objects that can be hit
  std::span<const std::uint32_t> groups; ///< groups of the objects that can be hit
  std::optional<std::span<const PlacedObject>>
      in_order;                             ///< the objects that can be hit, in the order of the image
  std::uint32_t* cells = nullptr;           ///< with `in_order`: work memory, one word per object
  std::span<const std::uint32_t> by_object; ///< without `in_order`: the place of each object, or kNoPlace
  bool are_known = false;                   ///< true if an image has the objects at these places already
  bool are_written = false;                 ///< true if the objects' records are written already
};

/// Places objects in an order along a curve, or in the order of the scene if there are few.
class NewPlaces {
public:
  /// Places the objects. `work` must not change while this object lives. `copies` tells whether the image has
  /// copies of meshes too; then groups are made even of few objects.
  NewPlaces(const SceneObjects& objects, bool copies, AlignedBlock& work, unsigned threads);

  ObjectPlaces places() const;
  /// Returns the place of each object, or kNoPlace for an object that cannot be hit.
  std::vector<std::uint32_t> by_object() const;
  std::vector<std::uint32_t> take_groups() { return std::move(groups_); }

private:
  const SceneObjects& objects_;
  OrderMemory memory_;
  ObjectCounts counts_;
  std::vector<std::uint32_t> groups_;
};

/// Returns the counts of objects whose places are known; nothing if an object that can be hit has no place.
/// `places` has the place of each object.
std::optional<ObjectCounts> count_placed(const SceneObjects& objects, std::span<const std::uint32_t> places,
                                         unsigned threads);
/// Counts the objects as count_placed() does, and writes their records. All objects must be plain triangles.
std::optional<ObjectCounts> send_placed(TableWriter& writer, const SceneObjects& objects,
                                        std::span<const std::uint32_t> places, unsigned threads);
/// Returns the `placed` objects that have a place, in the order of the image. Their centres are not set.
std::span<const PlacedObject> in_order_of(std::span<const std::uint32_t> places, std::uint32_t placed,
                                          const OrderMemory& memory);

} // namespace celltrace
