#include "scene_image/object_places.hpp"

#include "scene/parallel.hpp"
#include "scene/progress_monitor.hpp"
#include "scene_image/image_layout.hpp"
#include "scene_image/touch_memory.hpp"

#include <algorithm>

namespace celltrace {

namespace {

/// Writes the scene's objects that can be hit to `to`; threads place parts, which are then moved together.
ObjectCensus place_all(const SceneObjects& objects, PlacedObject* to, unsigned threads) {
  std::vector<ObjectCensus> census(threads);
  for_each_part(threads, [&](unsigned part) {
    const HostPart mine(objects.count(), part, threads);
    census[part] = objects.place(mine.begin, mine.end, to + mine.begin);
  });
  for (unsigned part = 1; part < threads; ++part) {
    const PlacedObject* from = to + HostPart(objects.count(), part, threads).begin;
    std::copy(from, from + census[part].objects, to + census[0].objects);
    census[0].add(census[part]);
  }
  return census[0];
}

/// Counts objects that have places already: calls `count(begin, end)` for parts in threads. Returns nothing
/// if an object that can be hit has no place.
template <class Count>
std::optional<ObjectCensus> count_in_parts(std::uint32_t objects, unsigned threads, Count count) {
  std::vector<std::optional<ObjectCensus>> census(threads);
  for_each_part(threads, [&](unsigned part) {
    const HostPart mine(objects, part, threads);
    census[part] = count(mine.begin, mine.end);
  });
  for (unsigned part = 1; part < threads && census[0]; ++part) {
    if (!census[part]) return std::nullopt;
    census[0]->add(*census[part]);
  }
  return census[0];
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
  census_ = place_all(objects, memory_.objects, threads);
  ProgressMonitor::report(0.4);
  if (census_.objects != 0 && (census_.objects >= kMinObjectsToOrder || copies))
    groups_ = order_along_curve(memory_.objects, memory_.spare, memory_.cells, census_.objects, threads);
}

ObjectPlaces NewPlaces::places() const {
  ObjectPlaces places;
  places.census = census_;
  places.groups = groups_;
  places.in_order.emplace(memory_.objects, census_.objects);
  places.cells = memory_.cells;
  return places;
}

std::vector<std::uint32_t> NewPlaces::by_object() const {
  std::vector<std::uint32_t> places(objects_.count(), SceneObjects::kNoPlace);
  for (std::uint32_t i = 0; i < census_.objects; ++i) {
    ProgressMonitor::check_cancelled(i);
    places[memory_.objects[i].source] = i;
  }
  return places;
}

std::optional<ObjectCensus> count_placed(const SceneObjects& objects, std::span<const std::uint32_t> places,
                                         unsigned threads) {
  return count_in_parts(objects.count(), threads, [&](std::uint32_t begin, std::uint32_t end) {
    return objects.count_placed(begin, end, places);
  });
}

std::optional<ObjectCensus> send_placed(TableWriter& writer, const SceneObjects& objects,
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
