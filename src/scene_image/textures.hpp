// The records of textures: materials with the layers below them, patterns and their maps, normals.
#pragma once

#include "celltrace/scene.hpp"
#include "records/atmosphere.hpp"
#include "records/image.hpp"
#include "records/material.hpp"
#include "records/pattern.hpp"
#include "records/random_tables.hpp"
#include "scene_image/pattern_space.hpp"
#include "scene_image/patterns.hpp"
#include "scene_image/texture_sharing.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace celltrace {

/// The sky sphere as a texture of layers; there is one.
Material sky_of(const Scene& scene);

/// References among the tables are indices until relocate() makes offsets of them; kNoOffset stays.
class TextureTables {
public:
  /// The first materials are the scene's, by index. The scene is valid. Throws InputError if a pattern is
  /// none that the kernel has.
  explicit TextureTables(const Scene& scene);

  /// Of ImageHeader::surface_nodes. `has_blends`: some surfaces are of several materials.
  std::uint32_t most_nodes(bool has_blends) const;

  /// Makes offsets in the image of all references.
  void relocate(const kernel::ImageHeader& header);

  std::vector<kernel::MaterialRecord> materials;
  std::vector<kernel::PatternRecord> patterns;
  std::vector<kernel::SpaceStepRecord> steps;
  std::vector<kernel::MapEntryRecord> entries;
  std::vector<kernel::NormalRecord> normals;
  std::vector<kernel::FinishRecord> finishes;
  bool has_clear_side = false;     ///< some of what looks different from inside lets light through
  bool by_surface = false;         ///< some materials are object_flag::by_surface,
  bool filters = false;            ///< some let light through,
  bool filters_by_surface = false; ///< and some do both
  std::vector<kernel::FeatureRecord> features;   ///< these three only if a pattern or a warp reads them
  std::vector<kernel::GradientRecord> gradients; ///< never without the features
  std::vector<kernel::WaveRecord> waves;
  std::vector<kernel::SlopeRecord> slopes; ///< one for each slope
  /// Whose insides are patterns: the first conditions of the scene's CSG, in this order.
  std::vector<std::shared_ptr<const Object>> objects;
  std::vector<kernel::RainbowRecord> rainbows; ///< those that are visible
  std::uint32_t sky;                           ///< index of the uppermost layer's material, or kNoOffset
  /// By material of the scene: the flags of an object that consists of it. They are object_flag's opaque,
  /// two_sided and by_surface, and those of material_word, which are below all of object_flag's but kinds.
  std::vector<std::uint32_t> object_flags;

private:
  /// What the textures of a tree have in common.
  struct Traits {
    bool opaque = true, spawns = false, textured = false, disturbed = false, two_sided = false,
         lit_behind = false, by_surface = false;
    std::uint32_t nodes = 0; ///< that a surface pushes, at most, for rays that go on by themselves
    void add(const Traits& other);
  };
  /// The entries of a map.
  struct EntryBlock {
    std::uint32_t first;
    std::size_t count;
  };
  struct Known {
    std::uint32_t index; ///< of a material, or of the pattern whose map it is
    Traits traits;
  };
  enum class Child : std::uint8_t { pattern, normal, material, none };
  /// Where a map is: in another one, or in none.
  enum class Place : std::uint8_t { inside, root };

  /// `inside`: what a pigment is in that is the pattern.
  Known add_pattern(const Pattern& pattern, const PatternSpace& outer, const PatternSpace& inside,
                    bool is_average, std::size_t entry_count);
  Known add_pigment(const Pigment& pigment, const PatternSpace& outer);
  /// `place`: where the material is, if it is a map.
  Traits fill_material(std::uint32_t index, const Material& material, const PatternSpace& outer, Place place);
  template <class T>
  Known add_map(const std::shared_ptr<const PatternMap<T>>& map, const PatternSpace& outer, Place place);
  Known add_material(const Material& material, const PatternSpace& outer, Place place);
  Known add_shared_material(const Material& material);
  std::uint32_t share_entries(const EntryBlock& block);
  Known add_normal(const Normal& normal, const PatternSpace& outer);
  void add_table(PatternTable table);
  void add_steps(kernel::PatternRecord& r, const std::vector<SpaceStep>& space);
  void set_list_heights(kernel::PatternRecord& r, const Pattern& pattern);
  std::uint32_t add_slopes(const std::vector<SlopePoint>& slopes);
  void add_rainbow(const Rainbow& rainbow);
  Traits fill(kernel::MapEntryRecord& entry, const Pigment& pigment);

  const Scene& scene_;
  std::uint32_t unmapped_nodes_ = 0; ///< Traits::nodes: the most of any material of the scene that is no map,
  std::vector<std::uint32_t> mapped_nodes_; ///< and of each that is
  std::vector<Child> children_;             ///< by entry, what its child is
  std::vector<PatternTable> tables_;        ///< by pattern, what it reads
  TextureSharing sharing_;
  /// Maps that several share, by address; where sharing is needed, those that are in others apart.
  std::map<std::pair<const void*, Place>, Known> known_;
  std::unordered_multimap<std::size_t, std::pair<const Material*, Known>>
      known_materials_;                                     ///< entries of relative maps, by a hash
  std::unordered_multimap<std::size_t, EntryBlock> blocks_; ///< entries of maps, by a hash
  std::vector<std::shared_ptr<const void>>
      made_; ///< maps that are not the scene's, so that no other has their address
};

} // namespace celltrace
