#include "scene_image/image_layout.hpp"

#include "celltrace/error.hpp"
#include "records/light_feature.hpp"
#include "scene_image/image_fields.hpp"
#include "scene_image/interior_records.hpp"
#include "scene_image/scene_image.hpp"
#include "scene_image/surface_records.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace celltrace {

using namespace kernel;

namespace {

/// Assigns offsets to tables, one table behind the other.
class Layout {
public:
  explicit Layout(std::size_t begin) : end_(begin) {}
  template <class Record>
  void place(std::size_t count, std::uint32_t& offset_field, std::uint32_t& count_field) {
    static_assert(consists_of_words<Record>(), "SharedImage converts tables word by word");
    offset_field = static_cast<std::uint32_t>(end_);
    count_field = static_cast<std::uint32_t>(count);
    end_ = whole_lines(end_ + count * sizeof(Record));
    if (end_ > std::numeric_limits<std::uint32_t>::max())
      throw InputError("the scene is too large: its image would pass 4 GB");
  }
  std::size_t end() const { return end_; }

private:
  std::size_t end_;
};

/// Returns the light_feature flags of a scene. `has_blends`: some surfaces have several materials.
std::uint32_t light_features_of(const Scene& scene, const TextureTables& textures, bool has_blends) {
  std::uint32_t features = scene.fogs.empty() && textures.rainbows.empty() ? 0 : light_feature::atmosphere;
  bool has_fading = false;
  for (const Interior& interior : scene.interiors) {
    const InteriorRecord r = make_record(interior);
    has_fading = has_fading || r.inverse_fade_distance != 0;
    if (r.refraction() != 1) features |= light_feature::fading;
    if (r.caustics != 0) features |= light_feature::stepwise;
  }
  if (textures.has_translucent_side || textures.filters_by_surface) features |= light_feature::stepwise;
  if (has_blends && textures.by_surface && textures.filters) features |= light_feature::stepwise;
  if (textures.by_surface) features |= light_feature::by_surface;
  for (const Light& light : scene.lights) {
    if (light.is_dimmed_by_fog && !scene.fogs.empty()) features |= light_feature::stepwise;
    if (light.projected_through) features |= light_feature::projectors;
  }
  if (!has_fading) return features;
  if ((features & light_feature::stepwise) == 0) features |= light_feature::only_fading;
  return features | light_feature::fading | light_feature::stepwise;
}

/// Places the first tables, which hold no positions of objects. `blended` is the number of objects with
/// several materials.
void place_surfaces(Layout& layout, ImageHeader& header, const Scene& scene, std::size_t interiors,
                    const LightSets& light_sets, const TextureTables& textures, std::uint32_t blended) {
  layout.place<LightRecord>(scene.lights.size(), header.light_offset, header.light_count);
  header.light_set_count = light_sets.count();
  layout.place<std::uint32_t>(light_sets.words().size(), header.light_word_offset, header.light_word_count);
  layout.place<MaterialRecord>(textures.materials.size(), header.material_offset, header.material_count);
  layout.place<PatternRecord>(textures.patterns.size(), header.pattern_offset, header.pattern_count);
  layout.place<SpaceStepRecord>(textures.steps.size(), header.space_step_offset, header.space_step_count);
  layout.place<MapEntryRecord>(textures.entries.size(), header.map_entry_offset, header.map_entry_count);
  layout.place<NormalRecord>(textures.normals.size(), header.normal_offset, header.normal_count);
  layout.place<FeatureRecord>(textures.features.size(), header.feature_offset, header.feature_count);
  layout.place<GradientRecord>(textures.gradients.size(), header.gradient_offset, header.gradient_count);
  layout.place<WaveRecord>(textures.waves.size(), header.wave_offset, header.wave_count);
  layout.place<SlopeRecord>(textures.slopes.size(), header.slope_offset, header.slope_count);
  layout.place<FunctionStepRecord>(textures.function_steps.size(), header.function_step_offset,
                                   header.function_step_count);
  layout.place<PictureRecord>(textures.pictures.size(), header.picture_offset, header.picture_count);
  layout.place<TexelTileRecord>(textures.texel_tiles.size(), header.texel_tile_offset, header.texel_tile_count);
  layout.place<BlendRecord>(blended, header.blend_offset, header.blend_count);
  layout.place<InteriorRecord>(interiors, header.interior_offset, header.interior_count);
  layout.place<FinishRecord>(textures.finishes.size(), header.finish_offset, header.finish_count);
  header.light_features = light_features_of(scene, textures, blended != 0);
  header.surface_nodes = textures.most_nodes(blended != 0);
  layout.place<FogRecord>(scene.fogs.size(), header.fog_offset, header.fog_count);
  layout.place<RainbowRecord>(textures.rainbows.size(), header.rainbow_offset, header.rainbow_count);
  header.sky = textures.sky == kNoOffset
                   ? kNoOffset
                   : header.material_offset + textures.sky * std::uint32_t{sizeof(MaterialRecord)};
}

} // namespace

