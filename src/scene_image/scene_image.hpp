// SceneImage: a Scene in the flat binary form that the SPEs read.
//
// One contiguous, 128-byte aligned block: header, lights, materials, patterns and their maps, normals,
// blends, interiors, conditions of CSG, insides of meshes, instances and their meshes, extra records,
// objects, groups of objects and which of them are copies (the static part, written here), then the voxels or
// nodes and the object lists of the accelerator (written by PREPARE FRAME). Scenes of at least
// kMinObjectsToOrder objects have them in the order of a Morton curve, followed by the instances of meshes,
// each in the order of its mesh's prototype. All positions are 32-bit offsets from the image's base, so that
// the static part can be saved, mapped elsewhere and sent to another process of the same byte order; the
// static part carries a version and a checksum. Words are in the host's order; SPEs of another order read a
// SharedImage.
#pragma once

#include "celltrace/scene.hpp"
#include "memory/aligned_block.hpp"
#include "prepare/eye.hpp"
#include "prepare/pass.hpp"
#include "records/image.hpp"
#include "records/instance.hpp"
#include "records/object.hpp"
#include "scene_image/object_form.hpp"
#include "scene_image/solid_boundary.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace celltrace {

struct ImageParts;

constexpr std::uint32_t kImageMagic = 0x43545349; // "CTSI"
constexpr std::uint32_t kImageVersion = 19;

/// The data of its scene that a SceneImage keeps; each of the first two takes 4 bytes per object.
struct ImageMemory {
  bool updatable = false; ///< needed by update() and update_surfaces()
  bool owners = false;    ///< needed by owner_of()
  /// True if the camera may move in later frames, so that is_for() is asked.
  bool eye_moves = false;
  /// The largest size of the image and its BVH in bytes; 0: no limit but memory.
  std::uint64_t most_bytes = 0;
};

/// The image of a scene. Thread safety: as a standard container.
class SceneImage {
public:
  /// Makes an object without an image; only assign() may be called.
  SceneImage() = default;
  /// Builds the static part. Throws InputError if validate() does, if an object's coordinates exceed the
  /// range of single precision, or if the image would pass 4 GB.
  explicit SceneImage(const Scene& scene);
  /// Takes over a static part that to_bytes() returned. Throws InputError unless version, checksum, sizes and
  /// every offset in it are right.
  static SceneImage from_bytes(std::span<const std::byte> bytes);

  /// Least number of objects per thread; with fewer, starting threads takes longer than they save.
  static constexpr std::uint32_t kObjectsAThread = 32768;
  /// Becomes the image of `scene`, using up to `threads` threads with at least `objects_a_thread` objects
  /// each; the result does not depend on their number. Reuses its memory if that is large enough, and uses
  /// `work`, which may grow. After an InputError it is unchanged; after another exception it may be empty.
  /// Reports progress to a ProgressMonitor, as update() does; either may leave no image when it is stopped.
  void assign(const Scene& scene, AlignedBlock& work, unsigned threads,
              std::uint32_t objects_a_thread = kObjectsAThread, const ImageMemory& memory = {});
  /// Updates the image in place for a scene that differs from that of assign() in numbers only: every record
  /// keeps its place, also those of the accelerator. Returns false, and changes nothing, if the image is not
  /// updatable or if counts differ: of objects, of objects that can be hit, or of entries of tables. Throws
  /// InputError as assign() does. Groups without instances keep their bounds, since a BVH is only built of a
  /// new image.
  bool update(const Scene& scene, AlignedBlock& work, unsigned threads,
              std::uint32_t objects_a_thread = kObjectsAThread);
  /// Updates the image as update() does if all objects are unchanged; but not for scenes in which patterns or
  /// lights refer to objects, or in which a material starts or ceases to be opaque, textured or the like.
  bool update_surfaces(const Scene& scene);
  /// Updates the image for the same scene with another camera if that moves nothing but boundaries of CSG's
  /// solids. Returns false, and changes nothing, if it may move more.
  bool update_boundaries(const Scene& scene);
  bool empty() const noexcept { return block_.size() == 0; }
  /// Returns whether the image shows the scene to a camera at `location` as an image made for that location
  /// would; always true at the location that the image was made for.
  bool is_for(const Vec3& location) const { return eye_.prepares_alike(location); }
  /// Returns whether is_for() may be false for some location; true unless ImageMemory::eye_moves is set.
  bool depends_on_eye() const { return eye_.matters(); }

