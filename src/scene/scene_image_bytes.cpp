// Scene images as bytes: out with a checksum, in with distrust.
#include "scene/scene_image.hpp"

#include "celltrace/error.hpp"
#include "kernel/lights/list.hpp"
#include "kernel/primitives/instances_module.hpp"
#include "kernel/textures/list.hpp"
#include "kernel/textures/map_walk.hpp"
#include "scene/patterns.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <string>

namespace celltrace {

using namespace kernel;

namespace {

/// FNV-1a over 64-bit words; the block is a multiple of a line long.
std::uint64_t checksum(std::span<const std::byte> bytes) {
  std::uint64_t sum = 0xCBF29CE484222325u;
  for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
    std::uint64_t word = 0;
    if (at != offsetof(ImageHeader, checksum)) std::memcpy(&word, bytes.data() + at, 8);
    sum = (sum ^ word) * 0x100000001B3u;
  }
  return sum;
}

/// True if a table of `count` records at `offset` lies within `bytes` and is aligned.
bool table_fits(std::uint32_t offset, std::uint32_t count, std::size_t record, std::size_t bytes) {
  return offset % kLineBytes == 0 && offset >= sizeof(ImageHeader) && offset <= bytes &&
         std::uint64_t{count} * record <= bytes - offset;
}
/// True if `offset` is that of a record of the table.
bool refers_to(std::uint32_t offset, std::uint32_t table, std::uint32_t count, std::size_t record) {
  return offset >= table && (offset - table) % record == 0 && (offset - table) / record < count;
}

bool needs_extra(std::uint32_t flags) {
  bool has_parameters = false;
  Primitives::dispatch(flags & object_flag::kind_mask,
                       [&](auto shape) { has_parameters = decltype(shape)::kHasParameters; });
  return has_parameters || is_instance(flags) || (flags & (object_flag::smooth | object_flag::csg)) != 0;
}

bool references_are_valid(const std::byte* base, const ImageHeader& h) {
  const std::uint32_t before = h.unbounded_count + h.projector_count;
  const auto* objects = reinterpret_cast<const ObjectRecord*>(base + h.object_offset) - before;
  const auto is_material = [&](std::uint32_t offset) {
    return refers_to(offset, h.material_offset, h.material_count, sizeof(MaterialRecord));
  };
  const auto* blends = reinterpret_cast<const BlendRecord*>(base + h.blend_offset);
  for (std::uint32_t i = 0; i < h.blend_count; ++i)
    for (std::uint32_t material : blends[i].material)
      if (!is_material(material)) return false;
  for (std::uint32_t i = 0; i < h.object_count + before; ++i) {
    const ObjectRecord& object = objects[i];
    const std::uint32_t flags = object.kind_and_flags;
    const bool blended = (flags & object_flag::blended) != 0;
    if ((flags & object_flag::kind_mask) >= kObjectKinds) return false;
    if (flags >> object_flag::light_set_shift >= h.light_set_count) return false;
    if (blended ? !refers_to(object.material, h.blend_offset, h.blend_count, sizeof(BlendRecord))
                : !is_material(object.material))
      return false;
    if ((flags & object_flag::two_sided) != 0 && !blended &&
        !is_material(reinterpret_cast<const MaterialRecord*>(base + object.material)->inside))
      return false;
    if (!refers_to(object.interior, h.interior_offset, h.interior_count, sizeof(InteriorRecord)))
      return false;
    if ((needs_extra(flags) || object.extra != kNoOffset) &&
        !refers_to(object.extra, h.extra_offset, h.extra_count, sizeof(ExtraRecord)))
      return false;
    const auto extra = [&] { return reinterpret_cast<const ExtraRecord*>(base + object.extra); };
    if ((flags & object_flag::kind_mask) == kPrimitiveKind<PolygonPrimitive>) {
      const PolygonEdges edges = PolygonEdges::of(*extra());
      if (edges.count != 0 &&
          (!refers_to(edges.first, h.polygon_edge_offset, h.polygon_edge_count, sizeof(PolygonEdgeRecord)) ||
           edges.count >
               h.polygon_edge_count - (edges.first - h.polygon_edge_offset) / sizeof(PolygonEdgeRecord)))
        return false;
    }
    if (is_instance(flags) &&
        !refers_to(instance_of(*extra()), h.instance_offset, h.instance_count, sizeof(InstanceRecord)))
      return false;
    if ((flags & object_flag::csg) != 0 &&
        !refers_to(extra()->csg, h.csg_offset, h.csg_count, sizeof(CsgRecord)))
      return false;
  }
  return true;
}

bool lights_are_valid(const std::byte* base, const ImageHeader& h) {
  const auto* lights = reinterpret_cast<const LightRecord*>(base + h.light_offset);
  constexpr std::uint32_t kWord = sizeof(std::uint32_t), kBits = 32;
  if (h.light_set_count == 0 || h.light_set_count > kMaxLightSets) return false;
  const std::uint32_t words_a_light = (h.light_set_count + kBits - 1) / kBits;
  const auto knows_its_sets = [&](const LightRecord& light) {
    return refers_to(light.lit_sets, h.light_word_offset, h.light_word_count, kWord) &&
           h.light_word_count - (light.lit_sets - h.light_word_offset) / kWord >= words_a_light;
  };
  const std::uint32_t first_projector =
      h.object_offset - (h.unbounded_count + h.projector_count) * std::uint32_t{sizeof(ObjectRecord)};
  const auto has_projector = [&](const LightRecord& light) {
    const std::uint32_t at = light.projector - first_projector;
    return at % sizeof(ObjectRecord) == 0 && at / sizeof(ObjectRecord) <= h.projector_count &&
           light.projector_count <= h.projector_count - at / sizeof(ObjectRecord);
  };
  return std::all_of(lights, lights + h.light_count, [&](const LightRecord& light) {
    const auto is_count = [](std::uint32_t places) { return places - 1 < kMaxLightPlaces; };
    return (light.kind_and_flags & light_flag::kind_mask) < Lights::kCount &&
           (!has_area(light) ||
            (is_count(light.columns) && is_count(light.rows) && light.columns * light.rows > 1)) &&
           ((light.kind_and_flags & light_flag::selective) == 0 || knows_its_sets(light)) &&
           (!is_projected(light) || has_projector(light));
  });
}

/// Looks at the tables of textures.
class TextureCheck {
public:
  TextureCheck(const std::byte* base, const ImageHeader& h)
      : base_(base), h_(h), materials_(base, h.material_offset, h.material_count),
        patterns_(base, h.pattern_offset, h.pattern_count),
        steps_(base, h.space_step_offset, h.space_step_count),
        entries_(base, h.map_entry_offset, h.map_entry_count),
        normals_(base, h.normal_offset, h.normal_count) {}

