// Lists the fields of the frame block and the records beside it, so that celltrace/spe/byte_order.hpp can
// convert them for SPEs of another byte order.
#pragma once

#include "celltrace/spe/byte_order.hpp"
#include "records/accelerator.hpp"
#include "records/camera.hpp"
#include "records/frame.hpp"
#include "records/report.hpp"
#include "records/sampling.hpp"

namespace celltrace::kernel {

FieldList<&CameraRecord::origin, &CameraRecord::kind, &CameraRecord::base, &CameraRecord::bend,
          &CameraRecord::dx, &CameraRecord::middle_x, &CameraRecord::dy, &CameraRecord::middle_y,
          &CameraRecord::step_x, &CameraRecord::step_y, &CameraRecord::ahead, &CameraRecord::sheaf>
fields_of(const CameraRecord&);

FieldList<&GridRecord::min, &GridRecord::cell_offset, &GridRecord::max, &GridRecord::list_offset,
          &GridRecord::cell_size, &GridRecord::list_capacity, &GridRecord::inverse_cell_size,
          &GridRecord::list_count, &GridRecord::cells, &GridRecord::row_of_cells>
fields_of(const GridRecord&);

FieldList<&BvhRecord::node_offset, &BvhRecord::node_capacity, &BvhRecord::node_count, &BvhRecord::list_offset>
fields_of(const BvhRecord&);

FieldList<&SamplingRecord::method, &SamplingRecord::depth, &SamplingRecord::threshold,
          &SamplingRecord::jitter, &SamplingRecord::inverse_gamma, &SamplingRecord::colours_pitch>
fields_of(const SamplingRecord&);

FieldList<&FrameBlock::camera, &FrameBlock::grid, &FrameBlock::bvh, &FrameBlock::image, &FrameBlock::surface,
          &FrameBlock::units, &FrameBlock::costs, &FrameBlock::strips, &FrameBlock::reports,
          &FrameBlock::ray_stack, &FrameBlock::grid_points, &FrameBlock::sample_store,
          &FrameBlock::work_memory, &FrameBlock::prepare_spes, &FrameBlock::prepare_step, &FrameBlock::width,
          &FrameBlock::height, &FrameBlock::packet_columns, &FrameBlock::packet_rows,
          &FrameBlock::bundle_columns, &FrameBlock::surface_row, &FrameBlock::surface_rows,
          &FrameBlock::surface_pitch, &FrameBlock::work_entries, &FrameBlock::ray_stack_nodes,
          &FrameBlock::object_offset, &FrameBlock::object_count, &FrameBlock::light_offset,
          &FrameBlock::light_count, &FrameBlock::max_trace_level, &FrameBlock::adc_bailout,
          &FrameBlock::gamma_encoding, &FrameBlock::assumed_gamma, &FrameBlock::background,
          &FrameBlock::epoch, &FrameBlock::cache_ways, &FrameBlock::cache_sets,
          &FrameBlock::cache_replacement, &FrameBlock::cache_enabled, &FrameBlock::unit_count,
          &FrameBlock::exchange_parameter, &FrameBlock::camera_interior_count, &FrameBlock::accelerator,
          &FrameBlock::camera_interiors, &FrameBlock::group_offset, &FrameBlock::group_count,
          &FrameBlock::longest_group, &FrameBlock::prototype_offset, &FrameBlock::units_per_word,
          &FrameBlock::large_leaves, &FrameBlock::far_nodes, &FrameBlock::unbounded_count, &FrameBlock::sky,
          &FrameBlock::light_places, &FrameBlock::purpose, &FrameBlock::sampling, &FrameBlock::fog_offset,
          &FrameBlock::fog_count, &FrameBlock::light_features, &FrameBlock::rainbow_offset,
          &FrameBlock::rainbow_count, &FrameBlock::background_transparency>
fields_of(const FrameBlock&);

FieldList<&UnitRecord::column, &UnitRecord::row, &UnitRecord::bundles> fields_of(const UnitRecord&);

FieldList<&StripRecord::begin, &StripRecord::end, &StripRecord::unused> fields_of(const StripRecord&);

FieldList<&ReportRecord::primary_rays, &ReportRecord::shadow_rays, &ReportRecord::reflection_rays,
          &ReportRecord::refraction_rays, &ReportRecord::tests, &ReportRecord::accelerator_visits,
          &ReportRecord::cache_hits, &ReportRecord::cache_misses, &ReportRecord::dropped_rays,
          &ReportRecord::packets, &ReportRecord::exchanges, &ReportRecord::units_received,
          &ReportRecord::busy_ticks, &ReportRecord::spilled_nodes, &ReportRecord::list_entries,
          &ReportRecord::pixel_bytes, &ReportRecord::block_error, &ReportRecord::unused>
fields_of(const ReportRecord&);

} // namespace celltrace::kernel
