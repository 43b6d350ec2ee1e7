// A hierarchy of boxes built over given objects, and what it takes to look at it.
#pragma once

#include "direct_spu.hpp"
#include "kernel/build_hierarchy.hpp"
#include "scene/scene_image.hpp"

#include <barrier>
#include <cstdint>
#include <cstring>
#include <thread>
#include <vector>

namespace celltrace::test {

class BuiltHierarchy {
public:
  /// `work_pairs` for each sort buffer; 0: as many as should be.
  explicit BuiltHierarchy(const std::vector<kernel::ObjectRecord>& objects, std::uint32_t work_pairs = 0)
      : capacity_(static_cast<std::uint32_t>(objects.size()) / 3 + 2),
        frame_memory_(sizeof(kernel::FrameBlock)), frame_(*new (frame_memory_.data()) kernel::FrameBlock()) {
    const auto count = static_cast<std::uint32_t>(objects.size());
    const std::uint32_t nodes = kFirst + (count + 1) / 2 * 128;
    const std::uint32_t list = nodes + capacity_ * 128;
    image_ = AlignedBlock(list + std::size_t{count} * 4 + 4);
    if (count != 0) std::memcpy(image_.data() + kFirst, objects.data(), std::size_t{count} * 64);
    frame_.image = reinterpret_cast<std::uintptr_t>(image_.data());
    frame_.object_offset = kFirst;
    frame_.object_count = count;
    frame_.hierarchy = {nodes, capacity_, 0, list};
    frame_.sort_capacity =
        work_pairs != 0 ? work_pairs : static_cast<std::uint32_t>(kernel::hierarchy::work_pairs(count));
    for (int i = 0; i < 2; ++i) {
      work_[i] = AlignedBlock(std::size_t{frame_.sort_capacity} * 8);
      frame_.sort_buffer[i] = reinterpret_cast<std::uintptr_t>(work_[i].data());
    }
  }
  /// In this thread.
  std::uint32_t build() {
    DirectSpu spu;
    return frame_.hierarchy.node_count = kernel::build_hierarchy(spu, frame_);
  }
  /// In so many threads.
  std::uint32_t build(std::uint32_t threads) {
    struct Team {
      std::barrier<>& barrier;
      std::uint32_t threads, self;
      std::uint32_t size() const { return threads; }
      std::uint32_t index() const { return self; }
      void wait() { barrier.arrive_and_wait(); }
    };
    std::barrier<> barrier(threads);
    std::vector<std::uint32_t> nodes(threads);
    std::vector<std::thread> team;
    for (std::uint32_t i = 0; i < threads; ++i)
      team.emplace_back([&, i] {
        DirectSpu spu;
        nodes[i] = kernel::build_hierarchy(spu, frame_, Team{barrier, threads, i});
      });
    for (std::thread& thread : team)
      thread.join();
    return frame_.hierarchy.node_count = nodes.back();
  }

  const kernel::FrameBlock& frame() const { return frame_; }
  std::uint32_t capacity() const { return capacity_; }
  const kernel::NodeRecord& root() const { return node(frame_.hierarchy.node_offset); }
  const kernel::NodeRecord& node(std::uint32_t offset) const { return record<kernel::NodeRecord>(offset); }
  const kernel::ObjectRecord& object(std::uint32_t offset) const {
    return record<kernel::ObjectRecord>(offset);
  }
  std::uint32_t list_word(std::uint32_t offset) const { return record<std::uint32_t>(offset); }
  /// Nodes and list.
  std::vector<std::byte> bytes() const {
    return {image_.data() + frame_.hierarchy.node_offset, image_.data() + image_.size()};
  }

private:
  static constexpr std::uint32_t kFirst = 128;

  template <class Record> const Record& record(std::uint32_t offset) const {
    return *reinterpret_cast<const Record*>(image_.data() + offset);
  }

  std::uint32_t capacity_;
  AlignedBlock image_;
  AlignedBlock work_[2];
  AlignedBlock frame_memory_;
  kernel::FrameBlock& frame_;
};

} // namespace celltrace::test
