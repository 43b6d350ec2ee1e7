// What the stages of a pipeline hand each other through main memory: searches of a packet of rays, as jobs of
// one or more. Kernel dialect.
//
// A job belongs to a context: the tree of one packet of primary rays, which has one job at a time under way.
// In main memory a context has a JobRecord and behind it as many SearchRecords as the scene has lights, or
// places on them.
#pragma once

#include "kernel/packet.hpp"

namespace celltrace::kernel::models {

enum class SearchKind : uint32_t { closest = 0, shadow = 1 };

/// What has to be done next with a job of the split pipeline.
enum class JobStage : uint32_t { walk = 0, test = 1 };

struct alignas(128) JobRecord {
  uint32_t searches; ///< records in use
  /// Split pipeline: bit i for search i, bit 31 for all from there on: some of its rays are under way.
  uint32_t live;
  uint32_t stage;       ///< split pipeline: JobStage
  uint32_t column, row; ///< of a packet of primary rays
  uint32_t unused[27];
};
static_assert(sizeof(JobRecord) == 128, "crosses DMA");

/// Light from a source to the points that shadow rays start at: its distance, and what is left of what they
/// would send on of it, or of the light itself if it comes from a place of an area.
struct LightOnItsWay {
  FloatLanes distance;
  VectorLanes colour;
};

/// A question of a packet and, when the search is over, its answer.
struct alignas(128) SearchRecord {
  RayPacket rays;
  union {
    HitPacket hits;      ///< closest
    LightOnItsWay light; ///< shadow; before the search, the colour is what comes if nothing is in the way
  };
  uint32_t kind;    ///< SearchKind
  uint32_t lanes;   ///< the rays
  uint32_t primary; ///< 1: they come from the camera
  uint32_t number;  ///< shadow: of the light

  // Split pipeline.
  uint32_t walked;    ///< 1: the walk has begun
  uint32_t pending;   ///< rays whose search is not over
  uint32_t lit;       ///< shadow: rays that are not shut off
  uint32_t returned;  ///< rays that came back from the tests without a hit in their voxel
  uint32_t reflected; ///< closest: rays that came by a mirror
  uint32_t unused[7];
  WordLanes cell;   ///< the voxel that each pending ray is in: its index,
  WordLanes place;  ///< its coordinates (VoxelWalk::place()),
  FloatLanes enter; ///< and where the ray enters
  FloatLanes leave; ///< and leaves it
};
static_assert(sizeof(SearchRecord) == 1024, "crosses DMA");

/// Parts of a SearchRecord that travel alone.
namespace search_part {
constexpr uint32_t question = 768;      ///< from the start: rays, answer, and what is asked
constexpr uint32_t answer_offset = 448; ///< hits or light,
constexpr uint32_t answer = 256;
constexpr uint32_t answer_and_head = 320; ///< with what was asked,
constexpr uint32_t progress = 576;        ///< with where the rays are
} // namespace search_part
static_assert(search_part::answer_offset == sizeof(RayPacket), "the answer follows the rays");

} // namespace celltrace::kernel::models
