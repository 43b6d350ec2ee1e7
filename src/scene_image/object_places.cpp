#include "scene_image/object_places.hpp"

#include "scene/parallel.hpp"
#include "scene/progress_monitor.hpp"
#include "scene_image/image_layout.hpp"
#include "scene_image/touch_memory.hpp"

#include <algorithm>

namespace celltrace {

namespace {

/// Writes the scene's objects that can be hit to `to`. Each thread writes a part; the parts are then joined.
ObjectCounts place_all(const SceneObjects& objects, PlacedObject* to, unsigned threads) {
  std::vector<ObjectCounts> counts(threads);
  for_each_part(threads, [&](unsigned part) {
    const HostPart mine(objects.count(), part, threads);
    counts[part] = objects.place(mine.begin, mine.end, to + mine.begin);
  });
  for (unsigned part = 1; part < threads; ++part) {
    const PlacedObject* from = to + HostPart(objects.count(), part, threads).begin;
    std::copy(from, from + counts[part].objects, to + counts[0].objects);
    counts[0].add(counts[part]);
  }
  return counts[0];
}

/// Counts objects that have places already: calls `count(begin, end)` for parts in threads. Returns nothing
/// if an object that can be hit has no place.
template <class Count>
std::optional<ObjectCounts> count_in_parts(std::uint32_t objects, unsigned threads, Count count) {
  std::vector<std::optional<ObjectCounts>> counts(threads);
  for_each_part(threads, [&](unsigned part) {
    const HostPart mine(objects, part, threads);
    counts[part] = count(mine.begin, mine.end);
  });
  for (unsigned part = 1; part < threads && counts[0]; ++part) {
    if (!counts[part]) return std::nullopt;
    counts[0]->add(*counts[part]);
  }
  return counts[0];
}

} // namespace

OrderMemory::OrderMemory(AlignedBlock& block, std::uint32_t count) {
  const std::size_t list = whole_lines(std::size_t{count} * sizeof(PlacedObject));
  block.reserve(2 * list + std::size_t{count} * sizeof(std::uint32_t));
  objects = reinterpret_cast<PlacedObject*>(block.data());
  spare = reinterpret_cast<PlacedObject*>(block.data() + list);
  cells = reinterpret_cast<std::uint32_t*>(block.data() + 2 * list);
}

NewPlaces::NewPlaces(const SceneObjects& objects, bool copies, AlignedBlock& work, unsigned threads)
    : objects_(objects), memory_(work, objects.count()) {
  touch(work, work.size(), threads);
  counts_ = place_all(objects, memory_.objects, threads);
  ProgressMonitor::report(0.4);
  if (counts_.objects != 0 && (counts_.objects >= kMinObjectsToOrder || copies))
    groups_ = order_along_curve(memory_.objects, memory_.spare, memory_.cells, counts_.objects, threads);
}

ObjectPlaces NewPlaces::places() const {
  ObjectPlaces places;
  places.counts = counts_;
  places.groups = groups_;
  places.in_order.emplace(memory_.objects, counts_.objects);
  places.cells = memory_.cells;
  return places;
}

std::vector<std::uint32_t> NewPlaces::by_object() const {
  std::vector<std::uint32_t> places(objects_.count(), SceneObjects::kNoPlace);
  for (std::uint32_t i = 0; i < counts_.objects; ++i) {
    ProgressMonitor::check_cancelled(i);
    places[memory_.objects[i].source] = i;
  }
  return places;
}

std::optional<ObjectCounts> count_placed(const SceneObjects& objects, std::span<const std::uint32_t> places,
                                         unsigned threads) {
  return count_in_parts(objects.count(), threads, [&](std::uint32_t begin, std::uint32_t end) {
    return objects.count_placed(begin, end, places);
  });
}

std::optional<ObjectCounts> send_placed(TableWriter& writer, const SceneObjects& objects,
                                        std::span<const std::uint32_t> places, unsigned threads) {
  return count_in_parts(objects.count(), threads, [&](std::uint32_t begin, std::uint32_t end) {
    return writer.send_placed(objects, places, begin, end);
  });
}

std::span<const PlacedObject> in_order_of(std::span<const std::uint32_t> places, std::uint32_t placed,
                                          const OrderMemory& memory) {
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    ProgressMonitor::check_cancelled(i);
    if (const std::uint32_t place = places[i]; place != SceneObjects::kNoPlace)
      memory.objects[place].source = i;
  }
  return {memory.objects, placed};
}

} // namespace celltrace
