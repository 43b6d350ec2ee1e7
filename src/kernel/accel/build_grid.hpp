// Builder of the uniform grid. Objects stream through local store, and each emits a pair of voxel and object
// for every voxel that it touches. Sorted by voxel, these pairs become the lists of the voxels. Kernel
// dialect.
#pragma once

#include "kernel/accel/object_bounds.hpp"
#include "kernel/accel/prepare_result.hpp"
#include "kernel/accel/radix_sort.hpp"
#include "kernel/accel/stream.hpp"
#include "records/frame.hpp"
#include "records/offsets.hpp"

namespace celltrace::kernel {

namespace detail {

constexpr uint32_t kExtraTag = 7;

/// Writes the pairs of all objects to the sort buffer and returns their number. Pairs that do not fit are
/// counted, so that the PPE knows how much memory to provide.
template <class Spu> uint32_t emit_pairs(Spu& spu, const FrameBlock& frame) {
  StreamReader<Spu, ObjectRecord> objects(spu, 0);
  StreamWriter<Spu, SortPair> pairs(spu, 2, frame.work_memory[0]);
  auto& extra = *spu.template allocate<ExtraRecord>();
  uint32_t count = 0;
  objects.for_each(
      frame.image + frame.object_offset, frame.object_count, [&](const ObjectRecord& object, uint32_t index) {
        const uint32_t offset = frame.object_offset + index * static_cast<uint32_t>(sizeof(ObjectRecord));
        // An ExtraRecord of a smooth triangle has normals, which are not needed, and bounds if the triangle
        // is part of a CSG.
        constexpr uint32_t kSmoothAndWhole = object_flag::smooth | object_flag::csg;
        if (object.extra != kNoOffset && (object.kind_and_flags & kSmoothAndWhole) != object_flag::smooth)
          Strategy<Spu>::fetch(spu, extra, frame.image + object.extra, kExtraTag);
        for_each_voxel(spu, frame.grid, object, extra, [&](uint32_t cell) {
          spu.compute(scalar_work::kEmitPair);
          if (count++ < frame.work_entries) pairs.write({cell, offset});
        });
      });
  pairs.flush();
  return count;
}

/// Writes the grid from pairs that are sorted by voxel: a record for each voxel and a word for each pair.
template <class Spu>
void write_lists(Spu& spu, const FrameBlock& frame, ea_t sorted, uint32_t count, uint32_t cell_count) {
  StreamReader<Spu, SortPair> pairs(spu, 0);
  StreamWriter<Spu, CellRecord> cells(spu, 2, frame.image + frame.grid.cell_offset);
  StreamWriter<Spu, uint32_t> lists(spu, 4, frame.image + frame.grid.list_offset);
  CellRecord open = {frame.grid.list_offset, 0};
  const auto close_up_to = [&](uint32_t cell) {
    while (cells.count() < cell) {
      spu.compute(scalar_work::kCloseVoxel);
      cells.write(open);
      open = {frame.grid.list_offset + lists.count() * 4, 0};
    }
  };
  pairs.for_each(sorted, count, [&](const SortPair& pair, uint32_t) {
    spu.compute(scalar_work::kListPair);
    close_up_to(pair.key);
    lists.write(pair.value);
    ++open.count;
  });
  close_up_to(cell_count);
  cells.flush();
  lists.flush();
}

} // namespace detail

/// Builds the grid that `frame.grid` describes. Uses about 110 KB of local store while it does so.
template <class Spu> PrepareResult build_grid(Spu& spu, const FrameBlock& frame) {
  uint8_t* const marked = spu.mark();
  const uint32_t count = detail::emit_pairs(spu, frame);
  spu.release(marked);
  if (count > frame.work_entries || count > frame.grid.list_capacity) return {count, false};

  const uint32_t cell_count = frame.grid.row_of_cells * frame.grid.cells[2];
  uint32_t bits = 0;
  while (bits < 32 && (cell_count - 1) >> bits != 0)
    ++bits;
  uint32_t result = 0;
  {
    StreamReader<Spu, SortPair> reader(spu, 0);
    result = RadixSort<Spu>(spu, reader).sort(frame.work_memory, count, bits);
  }
  spu.release(marked);
  detail::write_lists(spu, frame, frame.work_memory[result], count, cell_count);
  spu.release(marked);
  return {count, true};
}

} // namespace celltrace::kernel
