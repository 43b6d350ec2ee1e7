// Checks the tables of textures in a scene image.
#include "kernel/textures/list.hpp"
#include "kernel/textures/map_walk.hpp"
#include "records/light_feature.hpp"
#include "scene_image/image_checks.hpp"
#include "scene_image/patterns.hpp"

#include <algorithm>
#include <vector>

namespace celltrace {

using namespace kernel;

namespace {

class TextureCheck {
public:
  TextureCheck(const std::byte* base, const ImageHeader& h)
      : base_(base), h_(h), materials_(base, h.material_offset, h.material_count),
        patterns_(base, h.pattern_offset, h.pattern_count),
        steps_(base, h.space_step_offset, h.space_step_count),
        entries_(base, h.map_entry_offset, h.map_entry_count),
        normals_(base, h.normal_offset, h.normal_count) {}

  /// Returns true if every reference leads to a record of the right table, and no walk through maps and
  /// layers is too long.
  bool holds() {
    for (std::uint32_t i = 0; i < h_.pattern_count; ++i)
      if (!is_sound(patterns_[i])) return false;
    const Table<FogRecord> fogs(base_, h_.fog_offset, h_.fog_count);
    for (std::uint32_t i = 0; i < h_.fog_count; ++i)
      if (!turbulence_is_sound(fogs[i].turbulence)) return false;
    const Table<RainbowRecord> rainbows(base_, h_.rainbow_offset, h_.rainbow_count);
    for (std::uint32_t i = 0; i < h_.rainbow_count; ++i) {
      const std::uint32_t first = entries_.find(rainbows[i].entries), count = rainbows[i].entry_count;
      if (first == entries_.count || count == 0 || count > entries_.count - first) return false;
    }
    for (std::uint32_t i = 0; i < h_.space_step_count; ++i)
      if (!is_sound(steps_[i])) return false;
    if (h_.feature_count != 0 && h_.feature_count != kFeatures) return false;
    if (h_.gradient_count != 0 && h_.gradient_count != kGradients) return false;
    find_pigment_depths();
    for (std::uint32_t i = 0; i < h_.normal_count; ++i)
      if (!normal_is_sound(i)) return false;
    // Checks the last material first, because materials may refer only to later materials.
    for (std::uint32_t i = h_.material_count; i-- > 0;)
      if (!material_is_sound(i)) return false;
    if (!surface_flags_are_complete()) return false;
    if (h_.sky == kNoOffset) return true;
    const std::uint32_t sky = materials_.find(h_.sky);
    return sky != materials_.count && (materials_[sky].flags & material_flag::mapped) == 0 &&
           !material_depends_[sky];
  }

private:
  /// Returns true if the code of a function is in the table, and its steps have registers that there are.
  bool has_code(const PatternRecord& r) const {
    const float count = r.parameter[0];
    if (!refers_to(r.table, h_.function_step_offset, h_.function_step_count, sizeof(FunctionStepRecord)))
      return false;
    const std::uint32_t left =
        h_.function_step_count - (r.table - h_.function_step_offset) / std::uint32_t{sizeof(FunctionStepRecord)};
    if (!(count >= 1 && count <= static_cast<float>(left))) return false;
    const auto* const steps = reinterpret_cast<const FunctionStepRecord*>(base_ + r.table);
    return std::all_of(steps, steps + static_cast<std::uint32_t>(count), [](const FunctionStepRecord& step) {
      const auto is_register = [](std::uint32_t number) { return number < kFunctionRegisters; };
      return (step.operation_and_result & 0xFFFF) < kFunctionOperations &&
             is_register(step.operation_and_result >> 16) && is_register(step.a_and_b & 0xFFFF) &&
             is_register(step.a_and_b >> 16) && is_register(step.c);
    });
  }
  /// Returns true if a picture has as many tiles as its size says, and a size that arithmetic can hold.
  bool has_texels(const PictureRecord& r) const {
    constexpr std::uint32_t kSide = TexelTileRecord::kSide, kMost = 65535;
    if (r.width - 1 >= kMost || r.height - 1 >= kMost || r.tile_columns != (r.width + kSide - 1) / kSide)
      return false;
    const std::uint64_t tiles = std::uint64_t{r.tile_columns} * ((r.height + kSide - 1) / kSide);
    if (!refers_to(r.tiles, h_.texel_tile_offset, h_.texel_tile_count, sizeof(TexelTileRecord))) return false;
    return tiles <= h_.texel_tile_count - (r.tiles - h_.texel_tile_offset) / sizeof(TexelTileRecord);
  }