  /// True if every reference is to a record of its table, and no walk through maps and layers is too long.
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
    // Materials refer to later ones only.
    for (std::uint32_t i = h_.material_count; i-- > 0;)
      if (!material_is_sound(i)) return false;
    if (!surfaces_are_told_of()) return false;
    if (h_.sky == kNoOffset) return true;
    const std::uint32_t sky = materials_.find(h_.sky);
    return sky != materials_.count && (materials_[sky].flags & material_flag::mapped) == 0 &&
           !material_asks_[sky];
  }

private:
  template <class Record> struct Table {
    const Record* records;
    std::uint32_t offset, count;
    Table(const std::byte* base, std::uint32_t at, std::uint32_t n)
        : records(reinterpret_cast<const Record*>(base + at)), offset(at), count(n) {}
    const Record& operator[](std::uint32_t i) const { return records[i]; }
    /// The index of the record at an offset; `count` if there is none.
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
  /// A black hole may do without the table, but not read it anywhere else.
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
  /// The table that a pattern reads is there, and whole; hashes lead to no other place.
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
    case PatternTable::pigments:
      return patterns_.find(r.table) != patterns_.count;
    case PatternTable::objects:
      return refers_to(r.table, h_.csg_offset, h_.csg_count, sizeof(CsgRecord));
    }
    return false;
  }

  /// How deep the maps of pigments nest, by pattern; 0: it has none, or they are not sound. Patterns refer to
  /// earlier ones only.
  void find_pigment_depths() {
    pigment_depth_.assign(h_.pattern_count, 0);
    pattern_asks_.assign(h_.pattern_count, false);
    for (std::uint32_t i = 0; i < h_.pattern_count; ++i) {
      pigment_depth_[i] = depth_of(i);
      const PatternRecord& r = patterns_[i];
      bool asks = pattern_asks(i);
      for (std::uint32_t entry = 0; pigment_depth_[i] > 1 && entry < r.entry_count; ++entry)
        if (const std::uint32_t child = child_of(r, entry); child != kNoOffset)
          asks = asks || pattern_asks_[patterns_.find(child)];
      pattern_asks_[i] = asks;
    }
  }
  /// Whether it is asked at more than points.
  static bool asks_by_itself(const PatternRecord& r) {
    return (r.kind_and_flags & pattern_flag::uv_mapping) != 0 ||
           Patterns::kReadSurfaces[r.kind_and_flags & pattern_flag::kind_mask];
  }
  /// Of earlier patterns this has been found out.
  bool pattern_asks(std::uint32_t pattern) const {
    const PatternRecord& r = patterns_[pattern];
    return asks_by_itself(r) || (is_pigment(r) && pattern_asks_[patterns_.find(r.table)]);
  }
  /// How deep the maps of the pigment nest that a pattern is; 0: it is none.
  std::uint32_t depth_inside(std::uint32_t pattern) const {
    const PatternRecord& r = patterns_[pattern];
    return is_pigment(r) ? pigment_depth_[patterns_.find(r.table)] : 0;
  }
  /// Whether a pattern, if it is a pigment, is one that is known, and found by looking for its value.
  bool inside_is_sound(std::uint32_t pattern) const {
    const PatternRecord& r = patterns_[pattern];
    if (!is_pigment(r)) return true;
    return (r.kind_and_flags & pattern_flag::nested) != 0 && patterns_.find(r.table) < pattern &&
           depth_inside(pattern) != 0;
  }
  std::uint32_t depth_of(std::uint32_t pattern) const {
    const PatternRecord& r = patterns_[pattern];
    if (r.entry_count == 0 || !inside_is_sound(pattern)) return 0;
    std::uint32_t deepest = depth_inside(pattern);
    if (deepest == kDeepestMapWalk) return 0;
    for (std::uint32_t i = 0; i < r.entry_count; ++i) {
      const std::uint32_t child = child_of(r, i);
      if (child == kNoOffset) continue;
      if ((r.kind_and_flags & pattern_flag::nested) == 0) return 0;
      const std::uint32_t nested = patterns_.find(child);
      if (nested >= pattern || pigment_depth_[nested] == 0 || pigment_depth_[nested] == kDeepestMapWalk)
        return 0;
      deepest = std::max(deepest, pigment_depth_[nested]);
    }
    return deepest + 1;
  }
  std::uint32_t child_of(const PatternRecord& r, std::uint32_t entry) const {
    return entries_[entries_.find(r.entries) + entry].child;
  }

  /// Normals refer to earlier ones only.
  bool normal_is_sound(std::uint32_t normal) {
    const NormalRecord& r = normals_[normal];
    const std::uint32_t pattern = patterns_.find(r.pattern);
    std::uint32_t depth = 0;
    if (pattern == patterns_.count) return false;
    if (!inside_is_sound(pattern)) return false;
    bool asks = pattern_asks(pattern);
    depth = depth_inside(pattern);
    if (r.is_mapped != 0)
      for (std::uint32_t i = 0; i < patterns_[pattern].entry_count; ++i) {
        const std::uint32_t child = normals_.find(child_of(patterns_[pattern], i));
        if (child >= normal) return false;
        depth = std::max(depth, normal_depth_[child]);
        asks = asks || normal_asks_[child];
      }
    normal_depth_.push_back(r.is_mapped != 0 ? depth + 1 : depth);
    normal_asks_.push_back(asks);
    return normal_depth_.back() <= kDeepestMapWalk &&
           (r.is_mapped == 0 || patterns_[pattern].entry_count != 0);
  }

  bool material_is_sound(std::uint32_t material) {
    const MaterialRecord& r = materials_[material];
    const auto has = [&](std::uint32_t flag) { return (r.flags & flag) != 0; };
    if (material_depth_.empty()) {
      layers_ = material_depth_ = std::vector<std::uint32_t>(h_.material_count, 0);
      material_asks_.assign(h_.material_count, false);
    }
    const bool mapped = has(material_flag::mapped);
    bool asks = false;
    if (mapped || has(material_flag::patterned)) {
      const std::uint32_t pattern = patterns_.find(r.pattern);
      if (pattern == patterns_.count) return false;
      if (mapped ? !inside_is_sound(pattern) : pigment_depth_[pattern] == 0) return false;
      asks = pattern_asks_[pattern];
      if (mapped) material_depth_[material] = depth_inside(pattern) + 1;
      for (std::uint32_t i = 0; mapped && i < patterns_[pattern].entry_count; ++i) {
        const std::uint32_t child = materials_.find(child_of(patterns_[pattern], i));
        if (child == materials_.count || child <= material) return false;
        material_depth_[material] = std::max(material_depth_[material], material_depth_[child] + 1);
        asks = asks || material_asks_[child];
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
      asks = asks || normal_asks_[normal];
    }
    material_asks_[material] = asks;
    if (!has(material_flag::layered)) return r.below == kNoOffset;
    const std::uint32_t below = materials_.find(r.below);
    if (below == materials_.count || below <= material || mapped ||
        (materials_[below].flags & material_flag::mapped) != 0)
      return false;
    layers_[material] = layers_[below] + 1;
    material_asks_[material] = asks || material_asks_[below];
    return layers_[material] <= kMostLayers;
  }

  /// Patterns are asked at more than points only where this is found out: on objects that say so, and in
  /// shadows of those that let light through, of scenes that say so.
  bool surfaces_are_told_of() const {
    const auto* objects =
        reinterpret_cast<const ObjectRecord*>(base_ + h_.object_offset) - h_.unbounded_count;
    const auto asks = [&](std::uint32_t offset, bool two_sided) {
      const std::uint32_t material = materials_.find(offset);
      return material_asks_[material] ||
             (two_sided && material_asks_[materials_.find(materials_[material].inside)]);
    };
    for (std::uint32_t i = 0; i < h_.object_count + h_.unbounded_count; ++i) {
      const ObjectRecord& object = objects[i];
      const auto has = [&](std::uint32_t flag) { return (object.kind_and_flags & flag) != 0; };
      bool object_asks = false;
      if (has(object_flag::blended)) {
        for (const std::uint32_t material :
             reinterpret_cast<const BlendRecord*>(base_ + object.material)->material)
          object_asks = object_asks || asks(material, false);
      } else {
        object_asks = asks(object.material, has(object_flag::two_sided));
      }
      if (!object_asks) continue;
      const std::uint32_t ways =
          light_way::by_surface | (has(object_flag::opaque) ? 0 : std::uint32_t{light_way::stepwise});
      if (!has(object_flag::by_surface) || (h_.light_ways & ways) != ways) return false;
    }
    // Triangles of instances are not told of at all.
    const auto is_plain = [&](std::uint32_t offset) {
      const std::uint32_t material = materials_.find(offset);
      return material == materials_.count || !material_asks_[material];
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
  std::vector<bool> pattern_asks_, normal_asks_, material_asks_; ///< by record, if at more than points
};

std::uint32_t solid_kind(const SolidRecord& solid) {
  return solid.object.kind_and_flags & object_flag::kind_mask;
}

/// True if conditions end, so do their programs, and solids are of kinds that there are.
bool csg_is_valid(const std::byte* base, const ImageHeader& h) {
  const auto* records = reinterpret_cast<const CsgRecord*>(base + h.csg_offset);
  for (std::uint32_t i = 0; i < h.csg_count; ++i) {
    const CsgRecord& r = records[i];
    if (r.next != kNoOffset && !refers_to(r.next, h.csg_offset, i, sizeof(CsgRecord))) return false;
    if (!refers_to(r.steps, h.csg_step_offset, h.csg_step_count, sizeof(CsgStep)) ||
        r.count > h.csg_step_count - (r.steps - h.csg_step_offset) / sizeof(CsgStep) ||
        r.skip_begin > r.skip_end || r.skip_end > r.count)
      return false;
    const auto* steps = reinterpret_cast<const CsgStep*>(base + r.steps);
    for (std::uint32_t s = 0; s < r.count; ++s)
      for (const std::uint32_t target : {steps[s].if_inside, steps[s].if_outside})
        if (target < kCsgReject && (target <= s || target >= r.count)) return false;
  }
  const auto* steps = reinterpret_cast<const CsgStep*>(base + h.csg_step_offset);
  for (std::uint32_t i = 0; i < h.csg_step_count; ++i)
    if (!refers_to(steps[i].solid, h.solid_offset, h.solid_count, sizeof(SolidRecord))) return false;
  const auto* solids = reinterpret_cast<const SolidRecord*>(base + h.solid_offset);
  return std::all_of(solids, solids + h.solid_count, [](const SolidRecord& solid) {
    const std::uint32_t kind = solid_kind(solid);
    return kind < kPrimitives || kind == kMeshSolid || kind == kEmptySolid;
  });
}

/// True if the insides of meshes have grids, and their cells lists of triangles.
bool meshes_are_valid(const std::byte* base, const ImageHeader& h) {
  constexpr auto kWord = static_cast<std::uint32_t>(sizeof(std::uint32_t));
  const auto* solids = reinterpret_cast<const SolidRecord*>(base + h.solid_offset);
  for (std::uint32_t i = 0; i < h.solid_count; ++i)
    if (solid_kind(solids[i]) == kMeshSolid &&
        !refers_to(solids[i].object.extra, h.mesh_grid_offset, h.mesh_grid_count, sizeof(MeshGridRecord)))
      return false;
  const auto* words = reinterpret_cast<const std::uint32_t*>(base + h.mesh_word_offset);
  const auto index_of = [&](std::uint32_t offset) { return (offset - h.mesh_word_offset) / kWord; };
  const auto* grids = reinterpret_cast<const MeshGridRecord*>(base + h.mesh_grid_offset);
  for (std::uint32_t i = 0; i < h.mesh_grid_count; ++i) {
    const MeshGridRecord& grid = grids[i];
    if (grid.columns - 1 >= kMaxMeshGridSide || grid.rows - 1 >= kMaxMeshGridSide ||
        !refers_to(grid.starts, h.mesh_word_offset, h.mesh_word_count, kWord))
      return false;
    const std::uint32_t starts = index_of(grid.starts), lists = starts + grid.columns * grid.rows + 1;
    if (lists > h.mesh_word_count || lists < starts) return false;
    std::uint32_t at = lists;
    for (std::uint32_t cell = starts; cell < lists; ++cell) {
      // Behind the last list there may be no more words.
      if (words[cell] < h.mesh_word_offset || (words[cell] - h.mesh_word_offset) % kWord != 0 ||
          index_of(words[cell]) < at || index_of(words[cell]) > h.mesh_word_count)
        return false;
      for (const std::uint32_t end = index_of(words[cell]); at < end; ++at)
        if (!refers_to(words[at], h.mesh_triangle_offset, h.mesh_triangle_count, sizeof(MeshTriangleRecord)))
          return false;
    }
  }
  return true;
}

/// Triangles of meshes that instances share: the lowest and the highest of those below a node.
struct TriangleSpan {
  std::uint32_t lowest = kNoOffset, highest = 0;

  void grow(const TriangleSpan& other) {
    lowest = std::min(lowest, other.lowest);
    highest = std::max(highest, other.highest);
  }
};

/// True if instances have meshes and numbers of their own for the triangles of these, whose nodes lead to
/// them in few steps.
class InstanceCheck {
public:
  InstanceCheck(const std::byte* base, const ImageHeader& h)
      : h_(h), instances_(reinterpret_cast<const InstanceRecord*>(base + h.instance_offset)),
        objects_(reinterpret_cast<const ObjectRecord*>(base + h.mesh_object_offset)),
        nodes_(reinterpret_cast<const NodeRecord*>(base + h.mesh_node_offset)), spans_(h.mesh_node_count),
        levels_(h.mesh_node_count) {}

  bool holds() {
    return std::all_of(objects_, objects_ + h_.mesh_object_count,
                       [this](const ObjectRecord& object) { return is_triangle(object); }) &&
           nodes_are_valid() && instances_are_valid();
  }

private:
  static constexpr std::uint32_t kForbidden =
      object_flag::kind_mask | object_flag::blended | object_flag::two_sided | object_flag::csg;
  bool has_plain_material(std::uint32_t flags, std::uint32_t material) const {
    return (flags & kForbidden) == static_cast<std::uint32_t>(ObjectKind::triangle) &&
           flags >> object_flag::light_set_shift == 0 &&
           (material == kNoOffset ||
            refers_to(material, h_.material_offset, h_.material_count, sizeof(MaterialRecord)));
  }
  bool is_triangle(const ObjectRecord& object) const {
    const bool smooth = (object.kind_and_flags & object_flag::smooth) != 0;
    return has_plain_material(object.kind_and_flags, object.material) &&
           (smooth ? refers_to(object.extra, h_.extra_offset, h_.extra_count, sizeof(ExtraRecord))
                   : object.extra == kNoOffset);
  }

  /// Children come after their node.
  bool nodes_are_valid() {
    for (std::uint32_t i = h_.mesh_node_count; i-- > 0;)
      for (std::uint32_t child = 0; child < std::size(nodes_[i].child); ++child)
        if (!add_child(i, nodes_[i].child[child], nodes_[i].leaf[child])) return false;
    return true;
  }
  bool add_child(std::uint32_t node, std::uint32_t child, std::uint32_t leaf) {
    if ((child | leaf) == 0) return true;
    if (leaf != 0) {
      const std::uint32_t count = leaf_word::count(leaf);
      // Rays that go alone test them in lanes.
      if (leaf != leaf_word::make(count, 1) || count == 0 || count > kSimdLanes ||
          !refers_to(child, h_.mesh_object_offset, h_.mesh_object_count, sizeof(ObjectRecord)))
        return false;
      const auto first = (child - h_.mesh_object_offset) / static_cast<std::uint32_t>(sizeof(ObjectRecord));
      if (count > h_.mesh_object_count - first) return false;
      spans_[node].grow({first, first + count - 1});
      return true;
    }
    if (!refers_to(child, h_.mesh_node_offset, h_.mesh_node_count, sizeof(NodeRecord))) return false;
    const auto index = (child - h_.mesh_node_offset) / static_cast<std::uint32_t>(sizeof(NodeRecord));
    if (index <= node) return false;
    spans_[node].grow(spans_[index]);
    levels_[node] = std::max(levels_[node], levels_[index] + 1);
    return levels_[node] < kMaxMeshLevels;
  }

  bool instances_are_valid() const {
    std::uint32_t next = 1;
    for (std::uint32_t i = 0; i < h_.instance_count; ++i) {
      const InstanceRecord& r = instances_[i];
      if (r.first_number < next || r.triangle_count == 0 ||
          r.triangle_count > kInstancedBit - 1 - r.first_number || r.material == kNoOffset ||
          !has_plain_material(r.kind_and_flags, r.material) ||
          (r.kind_and_flags & object_flag::smooth) != 0 ||
          !refers_to(r.interior, h_.interior_offset, h_.interior_count, sizeof(InteriorRecord)) ||
          !refers_to(r.first_triangle, h_.mesh_object_offset, h_.mesh_object_count, sizeof(ObjectRecord)) ||
          !refers_to(r.root, h_.mesh_node_offset, h_.mesh_node_count, sizeof(NodeRecord)))
        return false;
      next = r.first_number + r.triangle_count;
      const auto first = (r.first_triangle - h_.mesh_object_offset) / sizeof(ObjectRecord);
      const TriangleSpan& span = spans_[(r.root - h_.mesh_node_offset) / sizeof(NodeRecord)];
      if (r.triangle_count > h_.mesh_object_count - first || span.lowest < first ||
          span.highest >= first + r.triangle_count)
        return false;
    }
    return true;
  }

  const ImageHeader& h_;
  const InstanceRecord* instances_;
  const ObjectRecord* objects_;
  const NodeRecord* nodes_;
  std::vector<TriangleSpan> spans_;   ///< by node
  std::vector<std::uint32_t> levels_; ///< by node, those below it
};

/// True if there are no groups, or each object is in one.
bool groups_are_valid(const std::byte* base, const ImageHeader& h) {
  const auto* groups = reinterpret_cast<const GroupRecord*>(base + h.group_offset);
  std::uint32_t objects = 0;
  std::uint32_t longest = 0;
  for (std::uint32_t i = 0; i < h.group_count; ++i) {
    if (groups[i].first != objects || groups[i].count == 0 || groups[i].count > h.object_count - objects)
      return false;
    objects += groups[i].count;
    longest = std::max(longest, groups[i].count);
  }
  return (h.group_count == 0 || objects == h.object_count) && longest == h.longest_group;
}

/// True if there are no copies, or each of them and its prototype are of one number of objects, and not many.
/// The groups are valid.
bool prototypes_are_valid(const std::byte* base, const ImageHeader& h) {
  if (h.prototype_count == 0) return true;
  if (h.prototype_count != h.group_count) return false;
  const auto* groups = reinterpret_cast<const GroupRecord*>(base + h.group_offset);
  const auto* prototypes = reinterpret_cast<const std::uint32_t*>(base + h.prototype_offset);
  for (std::uint32_t i = 0; i < h.group_count; ++i) {
    const std::uint32_t prototype = prototypes[i];
    if (prototype == kNoGroup) continue;
    if (prototype > i || prototypes[prototype] != prototype || groups[prototype].count != groups[i].count ||
        groups[i].count > kMaxCopiedObjects)
      return false;
  }
  return true;
}

} // namespace

std::vector<std::byte> SceneImage::to_bytes() const {
  std::vector<std::byte> bytes(block_.data(), block_.data() + header().bytes);
  const std::uint64_t sum = checksum(bytes);
  std::memcpy(bytes.data() + offsetof(ImageHeader, checksum), &sum, sizeof sum);
  return bytes;
}

SceneImage SceneImage::from_bytes(std::span<const std::byte> bytes) {
  SceneImage image;
  if (bytes.size() < sizeof(ImageHeader)) throw InputError("not a scene image: too short");
  image.block_ = AlignedBlock::uninitialised(bytes.size());
  std::memcpy(image.block_.data(), bytes.data(), bytes.size());
  const ImageHeader& h = image.header();
  if (h.magic != kImageMagic) throw InputError("not a scene image");
  if (h.version != kImageVersion)
    throw InputError("scene image of version " + std::to_string(h.version) + "; this library reads version " +
                     std::to_string(kImageVersion));
  if (h.bytes != bytes.size() || h.bytes % kLineBytes != 0)
    throw InputError("scene image: its size is wrong");
  if (h.checksum != checksum(bytes)) throw InputError("scene image: its checksum is wrong");
  if (!table_fits(h.light_offset, h.light_count, sizeof(LightRecord), bytes.size()) ||
      !table_fits(h.light_word_offset, h.light_word_count, sizeof(std::uint32_t), bytes.size()) ||
      !table_fits(h.material_offset, h.material_count, sizeof(MaterialRecord), bytes.size()) ||
      !table_fits(h.pattern_offset, h.pattern_count, sizeof(PatternRecord), bytes.size()) ||
      !table_fits(h.space_step_offset, h.space_step_count, sizeof(SpaceStepRecord), bytes.size()) ||
      !table_fits(h.map_entry_offset, h.map_entry_count, sizeof(MapEntryRecord), bytes.size()) ||
      !table_fits(h.normal_offset, h.normal_count, sizeof(NormalRecord), bytes.size()) ||
      !table_fits(h.feature_offset, h.feature_count, sizeof(FeatureRecord), bytes.size()) ||
      !table_fits(h.gradient_offset, h.gradient_count, sizeof(GradientRecord), bytes.size()) ||
      !table_fits(h.wave_offset, h.wave_count, sizeof(WaveRecord), bytes.size()) ||
      !table_fits(h.slope_offset, h.slope_count, sizeof(SlopeRecord), bytes.size()) ||
      !table_fits(h.blend_offset, h.blend_count, sizeof(BlendRecord), bytes.size()) ||
      !table_fits(h.interior_offset, h.interior_count, sizeof(InteriorRecord), bytes.size()) ||
      !table_fits(h.finish_offset, h.finish_count, sizeof(FinishRecord), bytes.size()) ||
      !table_fits(h.fog_offset, h.fog_count, sizeof(FogRecord), bytes.size()) ||
      !table_fits(h.rainbow_offset, h.rainbow_count, sizeof(RainbowRecord), bytes.size()) ||
      !table_fits(h.polygon_edge_offset, h.polygon_edge_count, sizeof(PolygonEdgeRecord), bytes.size()) ||
      !table_fits(h.extra_offset, h.extra_count, sizeof(ExtraRecord), bytes.size()) ||
      !table_fits(h.object_offset, h.object_count, sizeof(ObjectRecord), bytes.size()) ||
      std::uint64_t{h.unbounded_count} + h.projector_count >
          (h.object_offset - sizeof(ImageHeader)) / sizeof(ObjectRecord) ||
      !table_fits(h.csg_offset, h.csg_count, sizeof(CsgRecord), bytes.size()) ||
      !table_fits(h.csg_step_offset, h.csg_step_count, sizeof(CsgStep), bytes.size()) ||
      !table_fits(h.solid_offset, h.solid_count, sizeof(SolidRecord), bytes.size()) ||
      !table_fits(h.mesh_grid_offset, h.mesh_grid_count, sizeof(MeshGridRecord), bytes.size()) ||
      !table_fits(h.mesh_word_offset, h.mesh_word_count, sizeof(std::uint32_t), bytes.size()) ||
      !table_fits(h.mesh_triangle_offset, h.mesh_triangle_count, sizeof(MeshTriangleRecord), bytes.size()) ||
      !table_fits(h.instance_offset, h.instance_count, sizeof(InstanceRecord), bytes.size()) ||
      !table_fits(h.mesh_object_offset, h.mesh_object_count, sizeof(ObjectRecord), bytes.size()) ||
      !table_fits(h.mesh_node_offset, h.mesh_node_count, sizeof(NodeRecord), bytes.size()) ||
      (h.instance_count != 0 && h.bytes > kInstancedBit) ||
      !table_fits(h.group_offset, h.group_count, sizeof(GroupRecord), bytes.size()) ||
      !table_fits(h.prototype_offset, h.prototype_count, sizeof(std::uint32_t), bytes.size()) ||
      !references_are_valid(image.base(), h) || !lights_are_valid(image.base(), h) ||
      !TextureCheck(image.base(), h).holds() || !csg_is_valid(image.base(), h) ||
      !meshes_are_valid(image.base(), h) || !groups_are_valid(image.base(), h) ||
      !prototypes_are_valid(image.base(), h) || !InstanceCheck(image.base(), h).holds())
    throw InputError("scene image: an offset is out of range");
  return image;
}

} // namespace celltrace
