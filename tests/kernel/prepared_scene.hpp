// A scene image and the frame block around it, as the PPE side hands them to the SPE program.
#pragma once

#include "direct_spu.hpp"
#include "kernel/entry/strategies.hpp"
#include "kernel/program/prepare_frame.hpp"
#include "render/frame_setup.hpp"
#include "scene_image/scene_image.hpp"

#include <optional>

namespace celltrace::test {

class PreparedScene {
public:
  /// Chooses the grid as the renderer does, unless one is given.
  explicit PreparedScene(const Scene& scene, std::optional<kernel::GridRecord> grid = {})
      : image_(scene), block_(sizeof(kernel::FrameBlock)), frame_(*new (block_.data()) kernel::FrameBlock()) {
    frame_.grid = grid ? *grid : choose_grid(image_.header());
    grid_ = frame_.grid;
    make_room(std::uint32_t{1} << 18);
    set_scene(frame_, scene, RenderOptions(), image_);
  }

  /// Has a BVH built in place of the grid.
  void use_bvh(bool large_leaves, bool far_nodes = false) {
    frame_.large_leaves = large_leaves;
    frame_.far_nodes = far_nodes;
    const std::uint32_t nodes =
        kernel::bvh::most_nodes(object_count(), header().group_count, header().prototype_count != 0);
    image_.reserve_accelerator(nodes * sizeof(kernel::NodeRecord), object_count());
    frame_.image = reinterpret_cast<std::uintptr_t>(image_.base());
    frame_.accelerator = static_cast<std::uint32_t>(kernel::AcceleratorKind::bvh);
    frame_.bvh = {image_.table_offset(), nodes, 0, image_.list_offset()};
    const kernel::bvh::WorkSize work(object_count(), header().group_count, header().longest_group);
    reserve_work(static_cast<std::uint32_t>(work.pairs()));
  }
  /// Room for this many (voxel, object) pairs.
  void make_room(std::uint32_t pairs) {
    image_.reserve_accelerator(std::uint64_t{cell_count()} * sizeof(kernel::CellRecord), pairs);
    frame_.image = reinterpret_cast<std::uintptr_t>(image_.base());
    frame_.grid = grid_;
    frame_.grid.cell_offset = image_.table_offset();
    frame_.grid.list_offset = image_.list_offset();
    frame_.grid.list_capacity = pairs;
    reserve_work(pairs);
  }
  /// Builds the grid in this thread.
  kernel::PrepareResult prepare() {
    DirectSpu spu;
    return kernel::prepare_frame(spu, frame_);
  }

  kernel::FrameBlock& frame() { return frame_; }
  const kernel::FrameBlock& frame() const { return frame_; }
  const kernel::ImageHeader& header() const { return image_.header(); }
  template <class Record> const Record& record(std::uint32_t offset) const {
    return *reinterpret_cast<const Record*>(image_.base() + offset);
  }
  std::uint32_t object_count() const { return header().object_count; }
  std::uint32_t object_offset(std::uint32_t index) const { return header().object_offset + index * 64; }
  const kernel::ObjectRecord& object(std::uint32_t index) const {
    return record<kernel::ObjectRecord>(object_offset(index));
  }
  const kernel::CellRecord& cell(std::uint32_t index) const {
    return record<kernel::CellRecord>(frame_.grid.cell_offset + index * 8);
  }
  std::uint32_t cell_count() const { return grid_.row_of_cells * grid_.cells[2]; }

private:
  void reserve_work(std::uint32_t pairs) {
    frame_.work_entries = pairs;
    for (int i = 0; i < 2; ++i) {
      sort_[i] = AlignedBlock(std::size_t{pairs} * 8);
      frame_.work_memory[i] = reinterpret_cast<std::uintptr_t>(sort_[i].data());
    }
  }

  SceneImage image_;
  kernel::GridRecord grid_;
  AlignedBlock sort_[2];
  AlignedBlock block_;
  kernel::FrameBlock& frame_;
};

/// A grid of given resolution over a box.
inline kernel::GridRecord grid_of(const Vec3& min, const Vec3& max, std::uint32_t x, std::uint32_t y,
                                  std::uint32_t z) {
  kernel::GridRecord grid{};
  const std::uint32_t cells[3] = {x, y, z};
  for (int i = 0; i < 3; ++i) {
    grid.cells[i] = cells[i];
    grid.min[i] = static_cast<float>(min[i]);
    grid.max[i] = static_cast<float>(max[i]);
    grid.cell_size[i] = static_cast<float>((max[i] - min[i]) / cells[i]);
    grid.inverse_cell_size[i] = static_cast<float>(cells[i] / (max[i] - min[i]));
  }
  grid.row_of_cells = x * y;
  return grid;
}

} // namespace celltrace::test