  template <class Record> struct Table {
    const Record* records;
    std::uint32_t offset, count;
    Table(const std::byte* base, std::uint32_t at, std::uint32_t n)
        : records(reinterpret_cast<const Record*>(base + at)), offset(at), count(n) {}
    const Record& operator[](std::uint32_t i) const { return records[i]; }
    /// Returns the index of the record at an offset; `count` if there is no record at the offset.
    std::uint32_t find(std::uint32_t at) const {
      return refers_to(at, offset, count, sizeof(Record)) ? (at - offset) / std::uint32_t{sizeof(Record)}
                                                          : count;
    }
  };

  static bool turbulence_is_sound(const TurbulenceWords& t) { return t.octaves <= 10; }

  bool is_sound(const PatternRecord& r) const {
    if ((r.kind_and_flags & pattern_flag::kind_mask) >= Patterns::kCount) return false;
    if (!turbulence_is_sound(r.turbulence)) return false;
    if (r.entry_count != 0) {
      const std::uint32_t first = entries_.find(r.entries);
      if (first == entries_.count || r.entry_count > entries_.count - first) return false;
    }
    for (std::uint32_t i = 0; i < r.step_count; ++i)
      if (!refers_to(r.steps + i * std::uint32_t{sizeof(SpaceStepRecord)}, h_.space_step_offset,
                     h_.space_step_count, sizeof(SpaceStepRecord)))
        return false;
    return table_is_sound(r);
  }
  /// Returns true if a step is valid. A black hole with turbulence must refer to the table of features.
  bool is_sound(const SpaceStepRecord& r) const {
    const std::uint32_t kind = r.kind_and_flags & warp_flag::kind_mask;
    if (kind >= kWarpKinds || !turbulence_is_sound(r.turbulence)) return false;
    if ((r.kind_and_flags >> warp_flag::axis_shift & 3) == 3) return false;
    const float(&amount)[3] = r.turbulence.amount;
    const bool is_moved = !(amount[0] == 0 && amount[1] == 0 && amount[2] == 0);
    return kind != static_cast<std::uint32_t>(WarpKind::black_hole) || !is_moved || features_are_at(r.table);
  }
  bool features_are_at(std::uint32_t offset) const {
    return h_.feature_count == kFeatures && offset == h_.feature_offset;
  }
  /// Returns true if the table that a pattern reads exists and is complete, so that no hash leads out of it.
  bool table_is_sound(const PatternRecord& r) const {
    switch (pattern_table(r.kind_and_flags)) {
    case PatternTable::none:
      return (r.kind_and_flags & pattern_flag::kind_mask) != kPatternKind<FractalPattern> ||
             (r.parameter[2] >= 1 && r.parameter[2] <= 65535);
    case PatternTable::features:
      return features_are_at(r.table);
    case PatternTable::gradients:
      return h_.gradient_count == kGradients && r.table == h_.gradient_offset &&
             features_are_at(r.table - kFeatures * std::uint32_t{sizeof(FeatureRecord)});
    case PatternTable::waves:
      return r.parameter[0] >= 1 && r.parameter[0] <= static_cast<float>(h_.wave_count) &&
             r.table == h_.wave_offset;
    case PatternTable::slopes:
      return refers_to(r.table, h_.slope_offset, h_.slope_count, sizeof(SlopeRecord));
    case PatternTable::functions:
      return has_code(r);
    case PatternTable::pictures:
      return refers_to(r.table, h_.picture_offset, h_.picture_count, sizeof(PictureRecord)) &&
             has_texels(*reinterpret_cast<const PictureRecord*>(base_ + r.table));
    case PatternTable::pigments:
      return patterns_.find(r.table) != patterns_.count;
    case PatternTable::objects:
      return refers_to(r.table, h_.csg_offset, h_.csg_count, sizeof(CsgRecord));
    }
    return false;
  }

