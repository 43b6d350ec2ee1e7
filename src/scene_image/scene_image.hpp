// SceneImage: a Scene in the flat binary form that the SPEs read.
//
// One contiguous, 128-byte aligned block: header, lights, materials, patterns and their maps, normals,
// blends, interiors, conditions of CSG, insides of meshes, instances and their meshes, extra records,
// objects, groups of objects and which of them are copies (the static part, written here), then the voxels or
// nodes and the object lists of the accelerator (PREPARE FRAME's). From kMinObjectsToOrder on, objects lie in
// the order of a Morton curve, and behind them instances of meshes, each in the order of its mesh's
// prototype. All positions are 32-bit offsets from its base, so that the static part can be saved, mapped
// elsewhere and sent to another process of the same byte order; it carries a version and a checksum. Words
// are in the host's order: SharedImage is what SPEs of another order read.
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

/// What a SceneImage remembers of its scene, 4 bytes an object each.
struct ImageMemory {
  bool updatable = false; ///< what update() and update_surfaces() need
  bool owners = false;    ///< for owner_of()
  /// Whether the camera may be elsewhere in later frames, which is_for() is asked about.
  bool eye_moves = false;
  /// Bytes that the image and its BVH may take; 0: as many as there are.
  std::uint64_t most_bytes = 0;
};

/// Thread safety: as a standard container.
class SceneImage {
public:
  /// Without an image: nothing but assign() makes sense.
  SceneImage() = default;
  /// Builds the static part. Throws InputError as validate() does, if an object's coordinates leave what
  /// single precision can hold, and if the image would pass 4 GB.
  explicit SceneImage(const Scene& scene);
  /// Takes over a static part as to_bytes() gave it. Throws InputError unless version, checksum, sizes and
  /// every offset in it are right.
  static SceneImage from_bytes(std::span<const std::byte> bytes);

  /// With fewer, starting threads takes longer than they save.
  static constexpr std::uint32_t kObjectsAThread = 32768;
  /// Becomes the image of `scene` in up to `threads` threads, which have so many objects each at least; what
  /// comes out does not depend on their number. Keeps its memory where that is large enough, and uses `work`,
  /// which may grow. After an InputError it is as before; after another exception it may be empty.
  /// A BuildWatch hears of it, and of update(), which may leave no image when it is stopped, either.
  void assign(const Scene& scene, AlignedBlock& work, unsigned threads,
              std::uint32_t objects_a_thread = kObjectsAThread, const ImageMemory& memory = {});
  /// Becomes the image of a scene that is the one given to assign() but for numbers in it, every record at
  /// its place, also the accelerator's. False, and nothing has changed, if it was not updatable, or if there
  /// is more or less than there was: objects, what of them can be hit, entries of tables. Throws InputError
  /// as assign() does. Groups without instances keep their bounds: a BVH is built of an image that is new.
  bool update(const Scene& scene, AlignedBlock& work, unsigned threads,
              std::uint32_t objects_a_thread = kObjectsAThread);
  /// As update(), where all objects are as they were; but not for scenes in which patterns or lights refer to
  /// objects, or where materials become opaque, textured or the like or cease to be.
  bool update_surfaces(const Scene& scene);
  /// Becomes the image of the same scene with another camera, if that moves nothing but boundaries of CSG's
  /// solids. False, and nothing has changed, if it may move more.
  bool update_boundaries(const Scene& scene);
  bool empty() const noexcept { return block_.size() == 0; }
  /// Returns whether the image shows the scene to a camera at `location` as one that was made for it would:
  /// always at the location that it was made for.
  bool is_for(const Vec3& location) const { return eye_.prepares_alike(location); }
  /// Returns whether there may be locations that it is not for; it says yes unless ImageMemory::eye_moves is
  /// set.
  bool depends_on_eye() const { return eye_.matters(); }

  /// Returns the limits that the scene has passed; an image that was saved does not know them.
  const PassedLimits& limits() const { return limits_; }

  /// Makes room for an accelerator: a table of `table_bytes` bytes, of voxels or of nodes, and lists of
  /// `list_words` words in all; where the static part moves, the old address becomes invalid.
  void reserve_accelerator(std::uint64_t table_bytes, std::uint32_t list_words);

  const kernel::ImageHeader& header() const noexcept {
    return *reinterpret_cast<const kernel::ImageHeader*>(block_.data());
  }
  /// The static part.
  std::vector<std::byte> to_bytes() const;
  const std::byte* base() const noexcept { return block_.data(); }
  /// For whoever refits the accelerator.
  std::byte* mutable_base() noexcept { return block_.data(); }
  /// The index in Scene::objects of what the record of an object at this offset belongs to; kNoIndex for
  /// offsets where there is none. If it remembers owners.
  Index owner_of(std::uint32_t offset) const noexcept {
    if (kernel::is_instanced(offset)) return owner_of_instanced(offset);
    const kernel::ImageHeader& h = header();
    const auto first =
        h.object_offset - h.unbounded_count * static_cast<std::uint32_t>(sizeof(kernel::ObjectRecord));
    const std::size_t record = (offset - first) / sizeof(kernel::ObjectRecord);
    return offset >= first && record < owners_.size() ? owners_[record] : kNoIndex;
  }
  /// The same by record: of unbounded objects and then all others.
  std::span<const Index> owners() const { return owners_; }
  /// Offsets of the two, multiples of 128; valid after reserve_accelerator().
  std::uint32_t table_offset() const noexcept { return table_offset_; }
  std::uint32_t list_offset() const noexcept { return list_offset_; }
  /// Behind the lists; valid as the others.
  std::uint32_t end_offset() const noexcept { return end_offset_; }

private:
  Index owner_of_instanced(std::uint32_t number) const noexcept;
  /// Remembers of these parts what tables do not say.
  void remember(ImageParts& parts);

  /// What it remembers of its scene for updates.
  struct Origin {
    std::vector<std::uint32_t> places; ///< by object that is no instance, where it is, or kNoPlace
    std::uint32_t placed = 0;          ///< of these, those that can be hit
    std::vector<std::uint32_t> groups; ///< of them
    std::vector<ObjectForm> forms;     ///< by object of the scene
    std::vector<std::size_t> order;    ///< SceneObjects::order()
    std::vector<std::uint32_t> material_flags;
    std::size_t own_interiors = 0;   ///< records of objects without an interior
    bool surfaces_are_apart = false; ///< no pattern and no light refers to objects
  };

  AlignedBlock block_;
  std::unique_ptr<Origin> origin_; ///< null unless it is updatable
  Eye eye_;                        ///< that it was made for
  PassedLimits limits_;
  std::vector<SolidBoundary> boundaries_; ///< if the eye may move
  std::vector<Index> owners_; ///< of unbounded objects and then all others, in the order of their records
  std::uint32_t table_offset_ = 0;
  std::uint32_t list_offset_ = 0;
  std::uint32_t end_offset_ = 0;
};

} // namespace celltrace