  /// Returns the limits that the scene has passed; an image that was loaded has none.
  const PassedLimits& limits() const { return limits_; }

  /// Reserves room for an accelerator: a table of `table_bytes` bytes for voxels or nodes, and lists of
  /// `list_words` words in all. If the static part moves, the old address becomes invalid.
  void reserve_accelerator(std::uint64_t table_bytes, std::uint32_t list_words);

  const kernel::ImageHeader& header() const noexcept {
    return *reinterpret_cast<const kernel::ImageHeader*>(block_.data());
  }
  /// Returns a copy of the static part.
  std::vector<std::byte> to_bytes() const;
  const std::byte* base() const noexcept { return block_.data(); }
  /// Returns the image for the code that refits the accelerator.
  std::byte* mutable_base() noexcept { return block_.data(); }
  /// Returns the index in Scene::objects of the object that the record at this offset belongs to; kNoIndex if
  /// there is no object at the offset. Needs ImageMemory::owners.
  Index owner_of(std::uint32_t offset) const noexcept {
    if (kernel::is_instanced(offset)) return owner_of_instanced(offset);
    const kernel::ImageHeader& h = header();
    const auto first =
        h.object_offset - h.unbounded_count * static_cast<std::uint32_t>(sizeof(kernel::ObjectRecord));
    const std::size_t record = (offset - first) / sizeof(kernel::ObjectRecord);
    return offset >= first && record < owners_.size() ? owners_[record] : kNoIndex;
  }
  /// Returns the owner of each record: first the owners of unbounded objects, then those of all others.
  std::span<const Index> owners() const { return owners_; }
  /// Returns the offsets of the accelerator's table and lists, multiples of 128; valid after
  /// reserve_accelerator().
  std::uint32_t table_offset() const noexcept { return table_offset_; }
  std::uint32_t list_offset() const noexcept { return list_offset_; }
  /// Returns the offset of the end of the lists; valid after reserve_accelerator().
  std::uint32_t end_offset() const noexcept { return end_offset_; }

private:
  Index owner_of_instanced(std::uint32_t number) const noexcept;
  /// Remembers what the tables do not say about these parts.
  void remember(ImageParts& parts);

  /// The data of its scene that updates need.
  struct Origin {
    std::vector<std::uint32_t> places; ///< index: object that is no instance; kNoPlace if it cannot be hit
    std::uint32_t placed = 0;          ///< number of these that can be hit
    std::vector<std::uint32_t> groups; ///< groups of these objects
    std::vector<ObjectForm> forms;     ///< index: object of the scene
    std::vector<std::size_t> order;    ///< SceneObjects::order()
    std::vector<std::uint32_t> material_flags;
    std::size_t own_interiors = 0;   ///< number of records of objects without an interior
    bool surfaces_are_apart = false; ///< true if no pattern and no light refers to objects
  };

  AlignedBlock block_;
  std::unique_ptr<Origin> origin_; ///< null unless the image is updatable
  Eye eye_;                        ///< camera location that the image was made for
  PassedLimits limits_;
  std::vector<SolidBoundary> boundaries_; ///< kept if the eye may move
  std::vector<Index> owners_; ///< owners of unbounded objects, then of all others, in the order of records
  std::uint32_t table_offset_ = 0;
  std::uint32_t list_offset_ = 0;
  std::uint32_t end_offset_ = 0;
};

} // namespace celltrace