  /// Sets, by pattern, whether it needs more than a point and how deep maps nest in it: 0 if it has no map or
  /// an invalid map. Patterns may refer only to earlier patterns.
  void find_pigment_depths() {
    pigment_depth_.assign(h_.pattern_count, 0);
    pattern_depends_.assign(h_.pattern_count, false);
    for (std::uint32_t i = 0; i < h_.pattern_count; ++i) {
      pigment_depth_[i] = depth_of(i);
      const PatternRecord& r = patterns_[i];
      bool depends = pattern_depends(i);
      for (std::uint32_t entry = 0; pigment_depth_[i] > 1 && entry < r.entry_count; ++entry)
        if (const std::uint32_t child = child_of(r, entry); child != kNoOffset)
          depends = depends || pattern_depends_[patterns_.find(child)];
      pattern_depends_[i] = depends;
    }
  }
  /// Returns whether a pattern needs more than a point, such as a normal. Ignores the pigment that it may
  /// consist of.
  static bool depends_by_itself(const PatternRecord& r) {
    return (r.kind_and_flags & pattern_flag::uv_mapping) != 0 ||
           Patterns::kReadSurfaces[r.kind_and_flags & pattern_flag::kind_mask];
  }
  /// Returns whether a pattern, or the pigment that it consists of, needs more than a point. Earlier patterns
  /// must have been checked.
  bool pattern_depends(std::uint32_t pattern) const {
    const PatternRecord& r = patterns_[pattern];
    return depends_by_itself(r) || (is_pigment(r) && pattern_depends_[patterns_.find(r.table)]);
  }
  /// Returns how deep maps nest in the pigment that a pattern consists of; 0 for any other pattern.
  std::uint32_t depth_inside(std::uint32_t pattern) const {
    const PatternRecord& r = patterns_[pattern];
    return is_pigment(r) ? pigment_depth_[patterns_.find(r.table)] : 0;
  }
  /// Returns true if a pattern does not consist of a pigment, or if it is marked as nested and its pigment is
  /// valid and comes before it.
  bool inside_is_sound(std::uint32_t pattern) const {
    const PatternRecord& r = patterns_[pattern];
    if (!is_pigment(r)) return true;
    return (r.kind_and_flags & pattern_flag::nested) != 0 && patterns_.find(r.table) < pattern &&
           !is_relative(patterns_.find(r.table)) && depth_inside(pattern) != 0;
  }
  std::uint32_t depth_of(std::uint32_t pattern) const {
    const PatternRecord& r = patterns_[pattern];
    if (r.entry_count == 0 || !inside_is_sound(pattern)) return 0;
    if (is_of_colours(r)) return 1;
    std::uint32_t deepest = depth_inside(pattern);
    if (deepest == kDeepestMapWalk) return 0;
    for (std::uint32_t i = 0; i < r.entry_count; ++i) {
      const std::uint32_t child = child_of(r, i);
      if (child == kNoOffset) continue;
      if ((r.kind_and_flags & pattern_flag::nested) == 0) return 0;
      const std::uint32_t nested = patterns_.find(child);
      if (nested >= pattern || is_relative(nested) || pigment_depth_[nested] == 0 ||
          pigment_depth_[nested] == kDeepestMapWalk)
        return 0;
      deepest = std::max(deepest, pigment_depth_[nested]);
    }
    return deepest + 1;
  }
  /// Returns true for a pattern that computes a colour from its map's entries, as is_colour() says.
  static bool is_of_colours(const PatternRecord& r) {
    return (r.kind_and_flags & pattern_flag::average) == 0 &&
           is_colour(r.kind_and_flags & pattern_flag::kind_mask);
  }
  /// Returns true for a relative pattern, which may not be nested in another map.
  bool is_relative(std::uint32_t pattern) const {
    return (patterns_[pattern].kind_and_flags & pattern_flag::relative) != 0;
  }
  std::uint32_t child_of(const PatternRecord& r, std::uint32_t entry) const {
    return entries_[entries_.find(r.entries) + entry].child;
  }

  /// Returns true if a normal is valid. Call it for the first normal first: normals may refer only to earlier
  /// normals.
  bool normal_is_sound(std::uint32_t normal) {
    const NormalRecord& r = normals_[normal];
    const std::uint32_t pattern = patterns_.find(r.pattern);
    std::uint32_t depth = 0;
    if (pattern == patterns_.count) return false;
    if (!inside_is_sound(pattern) || is_relative(pattern)) return false;
    if (is_of_colours(patterns_[pattern])) return false;
    bool depends = pattern_depends(pattern);
    depth = depth_inside(pattern);
    if (r.is_mapped != 0)
      for (std::uint32_t i = 0; i < patterns_[pattern].entry_count; ++i) {
        const std::uint32_t child = normals_.find(child_of(patterns_[pattern], i));
        if (child >= normal) return false;
        depth = std::max(depth, normal_depth_[child]);
        depends = depends || normal_depends_[child];
      }
    normal_depth_.push_back(r.is_mapped != 0 ? depth + 1 : depth);
    normal_depends_.push_back(depends);
    return normal_depth_.back() <= kDeepestMapWalk &&
           (r.is_mapped == 0 || patterns_[pattern].entry_count != 0);
  }

