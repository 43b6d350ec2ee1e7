// The head of a scene image. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// Limit of ImageHeader::surface_nodes.
constexpr uint32_t kMostSurfaceNodes = 0x10000;

/// Head of a scene image.
struct alignas(128) ImageHeader {
  uint32_t magic;
  uint32_t version;
  uint64_t bytes;    ///< size of the static part, this header included
  uint64_t checksum; ///< checksum of the static part with this field 0
  uint32_t object_offset, object_count;
  uint32_t material_offset, material_count;
  uint32_t interior_offset, interior_count;
  uint32_t light_offset, light_count;
  uint32_t extra_offset, extra_count;
  uint32_t blend_offset, blend_count;
  float bounds_min[3];
  float bounds_max[3];
  uint32_t group_offset, group_count; ///< GroupRecords of all objects; count 0: there are too few for groups
  uint32_t longest_group;             ///< objects
  /// One word per group: the index of its prototype, its own index if it has copies, or kNoGroup. The count
  /// is 0 if no group is a copy.
  uint32_t prototype_offset, prototype_count;
  /// Number of objects without bounds, which are in no accelerator; they precede the others in the table.
  uint32_t unbounded_count;
  uint32_t csg_offset, csg_count;           ///< CsgRecords
  uint32_t csg_step_offset, csg_step_count; ///< CsgSteps
  uint32_t solid_offset, solid_count;       ///< SolidRecords
  uint32_t pattern_offset, pattern_count;
  uint32_t space_step_offset, space_step_count;
  uint32_t map_entry_offset, map_entry_count;
  uint32_t normal_offset, normal_count;
  uint32_t sky; ///< offset of the MaterialRecord of the sky's uppermost layer, of which only the pigments are
                ///< used; kNoOffset: no sky
  uint32_t mesh_grid_offset, mesh_grid_count;         ///< MeshGridRecords
  uint32_t mesh_word_offset, mesh_word_count;         ///< words of MeshGridRecords: starts and lists of cells
  uint32_t mesh_triangle_offset, mesh_triangle_count; ///< MeshTriangleRecords
  uint32_t fog_offset, fog_count;                     ///< FogRecords
  uint32_t finish_offset, finish_count;               ///< FinishRecords
  uint32_t light_features;                            ///< bits of light_feature
  uint32_t feature_offset, feature_count;             ///< kFeatures FeatureRecords, or none
  uint32_t gradient_offset, gradient_count;           ///< kGradients GradientRecords, or none
  uint32_t wave_offset, wave_count;                   ///< WaveRecords
  uint32_t light_set_count; ///< number of sets of lights; object_flag::light_set_shift numbers them
  uint32_t light_word_offset, light_word_count;     ///< words of LightRecord::lit_sets
  uint32_t shape_data_offset, shape_data_count; ///< ShapeDataRecords
  uint32_t rainbow_offset, rainbow_count;           ///< RainbowRecords
  uint32_t slope_offset, slope_count;               ///< SlopeRecords
  uint32_t projector_count; ///< number of projectors' ObjectRecords, which precede the unbounded objects in
                            ///< the table
  uint32_t surface_nodes;   ///< largest number of nodes that the surfaces hit by a node's rays may push;
                            ///< kMostSurfaceNodes: as many or more
  uint32_t instance_offset, instance_count;         ///< InstanceRecords
  uint32_t mesh_object_offset, mesh_object_count;   ///< ObjectRecords of instanced meshes
  uint32_t mesh_node_offset, mesh_node_count;       ///< NodeRecords of the BVHs of instanced meshes
  uint32_t crossed_mesh_offset, crossed_mesh_count; ///< CrossedMeshRecords
  uint32_t picture_offset, picture_count;       ///< PictureRecords
  uint32_t texel_tile_offset, texel_tile_count; ///< TexelTileRecords
  uint32_t function_step_offset, function_step_count; ///< FunctionStepRecords
  uint32_t unused[9];
};
static_assert(sizeof(ImageHeader) == 384, "three lines");

} // namespace celltrace::kernel
