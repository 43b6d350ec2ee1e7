#include "scene_image/scene_image.hpp"

#include "celltrace/error.hpp"
#include "kernel/direct/build_bvh_plan.hpp"
#include "scene/progress_monitor.hpp"
#include "scene_image/image_layout.hpp"
#include "scene_image/image_parts.hpp"
#include "scene_image/object_places.hpp"
#include "scene_image/table_writer.hpp"
#include "scene_image/touch_memory.hpp"
#include "scene_image/validation.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

namespace celltrace {

using namespace kernel;

namespace {

/// Returns the size in bytes of a BVH, the accelerator that is most likely to be built.
std::size_t bvh_bytes(const ImageHeader& header) {
  const std::size_t nodes =
      bvh::most_nodes(header.object_count, header.group_count, header.prototype_count != 0);
  return nodes * sizeof(NodeRecord) + header.object_count * sizeof(std::uint32_t) +
         leaf_word::kReadableBytes + kLineBytes;
}

Eye eye_of(const Scene& scene, bool may_move) {
  return {scene.camera, scene, may_move ? Eye::Moves::yes : Eye::Moves::no};
}

bool has_projectors(const Scene& scene) {
  return std::any_of(scene.lights.begin(), scene.lights.end(),
                     [](const Light& light) { return light.projected_through != nullptr; });
}

} // namespace

SceneImage::SceneImage(const Scene& scene) {
  AlignedBlock work;
  assign(scene, work, 1);
}

void SceneImage::assign(const Scene& given, AlignedBlock& work, unsigned threads,
                        std::uint32_t objects_a_thread, const ImageMemory& remembered) {
  ProgressMonitor::report(0);
  validate(given);
  ImageParts parts(given, eye_of(given, remembered.eye_moves), threads);
  threads = parts.threads_for(objects_a_thread, threads);
  NewPlaces placed(parts.objects, parts.instances.group_count() != 0, work, threads);
  const ObjectPlaces places = placed.places();
  const ImageHeader header = parts.header(places);

  ProgressMonitor::report(0.6);
  const std::size_t bytes = header.bytes + bvh_bytes(header);
  if (remembered.most_bytes != 0 && bytes > remembered.most_bytes)
    throw InputError("the scene takes " + std::to_string(bytes) + " bytes with its BVH, and " +
                     std::to_string(remembered.most_bytes) + " are allowed");
  block_.reserve(bytes);
  origin_.reset();
  touch(block_, header.bytes, threads);
  parts.write(block_.data(), header, places, threads);
  owners_.clear();
  if (remembered.owners) owners_ = parts.owners(*places.in_order);
  if (remembered.updatable) {
    origin_ = std::make_unique<Origin>();
    origin_->places = placed.by_object();
    origin_->placed = places.counts.objects;
    origin_->groups = placed.take_groups();
    origin_->forms = parts.forms();
    origin_->order = parts.objects.order();
    origin_->own_interiors = header.interior_count - given.interiors.size();
  }
  remember(parts);
}

void SceneImage::remember(ImageParts& parts) {
  eye_ = std::move(parts.eye);
  limits_ = std::move(parts.limits);
  boundaries_.clear();
  if (eye_.may_move()) boundaries_ = parts.objects.take_boundaries();
  if (!origin_) return;
  origin_->material_flags = std::move(parts.surfaces.textures.object_flags);
  origin_->surfaces_are_apart = parts.surfaces.textures.objects.empty() && !has_projectors(parts.given);
}

bool SceneImage::update_surfaces(const Scene& scene) {
  if (!origin_ || !origin_->surfaces_are_apart || has_projectors(scene)) return false;
  validate_all_but_objects(scene);
  SurfaceParts surfaces(scene);
  if (!surfaces.textures.objects.empty() || surfaces.textures.object_flags != origin_->material_flags)
    return false;
  const ImageHeader updated =
      with_surfaces(header(), scene, origin_->own_interiors, surfaces.light_sets, surfaces.textures);
  if (!have_same_layout(header(), updated)) return false;

  std::memcpy(block_.data(), &updated, sizeof updated);
  TableWriter writer(block_.data(), updated, scene, surfaces.textures, 0);
  surfaces.write(writer, {});
  return true;
}

bool SceneImage::update_boundaries(const Scene& scene) {
  if (empty() || !eye_.prepares_alike_but_boundaries(scene.camera.location)) return false;
  eye_.move_to(scene.camera, scene);
  auto* const solids = reinterpret_cast<SolidRecord*>(block_.data() + header().solid_offset);
  for (const SolidBoundary& boundary : boundaries_)
    boundary.write(eye_, solids);
  return true;
}

bool SceneImage::update(const Scene& given, AlignedBlock& work, unsigned threads,
                        std::uint32_t objects_a_thread) {
  if (!origin_ || given.objects.size() != origin_->forms.size()) return false;
  validate(given);
  ImageParts parts(given, eye_of(given, eye_.may_move()), threads);
  const SceneObjects& objects = parts.objects;
  if (parts.forms() != origin_->forms || objects.count() != origin_->places.size() ||
      objects.order() != origin_->order)
    return false;
  threads = parts.threads_for(objects_a_thread, threads);
  ObjectPlaces places;
  places.are_known = true;
  places.groups = origin_->groups;
  // Plain triangles are written while they are counted; if their number turns out to differ, the image has to
  // be built anew. Other objects are counted first, since errors in them must leave the image as it was.
  places.are_written =
      header().extra_count == 0 && header().blend_count == 0 && objects.are_plain_triangles();
  if (places.are_written) {
    places.counts.objects = origin_->placed;
  } else {
    const std::optional<ObjectCounts> counts = count_placed(objects, origin_->places, threads);
    if (!counts || counts->objects != origin_->placed) return false;
    places.counts = *counts;
  }
  const ImageHeader updated = parts.header(places);
  if (!have_same_layout(header(), updated)) return false;

  if (updated.extra_count != 0 ||
      updated.blend_count != 0) { // the order of these records follows that of the objects
    const OrderMemory memory(work, objects.count());
    places.in_order = in_order_of(origin_->places, origin_->placed, memory);
    places.cells = memory.cells;
  } else if (!places.are_written) {
    places.by_object = origin_->places;
  } else {
    TableWriter writer = parts.writer(block_.data(), updated);
    const std::optional<ObjectCounts> counts = send_placed(writer, objects, origin_->places, threads);
    if (!counts || counts->objects != origin_->placed || counts->extras != 0 || counts->blended != 0) {
      origin_.reset();
      return false;
    }
    places.counts = *counts;
  }
  parts.write(block_.data(), updated, places, threads);
  remember(parts);
  return true;
}

Index SceneImage::owner_of_instanced(std::uint32_t number) const noexcept {
  const auto* const first = reinterpret_cast<const InstanceRecord*>(block_.data() + header().instance_offset);
  const auto* const after = std::upper_bound(
      first, first + header().instance_count, number - kInstancedBit,
      [](std::uint32_t n, const InstanceRecord& instance) { return n < instance.first_number; });
  return after != first ? after[-1].owner : kNoIndex;
}

void SceneImage::reserve_accelerator(std::uint64_t table_bytes, std::uint32_t list_words) {
  const std::size_t begin = header().bytes;
  const std::size_t lists = whole_lines(begin + table_bytes);
  const std::size_t list_bytes = std::size_t{list_words} * sizeof(std::uint32_t) + leaf_word::kReadableBytes;
  const std::size_t end = whole_lines(lists + list_bytes);
  if (end > std::numeric_limits<std::uint32_t>::max())
    throw InputError("the scene is too large: its image would pass 4 GB");
  if (header().instance_count != 0 && end > kInstancedBit)
    throw InputError("the scene is too large: with instances of meshes, its image would pass 2 GB");
  if (end > block_.size()) {
    AlignedBlock larger = AlignedBlock::uninitialised(end);
    std::memcpy(larger.data(), block_.data(), begin);
    block_ = std::move(larger);
  }
  table_offset_ = static_cast<std::uint32_t>(begin);
  list_offset_ = static_cast<std::uint32_t>(lists);
  end_offset_ = static_cast<std::uint32_t>(end);
}

} // namespace celltrace
