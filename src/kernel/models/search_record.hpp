// Records that the stages of a pipeline exchange through main memory: searches of packets of rays, and jobs
// of one or more searches. Kernel dialect.
//
// A job belongs to a context: the tree of one packet of primary rays, which has one job in progress at a
// time. In main memory a context has a JobRecord, followed by as many SearchRecords as the scene has lights,
// or places on lights.
#pragma once

#include "kernel/packet.hpp"

namespace celltrace::kernel::models {

enum class SearchKind : uint32_t { closest = 0, shadow = 1 };

/// Next step of a job of the split pipeline.
enum class JobStage : uint32_t { walk = 0, test = 1 };

struct alignas(128) JobRecord {
  uint32_t searches; ///< number of records in use
  /// Split pipeline: searches with rays in progress; bit i for search i, bit 31 for all searches from 31 on.
  uint32_t live;
  uint32_t stage;       ///< split pipeline: JobStage
  uint32_t column, row; ///< position of a packet of primary rays
  uint32_t unused[27];
};
static_assert(sizeof(JobRecord) == 128, "crosses DMA");

/// Light from a source to the origins of shadow rays. `distance` is the source's distance; `colour` is what
/// is left of the light that the points reflect, or, from a place on an area light, of the light itself.
struct ShadowRayLight {
  FloatLanes distance;
  VectorLanes colour;
};

/// A query of a packet and, when the search is complete, its answer.
struct alignas(128) SearchRecord {
  RayPacket rays;
  union {
    HitPacket hits;       ///< closest hits
    ShadowRayLight light; ///< for shadow searches; before the search, the colour is that of unoccluded light
  };
  uint32_t kind;    ///< SearchKind
  uint32_t lanes;   ///< rays of the search
  uint32_t primary; ///< 1: camera rays
  uint32_t number;  ///< for shadow searches: number of the light

  // Members for the split pipeline:
  uint32_t walked;    ///< 1: the walk has begun
  uint32_t pending;   ///< rays whose search is not complete
  uint32_t lit;       ///< for shadow searches: rays that are not occluded
  uint32_t returned;  ///< rays that came back from the tests without a hit in their voxel
  uint32_t reflected; ///< for closest hits: rays that came by a mirror
  uint32_t unused[7];
  WordLanes cell;   ///< index of the voxel that each pending ray is in
  WordLanes place;  ///< coordinates of the voxel (VoxelWalk::place())
  FloatLanes enter; ///< distance at which the ray enters the voxel
  FloatLanes leave; ///< distance at which the ray leaves the voxel
};
static_assert(sizeof(SearchRecord) == 1024, "crosses DMA");

/// Parts of a SearchRecord that are transferred separately, in bytes.
namespace search_part {
constexpr uint32_t question = 768;      ///< from the start: rays, answer, and head of the question
constexpr uint32_t answer_offset = 448; ///< position of the hits or the light
constexpr uint32_t answer = 256;
constexpr uint32_t answer_and_head = 320; ///< answer and head of the question
constexpr uint32_t progress = 576;        ///< answer, head, and positions of the rays
} // namespace search_part
static_assert(search_part::answer_offset == sizeof(RayPacket), "the answer follows the rays");

} // namespace celltrace::kernel::models
