// The frame block, and units of work. Kernel dialect.
#pragma once

#include "celltrace/spe/types.hpp"
#include "records/accelerator.hpp"
#include "records/camera.hpp"
#include "records/sampling.hpp"

#include <stdint.h>

namespace celltrace::kernel {

enum class GammaEncoding : uint32_t { none = 0, assumed = 1 };

constexpr uint32_t kMaxInteriorDepth = 8;

/// Everything that an SPE needs for a frame. The address of the block in main memory does not change while
/// the SPEs run.
struct alignas(128) FrameBlock {
  CameraRecord camera;
  GridRecord grid;
  BvhRecord bvh;

  ea_t image;     ///< base of the scene image
  ea_t surface;   ///< RGBA8 pixels, or 8 bytes a packet with FramePurpose::blocks; rows of `surface_pitch`
                  ///< bytes; the address and the pitch are multiples of 16
  ea_t units;     ///< one UnitRecord per unit of work, filled up to whole cache lines
  ea_t costs;     ///< one uint32_t per unit of work, written by the SPEs: its duration in decrementer ticks
  ea_t strips;    ///< one StripRecord per SPE: the units that it starts the frame with
  ea_t reports;   ///< one ReportRecord per SPE
  ea_t ray_stack; ///< spill area: ray_stack_nodes nodes of kRayNodeBytes per SPE
  /// kGridPacketBytes per packet, row by row; then, with light_feature::first_hits, one FirstHitRecord per
  /// packet. No address if all frames are pictures.
  ea_t grid_points;
  ea_t sample_store; ///< sample_store_bytes() per SPE, for its own use; no address if all frames are pictures
  /// Work memory of a command. PREPARE FRAME: both blocks, each for `work_entries` pairs of 8 bytes.
  /// SYNCHRONIZE: the first block, with the list of cache lines that are out of date, of `work_entries`
  /// words, filled up to whole cache lines.
  ea_t work_memory[2];
  uint32_t
      prepare_spes; ///< number of SPEs that build the accelerator step by step; 0: one SPE takes all steps
  uint32_t prepare_step; ///< current step of building

  uint32_t width, height; ///< size in pixels, or in points of the grid
  uint32_t packet_columns, packet_rows;
  uint32_t bundle_columns;
  /// First row and number of the rows of packets that `surface` and `grid_points` have room for; they may be
  /// a part of the picture.
  uint16_t surface_row, surface_rows;
  uint32_t surface_pitch;
  uint32_t work_entries;
  uint32_t ray_stack_nodes;

  uint32_t object_offset, object_count;
  uint32_t light_offset, light_count;
  uint32_t max_trace_level;
  float adc_bailout;
  uint32_t gamma_encoding; ///< GammaEncoding
  float assumed_gamma;

  float background[3];
  uint32_t epoch; ///< number of the frame

  uint32_t cache_ways, cache_sets, cache_replacement, cache_enabled;

  uint32_t unit_count;
  uint32_t exchange_parameter; ///< lambda of the balancer, 16-bit fixed point; 0: SPEs keep their strips
  uint32_t camera_interior_count;
  uint32_t accelerator;                         ///< AcceleratorKind
  uint32_t camera_interiors[kMaxInteriorDepth]; ///< offsets of the interiors that the camera is in, outermost
                                                ///< first

  uint32_t group_offset, group_count; ///< GroupRecords
  uint32_t longest_group;             ///< number of objects
  uint32_t prototype_offset;          ///< offset of one word per group; 0: no group is a copy
  uint32_t
      units_per_word; ///< number of units between an SPE's reports of progress; 0: no reports; or kEachUnit
  uint32_t large_leaves;    ///< 0 or 1: leaves of the BVH have many triangles, which SPEs test together
  uint32_t far_nodes;       ///< 0 or 1: the BVH exceeds the caches, and SPEs wait long for a node
  uint32_t unbounded_count; ///< number of objects in no accelerator, which precede the others in the table
  uint32_t sky;             ///< as in ImageHeader
  uint32_t light_places; ///< number of places on lights toward which shadow rays go; the number of lights if
                         ///< none has an area
  uint32_t purpose;      ///< FramePurpose
  SamplingRecord sampling; ///< for frames other than pictures
  uint32_t fog_offset, fog_count;
  uint32_t light_features; ///< bits of light_feature
  uint32_t rainbow_offset, rainbow_count;
  /// Share of the light from behind the scene that the background lets through; used with
  /// light_feature::alpha, and 1 with light_feature::no_backdrop.
  float background_transparency;
};
static_assert(sizeof(FrameBlock) % 128 == 0 && sizeof(FrameBlock) <= 512, "fetched by one DMA command");

/// Value of FrameBlock::work_entries of SYNCHRONIZE if all cache lines are out of date.
constexpr uint32_t kAllLines = 0xFFFFFFFF;
/// Value of FrameBlock::units_per_word if an SPE reports the number of each unit once the unit's pixels are
/// in main memory.
constexpr uint32_t kEachUnit = 0xFFFFFFFF;

/// A unit of work: a run of bundles that begins at bundle (column, row) and continues at the beginning of the
/// next row of bundles where a row ends.
struct alignas(8) UnitRecord {
  uint16_t column, row;
  uint32_t bundles;
};
static_assert(sizeof(UnitRecord) == 8, "sixteen units a line");

/// Units [begin, end) that an SPE starts a frame with.
struct alignas(16) StripRecord {
  uint32_t begin, end;
  uint32_t unused[2];
};
static_assert(sizeof(StripRecord) == 16, "crosses DMA");

} // namespace celltrace::kernel
