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

/// Everything an SPE needs for a frame. Lies in main memory at a place that does not change while the SPEs
/// run.
struct alignas(128) FrameBlock {
  CameraRecord camera;
  GridRecord grid;
  BvhRecord bvh;

  ea_t image;     ///< base of the scene image
  ea_t surface;   ///< RGBA8, or 8 bytes a packet; rows of `surface_pitch` bytes, both multiples of 16 bytes
  ea_t units;     ///< UnitRecord per unit of work, whole lines of them
  ea_t costs;     ///< uint32_t per unit of work, written by the SPEs: ticks that it took
  ea_t strips;    ///< StripRecord per SPE: the units it starts the frame with
  ea_t reports;   ///< ReportRecord per SPE
  ea_t ray_stack; ///< spill area: ray_stack_nodes nodes of kRayNodeBytes per SPE
  /// kGridPacketBytes per packet, row by row, then with light_way::first_hits a FirstHitRecord per packet;
  /// none if all frames are pictures.
  ea_t grid_points;
  ea_t sample_store; ///< sample_store_bytes() per SPE, its own; likewise
  /// Memory of a command: PREPARE FRAME's work memory, `work_entries` pairs of 8 bytes each; SYNCHRONIZE's
  /// list of lines that are out of date, the first block alone, whole lines of it, of `work_entries` words.
  ea_t work_memory[2];
  uint32_t prepare_spes; ///< that build the accelerator step by step; 0: one takes all steps
  uint32_t prepare_step; ///< the step that is to be taken

  uint32_t width, height; ///< pixels, or points of the grid
  uint32_t packet_columns, packet_rows;
  uint32_t bundle_columns;
  /// Rows of packets that `surface` and `grid_points` have room for, which may be a part of the picture's,
  /// and the first one of them.
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
  uint32_t epoch; ///< counts frames

  uint32_t cache_ways, cache_sets, cache_replacement, cache_enabled;

  uint32_t unit_count;
  uint32_t exchange_parameter; ///< lambda, 16-bit fixed point; 0: strips stay as they are
  uint32_t camera_interior_count;
  uint32_t accelerator;                         ///< AcceleratorKind
  uint32_t camera_interiors[kMaxInteriorDepth]; ///< offsets, outermost first

  uint32_t group_offset, group_count; ///< RunRecords
  uint32_t longest_group;             ///< objects
  uint32_t prototype_offset;          ///< a word per group; 0: there are no copies
  uint32_t units_per_word;            ///< that an SPE tells of its progress by; 0: it does not; or kEachUnit
  uint32_t wide_leaves;               ///< 0 or 1: for SPEs that test many triangles of a leaf at once
  uint32_t far_nodes;                 ///< 0 or 1: for SPEs that wait long for a node of the BVH
  uint32_t unbounded_count;           ///< objects just before the others that no accelerator has
  uint32_t sky;                       ///< as in ImageHeader
  uint32_t light_places;   ///< that shadows are looked for at; as many as lights if none has an area
  uint32_t purpose;        ///< FramePurpose
  SamplingRecord sampling; ///< of frames that are no picture
  uint32_t fog_offset, fog_count;
  uint32_t light_ways; ///< bits of light_way
  uint32_t rainbow_offset, rainbow_count;
  /// Share of what is behind the scene that comes through the background; counts with light_way::alpha, 1
  /// with light_way::no_backdrop.
  float background_clear;
};
static_assert(sizeof(FrameBlock) % 128 == 0 && sizeof(FrameBlock) <= 512, "fetched by one DMA command");

/// FrameBlock::work_entries of SYNCHRONIZE: all lines are out of date.
constexpr uint32_t kAllLines = 0xFFFFFFFF;
/// FrameBlock::units_per_word: every unit is told by its number, once its pixels are in main memory.
constexpr uint32_t kEachUnit = 0xFFFFFFFF;

/// A unit of work: bundles in a row of bundles from `column` on, and on in the next row where it ends.
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
