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

/// The data of its scene that a SceneImage keeps. Each of the first two members takes 4 bytes per object.
struct ImageMemory {
  bool updatable = false; ///< keeps the data that update() and update_surfaces() need
  bool owners = false;    ///< keeps the data that owner_of() needs
  /// True if the camera may move in later frames, before which is_for() is called.
  bool eye_moves = false;
  /// Limit on the size of the image with its BVH, in bytes; 0 means no limit.
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
  /// Makes an image of a static part that to_bytes() returned. Throws InputError unless version, checksum,
  /// sizes and every offset in it are right.
  static SceneImage from_bytes(std::span<const std::byte> bytes);

  /// Least number of objects per thread; with fewer, starting threads takes longer than they save.
  static constexpr std::uint32_t kObjectsAThread = 32768;
  /// Becomes the image of `scene`, using up to `threads` threads with at least `objects_a_thread` objects
  /// each; the number of threads does not change the result. Reuses its memory if that is large enough, and
  /// uses `work` as work memory, which may grow. After an InputError the image is unchanged; after another
  /// exception it may be empty. Reports progress to a ProgressMonitor, as update() does; if the monitor stops
  /// either function, there may be no image.
  void assign(const Scene& scene, AlignedBlock& work, unsigned threads,
              std::uint32_t objects_a_thread = kObjectsAThread, const ImageMemory& memory = {});
  /// Updates the image in place for a scene that differs from that of assign() in numbers only: every record
  /// keeps its place, including those of the accelerator. Returns false if the image is not updatable, or if
  /// numbers of objects, of objects that can be hit, or of entries of tables differ; then the image may have
  /// changed and has to be built anew. Throws InputError as assign() does. Groups without instances keep
  /// their bounds, since a BVH is only built for a new image.
  bool update(const Scene& scene, AlignedBlock& work, unsigned threads,
              std::uint32_t objects_a_thread = kObjectsAThread);
  /// Updates the image as update() does, for a scene in which no object has changed. Returns false, and
  /// changes nothing, if update() would return false, if patterns or lights refer to objects, or if a
  /// material has become opaque or textured, or is no longer.
  bool update_surfaces(const Scene& scene);
  /// Updates the image for the same scene with another camera. Returns false, and changes nothing, if the
  /// camera's move may change more than boundaries of CSG's solids.
  bool update_boundaries(const Scene& scene);
  bool empty() const noexcept { return block_.size() == 0; }
  /// Returns whether an image made for a camera at `location` would be the same; always true at the location
  /// for which this image was made.
  bool is_for(const Vec3& location) const { return eye_.prepares_alike(location); }
  /// Returns whether is_for() may be false for some location; true unless ImageMemory::eye_moves is set.
  bool depends_on_eye() const { return eye_.matters(); }

  /// Returns the limits that the scene has passed; an image that was loaded has none.
  const PassedLimits& limits() const { return limits_; }

  /// Reserves room for an accelerator: a table of `table_bytes` bytes for voxels or nodes, and lists of
  /// `list_words` words in all. May move the image, after which old addresses are invalid.
  void reserve_accelerator(std::uint64_t table_bytes, std::uint32_t list_words);

  const kernel::ImageHeader& header() const noexcept {
    return *reinterpret_cast<const kernel::ImageHeader*>(block_.data());
  }
  /// Returns a copy of the static part.
  std::vector<std::byte> to_bytes() const;
  const std::byte* base() const noexcept { return block_.data(); }
  /// Returns the image's first byte to code that refits the accelerator.
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
  /// Returns the owner of each record: first the owners of unbounded objects, then of all other objects.
  std::span<const Index> owners() const { return owners_; }
  /// Returns the offsets of the accelerator's table and lists, multiples of 128; valid after
  /// reserve_accelerator().
  std::uint32_t table_offset() const noexcept { return table_offset_; }
  std::uint32_t list_offset() const noexcept { return list_offset_; }
  /// Returns the offset of the end of the lists; valid after reserve_accelerator().
  std::uint32_t end_offset() const noexcept { return end_offset_; }

private:
  Index owner_of_instanced(std::uint32_t number) const noexcept;
  /// Keeps the data of these parts that the tables do not hold.
  void remember(ImageParts& parts);

  /// The data of the scene that updates need.
  struct Origin {
    std::vector<std::uint32_t> places; ///< index: object that is no instance; kNoPlace if it cannot be hit
    std::uint32_t placed = 0;          ///< number of these objects that can be hit
    std::vector<std::uint32_t> groups; ///< groups of these objects
    std::vector<ObjectForm> forms;     ///< index: object of the scene
    std::vector<std::size_t> order;    ///< SceneObjects::order()
    std::vector<std::uint32_t> material_flags;
    std::size_t own_interiors = 0;   ///< number of interior records of objects without an interior
    bool surfaces_are_apart = false; ///< true if no pattern and no light refers to objects
  };

  AlignedBlock block_;
  std::unique_ptr<Origin> origin_; ///< null unless the image is updatable
  Eye eye_;                        ///< camera location that the image was made for
  PassedLimits limits_;
  std::vector<SolidBoundary> boundaries_; ///< boundaries of CSG's solids; empty unless the eye may move
  std::vector<Index> owners_; ///< owners of unbounded objects, then of all others, in the order of records
  std::uint32_t table_offset_ = 0;
  std::uint32_t list_offset_ = 0;
  std::uint32_t end_offset_ = 0;
};

} // namespace celltrace
