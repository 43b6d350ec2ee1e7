// The records of textures: materials with the layers below them, patterns and their maps, normals.
#pragma once

#include "celltrace/scene.hpp"
#include "records/atmosphere.hpp"
#include "records/image.hpp"
#include "records/material.hpp"
#include "records/function.hpp"
#include "records/pattern.hpp"
#include "records/picture.hpp"
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

/// Returns the sky sphere as a texture of layers; the scene must have one.
Material sky_of(const Scene& scene);

/// The tables of all textures. References among the tables are indices until relocate() turns them into
/// offsets; kNoOffset stays kNoOffset.
class TextureTables {
public:
  /// Builds the tables. The first materials have the indices of the scene's materials. The scene must be
  /// valid. Throws InputError if the kernel does not know a pattern.
  explicit TextureTables(const Scene& scene);

  /// Returns ImageHeader::surface_nodes. `has_blends` tells whether some surfaces have several materials.
  std::uint32_t most_nodes(bool has_blends) const;

  /// Turns all references into offsets in the image.
  void relocate(const kernel::ImageHeader& header);

  std::vector<kernel::MaterialRecord> materials;
  std::vector<kernel::PatternRecord> patterns;
  std::vector<kernel::SpaceStepRecord> steps;
  std::vector<kernel::MapEntryRecord> entries;
  std::vector<kernel::NormalRecord> normals;
  std::vector<kernel::FinishRecord> finishes;
  bool has_translucent_side = false; ///< true if a material with another look inside lets light through
  bool by_surface = false;           ///< true if a material has object_flag::by_surface
  bool filters = false;              ///< true if a material lets light through
  bool filters_by_surface = false;   ///< true if one material has both properties
  std::vector<kernel::FeatureRecord>
      features; ///< this table and the next two are empty unless a pattern or a warp reads them
  std::vector<kernel::GradientRecord> gradients; ///< empty if there are no features
  std::vector<kernel::WaveRecord> waves;
  std::vector<kernel::SlopeRecord> slopes; ///< one record for each slope
  std::vector<kernel::PictureRecord> pictures; ///< one record for each pattern that is a picture
  std::vector<kernel::FunctionStepRecord> function_steps; ///< the code of all functions
  std::vector<kernel::TexelTileRecord> texel_tiles; ///< of all pictures; `tiles` of a record is an index
  /// The objects whose insides are patterns. Their conditions come first in the scene's CSG, in this order.
  std::vector<std::shared_ptr<const Object>> objects;
  std::vector<kernel::RainbowRecord> rainbows; ///< visible rainbows only
  std::uint32_t sky;                           ///< index of the sky's uppermost layer, or kNoOffset
  /// Flags of an object that consists of a material, by material of the scene: opaque, two_sided and
  /// by_surface of object_flag, and the flags of material_word. Flags of material_word lie below all flags of
  /// object_flag except the kinds.
  std::vector<std::uint32_t> object_flags;

private:
  /// The properties of all textures in a tree together.
  struct Traits {
    bool opaque = true, spawns = false, textured = false, disturbed = false, two_sided = false,
         lit_behind = false, by_surface = false;
    std::uint32_t nodes = 0; ///< most nodes that a surface pushes for rays that continue on their own
    void add(const Traits& other);
  };
  /// The entries of a map.
  struct EntryBlock {
    std::uint32_t first;
    std::size_t count;
  };
  struct Known {
    std::uint32_t index; ///< index of a material, or of the pattern that has a map
    Traits traits;
  };
  enum class Child : std::uint8_t { pattern, normal, material, none };
  /// The position of a map: inside another map, or not.
  enum class Place : std::uint8_t { inside, root };

  /// Adds a pattern. `inside` is the space of a pigment that the pattern consists of.
  Known add_pattern(const Pattern& pattern, const PatternSpace& outer, const PatternSpace& inside,
                    bool is_average, std::size_t entry_count);
  Known add_pigment(const Pigment& pigment, const PatternSpace& outer);
  /// Writes a material and its layers. `place` is the place of the material's map, if it has one.
  Traits fill_material(std::uint32_t index, const Material& material, const PatternSpace& outer, Place place);
  template <class T>
  Known add_map(const std::shared_ptr<const PatternMap<T>>& map, const PatternSpace& outer, Place place);
  Known add_material(const Material& material, const PatternSpace& outer, Place place);
  Known add_shared_material(const Material& material);
  std::uint32_t tiles_of(const std::shared_ptr<const Picture>& picture);
  std::uint32_t share_entries(const EntryBlock& block);
  Known add_normal(const Normal& normal, const PatternSpace& outer);
  void add_table(PatternTable table);
  void add_steps(kernel::PatternRecord& r, const std::vector<SpaceStep>& space);
  void set_list_heights(kernel::PatternRecord& r, const Pattern& pattern);
  std::uint32_t add_slopes(const std::vector<SlopePoint>& slopes);
  void add_rainbow(const Rainbow& rainbow);
  Traits fill(kernel::MapEntryRecord& entry, const Pigment& pigment);

  const Scene& scene_;
  std::uint32_t unmapped_nodes_ =
      0; ///< largest Traits::nodes of the scene's materials that are no texture maps
  std::vector<std::uint32_t> mapped_nodes_; ///< Traits::nodes of each texture map and two-sided material
  std::vector<Child> children_;             ///< index: entry; its child
  std::unordered_map<const Picture*, std::uint32_t> known_pictures_; ///< index of a picture's first tile
  std::vector<PatternTable> tables_;        ///< index: pattern; the table it reads
  TextureSharing sharing_;
  /// Maps that several textures share, by address; if sharing is needed, the same map inside others has
  /// another entry.
  std::map<std::pair<const void*, Place>, Known> known_;
  std::unordered_multimap<std::size_t, std::pair<const Material*, Known>>
      known_materials_;                                     ///< entries of relative maps, by hash
  std::unordered_multimap<std::size_t, EntryBlock> blocks_; ///< entries of maps, by hash
  std::vector<std::shared_ptr<const void>>
      made_; ///< maps that are not the scene's, kept so that no other map gets their address
};

} // namespace celltrace
