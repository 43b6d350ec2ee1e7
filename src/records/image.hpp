// The head of a scene image. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// Beyond this nobody counts what may go on from surfaces.
constexpr uint32_t kMostSurfaceNodes = 0x10000;

/// Head of a scene image.
struct alignas(128) ImageHeader {
  uint32_t magic;
  uint32_t version;
  uint64_t bytes;    ///< of the static part, this header included
  uint64_t checksum; ///< of the static part with this field 0
  uint32_t object_offset, object_count;
  uint32_t material_offset, material_count;
  uint32_t interior_offset, interior_count;
  uint32_t light_offset, light_count;
  uint32_t extra_offset, extra_count;
  uint32_t blend_offset, blend_count;
  float bounds_min[3];
  float bounds_max[3];
  uint32_t group_offset, group_count; ///< all objects by group, or nothing: there are few
  uint32_t longest_group;             ///< objects
  /// By group, the group that it is a copy of, its own index if it has copies, or kNoGroup; or nothing: there
  /// are no copies.
  uint32_t prototype_offset, prototype_count;
  /// Objects without bounds, just before the others; no accelerator has them.
  uint32_t unbounded_count;
  uint32_t csg_offset, csg_count;           ///< CsgRecords
  uint32_t csg_step_offset, csg_step_count; ///< CsgSteps
  uint32_t solid_offset, solid_count;       ///< SolidRecords
  uint32_t pattern_offset, pattern_count;
  uint32_t space_step_offset, space_step_count;
  uint32_t map_entry_offset, map_entry_count;
  uint32_t normal_offset, normal_count;
  uint32_t sky; ///< offset of the uppermost layer's MaterialRecord, whose pigments count; kNoOffset: none
  uint32_t mesh_grid_offset, mesh_grid_count;         ///< MeshGridRecords
  uint32_t mesh_word_offset, mesh_word_count;         ///< words of theirs
  uint32_t mesh_triangle_offset, mesh_triangle_count; ///< MeshTriangleRecords
  uint32_t fog_offset, fog_count;                     ///< FogRecords
  uint32_t finish_offset, finish_count;               ///< FinishRecords
  uint32_t light_ways;                                ///< bits of light_way
  uint32_t feature_offset, feature_count;             ///< FeatureRecords: kFeatures of them, or none
  uint32_t gradient_offset, gradient_count;           ///< GradientRecords: likewise
  uint32_t wave_offset, wave_count;                   ///< WaveRecords
  uint32_t light_set_count;                           ///< sets of lights, of which object_flag has numbers
  uint32_t light_word_offset, light_word_count;       ///< words of LightRecord::lit_sets
  uint32_t polygon_edge_offset, polygon_edge_count;   ///< PolygonEdgeRecords
  uint32_t rainbow_offset, rainbow_count;             ///< RainbowRecords
  uint32_t slope_offset, slope_count;                 ///< SlopeRecords
  uint32_t projector_count; ///< ObjectRecords of projectors, just before those without bounds
  uint32_t surface_nodes; ///< that what the rays of a node hit may push, at most; kMostSurfaceNodes: or more
  uint32_t instance_offset, instance_count;         ///< InstanceRecords
  uint32_t mesh_object_offset, mesh_object_count;   ///< ObjectRecords of the meshes of instances
  uint32_t mesh_node_offset, mesh_node_count;       ///< NodeRecords of their BVHs
  uint32_t crossed_mesh_offset, crossed_mesh_count; ///< CrossedMeshRecords
  uint32_t unused[15];
};
static_assert(sizeof(ImageHeader) == 384, "three lines");

} // namespace celltrace::kernel