  bool material_is_sound(std::uint32_t material) {
    const MaterialRecord& r = materials_[material];
    const auto has = [&](std::uint32_t flag) { return (r.flags & flag) != 0; };
    if (material_depth_.empty()) {
      layers_ = material_depth_ = std::vector<std::uint32_t>(h_.material_count, 0);
      material_depends_.assign(h_.material_count, false);
    }
    const bool mapped = has(material_flag::mapped);
    bool depends = false;
    if (mapped || has(material_flag::patterned)) {
      const std::uint32_t pattern = patterns_.find(r.pattern);
      if (pattern == patterns_.count) return false;
      if (mapped ? !inside_is_sound(pattern) : pigment_depth_[pattern] == 0) return false;
      if (mapped && is_of_colours(patterns_[pattern])) return false;
      depends = pattern_depends_[pattern];
      if (mapped) material_depth_[material] = depth_inside(pattern) + 1;
      for (std::uint32_t i = 0; mapped && i < patterns_[pattern].entry_count; ++i) {
        const std::uint32_t child = materials_.find(child_of(patterns_[pattern], i));
        if (child == materials_.count || child <= material || is_relative_map(materials_[child]))
          return false;
        material_depth_[material] = std::max(material_depth_[material], material_depth_[child] + 1);
        depends = depends || material_depends_[child];
      }
      if (mapped && (patterns_[pattern].entry_count == 0 || material_depth_[material] > kDeepestMapWalk))
        return false;
    }
    if (r.finish != kNoOffset &&
        !refers_to(r.finish, h_.finish_offset, h_.finish_count, sizeof(FinishRecord)))
      return false;
    if (has(material_flag::disturbed)) {
      const std::uint32_t normal = normals_.find(r.normal);
      if (normal == normals_.count) return false;
      depends = depends || normal_depends_[normal];
    }
    material_depends_[material] = depends;
    if (!has(material_flag::layered)) return r.below == kNoOffset;
    const std::uint32_t below = materials_.find(r.below);
    if (below == materials_.count || below <= material || mapped ||
        (materials_[below].flags & material_flag::mapped) != 0)
      return false;
    layers_[material] = layers_[below] + 1;
    material_depends_[material] = depends || material_depends_[below];
    return layers_[material] <= kMostLayers;
  }

  bool is_relative_map(const MaterialRecord& r) const {
    return (r.flags & material_flag::mapped) != 0 && is_relative(patterns_.find(r.pattern));
  }

  /// Returns true if flags tell which objects have patterns that need more than points: the objects' own
  /// flags, and the scene's flags for shadow rays, which also tell whether such an object lets light through.
  bool surface_flags_are_complete() const {
    const auto* objects =
        reinterpret_cast<const ObjectRecord*>(base_ + h_.object_offset) - h_.unbounded_count;
    const auto depends = [&](std::uint32_t offset, bool two_sided) {
      const std::uint32_t material = materials_.find(offset);
      return material_depends_[material] ||
             (two_sided && material_depends_[materials_.find(materials_[material].inside)]);
    };
    for (std::uint32_t i = 0; i < h_.object_count + h_.unbounded_count; ++i) {
      const ObjectRecord& object = objects[i];
      const auto has = [&](std::uint32_t flag) { return (object.kind_and_flags & flag) != 0; };
      const std::uint32_t material = material_word::offset(object.material);
      bool object_depends = false;
      if (has(object_flag::blended)) {
        const BlendRecord& blend = *reinterpret_cast<const BlendRecord*>(base_ + material);
        object_depends = depends(blend.material[0], has(object_flag::two_sided)) ||
                         depends(blend.material[1], false) || depends(blend.material[2], false);
      } else {
        object_depends = depends(material, has(object_flag::two_sided));
      }
      if (!object_depends) continue;
      const std::uint32_t features =
          light_feature::by_surface | (has(object_flag::opaque) ? 0 : std::uint32_t{light_feature::stepwise});
      if (!has(object_flag::by_surface) || (h_.light_features & features) != features) return false;
    }
    // Triangles of instances have no such flag, so that their patterns must not need more than points.
    const auto is_plain = [&](std::uint32_t offset) {
      const std::uint32_t material = materials_.find(offset);
      return material == materials_.count || !material_depends_[material];
    };
    const auto* instances = reinterpret_cast<const InstanceRecord*>(base_ + h_.instance_offset);
    const auto* triangles = reinterpret_cast<const ObjectRecord*>(base_ + h_.mesh_object_offset);
    return std::all_of(instances, instances + h_.instance_count,
                       [&](const InstanceRecord& instance) { return is_plain(instance.material); }) &&
           std::all_of(triangles, triangles + h_.mesh_object_count,
                       [&](const ObjectRecord& triangle) { return is_plain(triangle.material); });
  }

  const std::byte* base_;
  const ImageHeader& h_;
  Table<MaterialRecord> materials_;
  Table<PatternRecord> patterns_;
  Table<SpaceStepRecord> steps_;
  Table<MapEntryRecord> entries_;
  Table<NormalRecord> normals_;
  std::vector<std::uint32_t> pigment_depth_, normal_depth_, material_depth_, layers_;
  std::vector<bool> pattern_depends_, normal_depends_,
      material_depends_; ///< by record: whether it depends on more than points
};

} // namespace

bool textures_are_valid(const std::byte* base, const ImageHeader& h) {
  return TextureCheck(base, h).holds();
}

} // namespace celltrace
