// A BVH built over given objects, and what it takes to look at it.
#pragma once

#include "direct_spu.hpp"
#include "kernel/direct/build_bvh.hpp"
#include "scene_image/object_order.hpp"
#include "scene_image/scene_image.hpp"

#include <algorithm>
#include <barrier>
#include <cstdint>
#include <cstring>
#include <thread>
#include <vector>

namespace celltrace::test {

/// A group of objects that is a copy of an earlier one, or the prototype itself, by the index among such
/// groups.
struct CopiedRun {
  std::uint32_t prototype;
  std::vector<kernel::ObjectRecord> objects;
};

class BuiltBvh {
public:
  /// Orders the objects as a scene image does. Those of `copies` come behind them.
  explicit BuiltBvh(std::vector<kernel::ObjectRecord> objects, const std::vector<CopiedRun>& copies = {})
      : frame_memory_(sizeof(kernel::FrameBlock)), frame_(*new (frame_memory_.data()) kernel::FrameBlock()) {
    std::vector<kernel::GroupRecord> groups = order(objects, copies.empty() ? kMinObjectsToOrder : 1);
    const auto first_copy = static_cast<std::uint32_t>(groups.size());
    std::vector<std::uint32_t> prototypes(groups.size(), kernel::kNoGroup);
    for (const CopiedRun& copy : copies) {
      prototypes.push_back(first_copy + copy.prototype);
      const auto first = static_cast<std::uint32_t>(objects.size());
      objects.insert(objects.end(), copy.objects.begin(), copy.objects.end());
      groups.push_back(group_of(objects, first, static_cast<std::uint32_t>(objects.size())));
    }
    const auto count = static_cast<std::uint32_t>(objects.size());
    const auto group_count = static_cast<std::uint32_t>(groups.size());
    capacity_ = kernel::bvh::most_nodes(count, group_count, !copies.empty());
    const std::uint32_t first_group = kFirst + (count + 1) / 2 * 128;
    const std::uint32_t first_prototype = first_group + (group_count + 3) / 4 * 128;
    const std::uint32_t nodes = first_prototype + (group_count + 31) / 32 * 128;
    const std::uint32_t list = nodes + capacity_ * 128;
    image_ = AlignedBlock(list + std::size_t{count} * 4 + 4);
    if (count != 0) std::memcpy(image_.data() + kFirst, objects.data(), std::size_t{count} * 64);
    if (group_count != 0)
      std::memcpy(image_.data() + first_group, groups.data(), std::size_t{group_count} * 32);
    if (group_count != 0)
      std::memcpy(image_.data() + first_prototype, prototypes.data(), std::size_t{group_count} * 4);
    frame_.image = reinterpret_cast<std::uintptr_t>(image_.data());
    frame_.object_offset = kFirst;
    frame_.object_count = count;
    frame_.group_offset = first_group;
    frame_.group_count = group_count;
    frame_.prototype_offset = copies.empty() ? 0 : first_prototype;
    for (const kernel::GroupRecord& group : groups)
      frame_.longest_group = std::max(frame_.longest_group, group.count);
    frame_.bvh = {nodes, capacity_, 0, list};
    const kernel::bvh::WorkSize work(count, group_count, frame_.longest_group);
    frame_.work_entries = static_cast<std::uint32_t>(work.pairs());
    for (int i = 0; i < 2; ++i) {
      work_[i] = AlignedBlock(std::size_t{frame_.work_entries} * 8);
      frame_.work_memory[i] = reinterpret_cast<std::uintptr_t>(work_[i].data());
    }
  }
  /// In this thread.
  std::uint32_t build() {
    DirectSpu spu;
    return frame_.bvh.node_count = kernel::build_bvh(spu, frame_);
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
        nodes[i] = kernel::build_bvh(spu, frame_, Team{barrier, threads, i});
      });
    for (std::thread& thread : team)
      thread.join();
    return frame_.bvh.node_count = nodes.back();
  }

  void use_large_leaves(bool large) { frame_.large_leaves = large; }
  const kernel::FrameBlock& frame() const { return frame_; }
  std::uint32_t capacity() const { return capacity_; }
  const kernel::NodeRecord& root() const { return node(frame_.bvh.node_offset); }
  const kernel::NodeRecord& node(std::uint32_t offset) const { return record<kernel::NodeRecord>(offset); }
  const kernel::ObjectRecord& object(std::uint32_t offset) const {
    return record<kernel::ObjectRecord>(offset);
  }
  std::uint32_t list_word(std::uint32_t offset) const { return record<std::uint32_t>(offset); }
  /// Nodes and list.
  std::vector<std::byte> bytes() const {
    return {image_.data() + frame_.bvh.node_offset, image_.data() + image_.size()};
  }

private:
  static constexpr std::uint32_t kFirst = 128;

  /// Nothing if there are fewer than `fewest`.
  static std::vector<kernel::GroupRecord> order(std::vector<kernel::ObjectRecord>& objects,
                                                std::uint32_t fewest) {
    const auto count = static_cast<std::uint32_t>(objects.size());
    if (count < fewest) return {};
    std::vector<PlacedObject> placed(count), spare(count);
    std::vector<std::uint32_t> cells(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const kernel::Aabb box = bounding_box(objects[i]);
      placed[i] = {{box.min[0] + box.max[0], box.min[1] + box.max[1], box.min[2] + box.max[2]}, i};
    }
    const std::vector<std::uint32_t> begins =
        order_along_curve(placed.data(), spare.data(), cells.data(), count, 1);
    const std::vector<kernel::ObjectRecord> as_given = objects;
    std::vector<kernel::GroupRecord> groups;
    for (std::uint32_t i = 0; i < count; ++i)
      objects[i] = as_given[placed[i].source];
    for (std::size_t group = 0; group + 1 < begins.size(); ++group)
      groups.push_back(group_of(objects, begins[group], begins[group + 1]));
    return groups;
  }
  static kernel::GroupRecord group_of(const std::vector<kernel::ObjectRecord>& objects, std::uint32_t begin,
                                      std::uint32_t end) {
    kernel::Aabb around = bounding_box(objects[begin]);
    for (std::uint32_t i = begin + 1; i < end; ++i)
      around = united(around, bounding_box(objects[i]));
    return {{around.min[0], around.min[1], around.min[2]},
            begin,
            {around.max[0], around.max[1], around.max[2]},
            end - begin};
  }

  template <class Record> const Record& record(std::uint32_t offset) const {
    return *reinterpret_cast<const Record*>(image_.data() + offset);
  }

  std::uint32_t capacity_ = 0;
  AlignedBlock image_;
  AlignedBlock work_[2];
  AlignedBlock frame_memory_;
  kernel::FrameBlock& frame_;
};

} // namespace celltrace::test