std::size_t whole_lines(std::size_t bytes) {
  return (bytes + kLineBytes - 1) / kLineBytes * kLineBytes;
}

std::uint32_t room_of_unbounded(std::uint32_t count) {
  constexpr std::uint32_t kPerLine = kLineBytes / sizeof(ObjectRecord);
  return (count + kPerLine - 1) / kPerLine * kPerLine;
}

ImageHeader make_header(const Scene& scene, const LightSets& light_sets, const TextureTables& textures,
                        const SceneObjects& objects, const ObjectCounts& counts,
                        std::span<const std::uint32_t> groups, const InstancedMeshes& instanced,
                        const MeshInstances& instances, bool has_near_surfaces) {
  ImageHeader header{};
  header.magic = kImageMagic;
  header.version = kImageVersion;
  Layout layout(sizeof(ImageHeader));
  place_surfaces(layout, header, scene, interior_records(scene), light_sets, textures, counts.blended);
  if (has_near_surfaces) header.light_features |= light_feature::near_surfaces;
  // A ray that continues behind a surface may find crossings that it did not find from its first origin.
  if (textures.filters && !objects.csg().crossed_meshes.records().empty())
    header.light_features |= light_feature::near_surfaces | light_feature::restarts;
  if (!objects.are_all_seen()) header.light_features |= light_feature::unseen;
  const CsgParts& csg = objects.csg();
  layout.place<CsgRecord>(csg.conditions.size(), header.csg_offset, header.csg_count);
  layout.place<CsgStep>(csg.steps.size(), header.csg_step_offset, header.csg_step_count);
  layout.place<SolidRecord>(csg.solids.size(), header.solid_offset, header.solid_count);
  const MeshInsides& meshes = csg.meshes;
  layout.place<MeshGridRecord>(meshes.grids().size(), header.mesh_grid_offset, header.mesh_grid_count);
  layout.place<std::uint32_t>(meshes.words().size(), header.mesh_word_offset, header.mesh_word_count);
  layout.place<MeshTriangleRecord>(meshes.triangles().size(), header.mesh_triangle_offset,
                                   header.mesh_triangle_count);
  layout.place<CrossedMeshRecord>(csg.crossed_meshes.records().size(), header.crossed_mesh_offset,
                                  header.crossed_mesh_count);
  layout.place<ShapeDataRecord>(objects.shape_data().records().size(), header.shape_data_offset,
                                  header.shape_data_count);
  layout.place<InstanceRecord>(instanced.instance_count(), header.instance_offset, header.instance_count);
  layout.place<ObjectRecord>(instanced.object_count(), header.mesh_object_offset, header.mesh_object_count);
  layout.place<NodeRecord>(instanced.node_count(), header.mesh_node_offset, header.mesh_node_count);
  layout.place<ExtraRecord>(std::size_t{counts.extras} + objects.unbounded_extras() + instanced.extra_count(),
                            header.extra_offset, header.extra_count);
  const std::uint32_t room = room_of_unbounded(objects.unbounded_count() + objects.projector_count());
  layout.place<ObjectRecord>(std::size_t{counts.objects} + room, header.object_offset, header.object_count);
  header.object_offset += room * std::uint32_t{sizeof(ObjectRecord)};
  header.object_count = counts.objects;
  header.unbounded_count = objects.unbounded_count();
  header.projector_count = objects.projector_count();
  const std::size_t ordered = groups.empty() ? 0 : groups.size() - 1;
  layout.place<GroupRecord>(ordered + instances.group_count(), header.group_offset, header.group_count);
  layout.place<std::uint32_t>(instances.group_count() == 0 ? 0 : header.group_count, header.prototype_offset,
                              header.prototype_count);
  header.bytes = layout.end();
  header.longest_group = instances.longest_group();
  for (std::size_t group = 0; group < ordered; ++group)
    header.longest_group = std::max(header.longest_group, groups[group + 1] - groups[group]);
  return header;
}

ImageHeader with_surfaces(const ImageHeader& old, const Scene& scene, std::size_t own_interiors,
                          const LightSets& light_sets, const TextureTables& textures) {
  ImageHeader header = old;
  Layout layout(sizeof(ImageHeader));
  place_surfaces(layout, header, scene, scene.interiors.size() + own_interiors, light_sets, textures,
                 old.blend_count);
  header.light_features |=
      old.light_features & (light_feature::near_surfaces | light_feature::unseen | light_feature::restarts);
  return header;
}

bool have_same_layout(const ImageHeader& a, const ImageHeader& b) {
  ImageHeader other = b;
  other.light_features = a.light_features;
  other.sky = a.sky;
  other.surface_nodes = a.surface_nodes;
  std::copy(a.bounds_min, a.bounds_min + 3, other.bounds_min);
  std::copy(a.bounds_max, a.bounds_max + 3, other.bounds_max);
  return std::memcmp(&a, &other, sizeof a) == 0;
}

} // namespace celltrace
