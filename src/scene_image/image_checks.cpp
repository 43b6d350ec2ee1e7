#include "scene_image/image_checks.hpp"

#include "kernel/lights/list.hpp"
#include "kernel/primitives/instances_module.hpp"
#include "kernel/primitives/list.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

namespace celltrace {

using namespace kernel;

namespace {

bool needs_extra(std::uint32_t flags) {
  bool has_parameters = false;
  Primitives::dispatch(flags & object_flag::kind_mask,
                       [&](auto shape) { has_parameters = decltype(shape)::kHasParameters; });
  return has_parameters || is_instance(flags) || (flags & (object_flag::smooth | object_flag::csg)) != 0;
}

/// Returns whether the records that a shape is made of are in the table, and are as many as its first record
/// says. The kernel then reads no other record.
bool has_valid_data(const std::byte* base, const ImageHeader& h, std::uint32_t kind, const ExtraRecord& extra) {
  if (!Primitives::has_data(kind)) return true;
  const ShapeData data = ShapeData::of(extra);
  if (data.count == 0) return !Primitives::is_made_of_data(kind);
  if (!refers_to(data.first, h.shape_data_offset, h.shape_data_count, sizeof(ShapeDataRecord)) ||
      data.count > h.shape_data_count - (data.first - h.shape_data_offset) / sizeof(ShapeDataRecord))
    return false;
  const float first = reinterpret_cast<const ShapeDataRecord*>(base + data.first)->value[0];
  if (kind == kPrimitiveKind<PolynomialPrimitive>) {
    if (!(first >= 1 && first <= PolynomialPrimitive::kMostDegree)) return false;
    const auto n = static_cast<std::uint32_t>(first);
    return (data.count - 1) * 4 >= (n + 1) * (n + 2) * (n + 3) / 6;
  }
  if (kind == kPrimitiveKind<PrismPrimitive> || kind == kPrimitiveKind<LathePrimitive>)
    return first >= 1 && first <= CurvePiece::kMostDegree;
  return true;
}

std::uint32_t solid_kind(const SolidRecord& solid) {
  return solid.object.kind_and_flags & object_flag::kind_mask;
}

/// The lowest and the highest number of the triangles below a node of a shared mesh.
struct TriangleSpan {
  std::uint32_t lowest = kNoOffset, highest = 0;

  void grow(const TriangleSpan& other) {
    lowest = std::min(lowest, other.lowest);
    highest = std::max(highest, other.highest);
  }
};

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
           nodes_are_valid() && records_are_valid();
  }

private:
  static constexpr std::uint32_t kForbidden =
      object_flag::kind_mask | object_flag::blended | object_flag::two_sided | object_flag::csg;
  bool has_plain_material(std::uint32_t flags, std::uint32_t material) const {
    return (flags & kForbidden) == static_cast<std::uint32_t>(ObjectKind::triangle) &&
           flags >> object_flag::light_set_shift == 0 &&
           (material == kNoOffset || refers_to(material_word::offset(material), h_.material_offset,
                                               h_.material_count, sizeof(MaterialRecord)));
  }
  bool is_triangle(const ObjectRecord& object) const {
    const bool smooth = (object.kind_and_flags & object_flag::smooth) != 0;
    return has_plain_material(object.kind_and_flags, object.material) &&
           (smooth ? refers_to(object.extra, h_.extra_offset, h_.extra_count, sizeof(ExtraRecord))
                   : object.extra == kNoOffset);
  }

  /// Returns true if all nodes are valid. Goes from the last node to the first: a node's children come after
  /// it, so that they have been checked before it.
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
      // A single ray tests all triangles of a leaf in one vector of lanes, which limits their number.
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

  bool records_are_valid() const {
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
  std::vector<TriangleSpan> spans_;   ///< index: node
  std::vector<std::uint32_t> levels_; ///< number of levels below a node; index: node
};

} // namespace

bool objects_are_valid(const std::byte* base, const ImageHeader& h) {
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
    const std::uint32_t material = material_word::offset(object.material);
    if (blended ? !refers_to(material, h.blend_offset, h.blend_count, sizeof(BlendRecord))
                : !is_material(material))
      return false;
    const std::uint32_t outside =
        blended ? reinterpret_cast<const BlendRecord*>(base + material)->material[0] : material;
    if ((flags & object_flag::two_sided) != 0 &&
        !is_material(reinterpret_cast<const MaterialRecord*>(base + outside)->inside))
      return false;
    if (!refers_to(object.interior, h.interior_offset, h.interior_count, sizeof(InteriorRecord)))
      return false;
    if ((needs_extra(flags) || object.extra != kNoOffset) &&
        !refers_to(object.extra, h.extra_offset, h.extra_count, sizeof(ExtraRecord)))
      return false;
    const auto extra = [&] { return reinterpret_cast<const ExtraRecord*>(base + object.extra); };
    if (object.extra != kNoOffset && !has_valid_data(base, h, flags & object_flag::kind_mask, *extra()))
      return false;
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
  const auto has_valid_sets = [&](const LightRecord& light) {
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
           ((light.kind_and_flags & light_flag::selective) == 0 || has_valid_sets(light)) &&
           (!is_projected(light) || has_projector(light));
  });
}

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
  return std::all_of(solids, solids + h.solid_count, [&](const SolidRecord& solid) {
    const std::uint32_t kind = solid_kind(solid);
    if (kind < kPrimitives) return has_valid_data(base, h, kind, solid.extra);
    return kind == kCrossedMeshSolid || kind == kMeshSolid || kind == kEmptySolid;
  });
}

bool mesh_insides_are_valid(const std::byte* base, const ImageHeader& h) {
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
      // The last list may be empty, and then begins at the end of the words.
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

bool crossed_meshes_are_valid(const std::byte* base, const ImageHeader& h) {
  constexpr auto kBytes = static_cast<std::uint32_t>(sizeof(CrossedMeshRecord));
  const auto* records = reinterpret_cast<const CrossedMeshRecord*>(base + h.crossed_mesh_offset);
  const auto* solids = reinterpret_cast<const SolidRecord*>(base + h.solid_offset);
  // Ends of the boxes around the current record. Boxes have to be nested, so that a walk only goes forward,
  // and ends at the record that its first record names.
  std::vector<std::uint32_t> ends;
  for (std::uint32_t i = 0; i < h.solid_count; ++i) {
    if (solid_kind(solids[i]) != kCrossedMeshSolid) continue;
    const std::uint32_t first = solids[i].object.extra;
    if (!refers_to(first, h.crossed_mesh_offset, h.crossed_mesh_count, kBytes)) return false;
  }
  for (std::uint32_t i = 0; i < h.crossed_mesh_count; ++i) {
    const std::uint32_t self = h.crossed_mesh_offset + i * kBytes, next = records[i].next;
    while (!ends.empty() && ends.back() == self)
      ends.pop_back();
    const std::uint32_t end =
        ends.empty() ? h.crossed_mesh_offset + h.crossed_mesh_count * kBytes : ends.back();
    if (next <= self || next > end || (next - self) % kBytes != 0) return false;
    if (records[i].is_triangle != 0 && next != self + kBytes) return false;
    ends.push_back(next);
  }
  return true;
}

bool instances_are_valid(const std::byte* base, const ImageHeader& h) {
  return InstanceCheck(base, h).holds();
}

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

} // namespace celltrace
