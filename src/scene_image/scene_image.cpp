#include "scene_image/scene_image.hpp"

#include "celltrace/error.hpp"
#include "kernel/direct/build_bvh_plan.hpp"
#include "prepare/passes.hpp"
#include "prepare/projectors.hpp"
#include "scene/build_watch.hpp"
#include "scene/parallel.hpp"
#include "scene_image/image_layout.hpp"
#include "scene_image/instanced_meshes.hpp"
#include "scene_image/light_sets.hpp"
#include "scene_image/mesh_instances.hpp"
#include "scene_image/near_surfaces.hpp"
#include "scene_image/scene_objects.hpp"
#include "scene_image/table_writer.hpp"
#include "scene_image/textures.hpp"
#include "scene_image/validation.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

namespace celltrace {

using namespace kernel;

namespace {

/// What the accelerator that is most likely to be built needs.
std::size_t bvh_bytes(const ImageHeader& header) {
  const std::size_t nodes =
      bvh::most_nodes(header.object_count, header.group_count, header.prototype_count != 0);
  return nodes * sizeof(NodeRecord) + header.object_count * sizeof(std::uint32_t) +
         leaf_word::kReadableBytes + kLineBytes;
}

/// Work memory for ordering objects.
struct OrderMemory {
  PlacedObject* objects;
  PlacedObject* spare;
  std::uint32_t* cells;

  OrderMemory(AlignedBlock& block, std::uint32_t count) {
    const std::size_t list = whole_lines(std::size_t{count} * sizeof(PlacedObject));
    block.reserve(2 * list + std::size_t{count} * sizeof(std::uint32_t));
    objects = reinterpret_cast<PlacedObject*>(block.data());
    spare = reinterpret_cast<PlacedObject*>(block.data() + list);
    cells = reinterpret_cast<std::uint32_t*>(block.data() + 2 * list);
  }
};

/// Takes the first `bytes` bytes of memory from the system in their order. Where records are sent anywhere,
/// the first few of them would have it make all of that memory ready, which nothing could interrupt.
void touch(AlignedBlock& block, std::size_t bytes, unsigned threads) {
  constexpr std::size_t kPage = 4096, kBetweenLooks = std::size_t{2} << 20;
  const auto parts = static_cast<std::uint32_t>(bytes / kBetweenLooks);
  for_each_part(threads, [&](unsigned part) {
    const HostPart mine(parts, part, threads);
    for (std::size_t at = mine.begin * kBetweenLooks; at < mine.end * kBetweenLooks; at += kPage) {
      if (at % kBetweenLooks == 0) BuildWatch::look();
      *const_cast<volatile std::byte*>(block.data() + at) = std::byte(0);
    }
  });
}

/// Writes those of the scene's objects that can be hit to `to`; in parts, which are brought together.
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

/// The same where objects have places already: `count(begin, end)` is asked of parts. Nothing if one that can
/// be hit has none.
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

unsigned threads_for(const SceneObjects& objects, const MeshInstances& instances, unsigned threads,
                     std::uint32_t objects_a_thread) {
  const std::uint64_t all = std::uint64_t{objects.count()} + instances.census().objects;
  return static_cast<unsigned>(std::clamp<std::uint64_t>(all / objects_a_thread, 1, threads));
}

std::vector<ObjectForm> forms_of(const InstancedMeshes& instanced, const MeshInstances& instances,
                                 std::size_t objects) {
  std::vector<ObjectForm> forms(objects);
  for (std::size_t i = 0; i < objects; ++i)
    forms[i] = instanced.contains(i)   ? ObjectForm::instance
               : instances.contains(i) ? ObjectForm::copy
                                       : ObjectForm::itself;
  return forms;
}

/// `order`: the objects that are no instances, as they lie in the image.
std::vector<Index> owners_of(const SceneObjects& objects, std::span<const PlacedObject> order,
                             const MeshInstances& instances) {
  std::vector<Index> owners = objects.unbounded_owners();
  const std::vector<Index> loose = objects.owners();
  owners.reserve(owners.size() + order.size() + instances.census().objects);
  for (const PlacedObject& object : order)
    owners.push_back(loose[object.source]);
  instances.append_owners(owners);
  return owners;
}

/// What records are made of: a scene's textures, and its objects as single precision needs them.
struct SceneOfRecords {
  const std::optional<Scene> with_projectors; ///< of the scene as given: projectors have a material
  TextureTables textures;
  const PreparedScene prepared;

  SceneOfRecords(const Scene& given, const Eye& eye)
      : with_projectors(add_projectors(given, {eye, {}})),
        textures(with_projectors ? *with_projectors : given), prepared(given, {eye, textures.object_flags}) {}
};

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
  BuildWatch::reach(0);
  validate(given);
  Eye eye(given.camera, given, remembered.eye_moves ? Eye::Moves::yes : Eye::Moves::no);
  SceneOfRecords records(given, eye);
  TextureTables& textures = records.textures;
  const PreparedScene& prepared = records.prepared;
  const Scene& scene = prepared.scene();
  BuildWatch::reach(0.05);
  const InstancedMeshes instanced(scene, prepared.own_objects(), textures.object_flags, threads);
  const MeshInstances instances(scene, instanced, textures.object_flags, threads);
  BuildWatch::reach(0.2);
  const SceneObjects objects(scene, eye, prepared.own_objects(), textures.objects, textures.object_flags,
                             instanced, instances, threads);
  threads = threads_for(objects, instances, threads, objects_a_thread);
  const OrderMemory memory(work, objects.count());
  touch(work, work.size(), threads);
  const ObjectCensus loose = place_all(objects, memory.objects, threads);
  BuildWatch::reach(0.4);
  std::vector<std::uint32_t> groups;
  if (loose.objects != 0 && (loose.objects >= kMinObjectsToOrder || instances.group_count() != 0))
    groups = order_along_curve(memory.objects, memory.spare, memory.cells, loose.objects, threads);
  ObjectCensus census = loose;
  census.add(instances.census());
  const LightSets light_sets(scene);
  const ImageHeader header = make_header(scene, light_sets, textures, objects, census, groups, instanced,
                                         instances, has_near_surfaces(given, textures.object_flags));

  BuildWatch::reach(0.6);
  const std::size_t bytes = header.bytes + bvh_bytes(header);
  if (remembered.most_bytes != 0 && bytes > remembered.most_bytes)
    throw InputError("the scene takes " + std::to_string(bytes) + " bytes with its BVH, and " +
                     std::to_string(remembered.most_bytes) + " are allowed");
  block_.reserve(bytes);
  origin_.reset();
  touch(block_, header.bytes, threads);
  TableWriter writer(block_.data(), header, scene, textures,
                     objects.unbounded_extras() + instanced.extra_count());
  writer.write_header();
  writer.write_lights(light_sets, objects.projector_sizes());
  writer.write_surfaces(textures);
  writer.write_csg(objects.csg());
  writer.write_polygons(objects.polygons());
  writer.write_instanced(instanced);
  writer.write_objects(objects, {memory.objects, loose.objects}, memory.cells, threads);
  BuildWatch::reach(0.9);
  writer.write_groups(groups, threads);
  writer.write_instances(instances, threads);
  writer.write_unbounded(objects, census);
  writer.write_bounds(loose.around);
  eye_ = std::move(eye);
  owners_.clear();
  if (remembered.owners) owners_ = owners_of(objects, {memory.objects, loose.objects}, instances);
  if (!remembered.updatable) return;

  origin_ = std::make_unique<Origin>();
  Origin& origin = *origin_;
  origin.places.resize(objects.count(), SceneObjects::kNoPlace);
  for (std::uint32_t i = 0; i < loose.objects; ++i) {
    BuildWatch::look_at(i);
    origin.places[memory.objects[i].source] = i;
  }
  origin.placed = loose.objects;
  origin.groups = std::move(groups);
  origin.forms = forms_of(instanced, instances, given.objects.size());
  origin.order = objects.order();
  origin.own_interiors = header.interior_count - scene.interiors.size();
  origin.material_flags = std::move(textures.object_flags);
  origin.surfaces_are_apart = textures.objects.empty() && !has_projectors(given);
}

bool SceneImage::update_surfaces(const Scene& scene) {
  if (!origin_ || !origin_->surfaces_are_apart || has_projectors(scene)) return false;
  validate_all_but_objects(scene);
  TextureTables textures(scene);
  if (!textures.objects.empty() || textures.object_flags != origin_->material_flags) return false;
  const LightSets light_sets(scene);
  const ImageHeader updated = with_surfaces(header(), scene, origin_->own_interiors, light_sets, textures);
  if (!have_same_layout(header(), updated)) return false;

  std::memcpy(block_.data(), &updated, sizeof updated);
  TableWriter writer(block_.data(), updated, scene, textures, 0);
  writer.write_lights(light_sets, {});
  writer.write_surfaces(textures);
  return true;
}

bool SceneImage::update(const Scene& given, AlignedBlock& work, unsigned threads,
                        std::uint32_t objects_a_thread) {
  if (!origin_ || given.objects.size() != origin_->forms.size()) return false;
  validate(given);
  Eye eye(given.camera, given, eye_.may_move() ? Eye::Moves::yes : Eye::Moves::no);
  SceneOfRecords records(given, eye);
  TextureTables& textures = records.textures;
  const PreparedScene& prepared = records.prepared;
  const Scene& scene = prepared.scene();
  const InstancedMeshes instanced(scene, prepared.own_objects(), textures.object_flags, threads);
  const MeshInstances instances(scene, instanced, textures.object_flags, threads);
  if (forms_of(instanced, instances, given.objects.size()) != origin_->forms) return false;
  const SceneObjects objects(scene, eye, prepared.own_objects(), textures.objects, textures.object_flags,
                             instanced, instances, threads);
  if (objects.count() != origin_->places.size() || objects.order() != origin_->order) return false;
  threads = threads_for(objects, instances, threads, objects_a_thread);
  // Plain triangles are written as they are counted: should there turn out to be others than before, they all
  // are written again. Of the rest an error may be found, which has to leave the image as it was.
  const bool at_once =
      header().extra_count == 0 && header().blend_count == 0 && objects.are_plain_triangles();
  std::optional<ObjectCensus> loose;
  if (at_once) {
    loose.emplace().objects = origin_->placed;
  } else {
    loose = count_in_parts(objects.count(), threads, [&](std::uint32_t begin, std::uint32_t end) {
      return objects.count_placed(begin, end, origin_->places);
    });
    if (!loose || loose->objects != origin_->placed) return false;
  }
  ObjectCensus census = *loose;
  census.add(instances.census());
  const LightSets light_sets(scene);
  const ImageHeader updated =
      make_header(scene, light_sets, textures, objects, census, origin_->groups, instanced, instances,
                  has_near_surfaces(given, textures.object_flags));
  if (!have_same_layout(header(), updated)) return false;
  std::optional<OrderMemory> order; // records in other tables lie as objects do
  if (updated.extra_count != 0 || updated.blend_count != 0) {
    order.emplace(work, objects.count());
    for (std::uint32_t i = 0; i < objects.count(); ++i) {
      BuildWatch::look_at(i);
      if (const std::uint32_t place = origin_->places[i]; place != SceneObjects::kNoPlace)
        order->objects[place].source = i;
    }
  }

  TableWriter writer(block_.data(), updated, scene, textures,
                     objects.unbounded_extras() + instanced.extra_count());
  if (at_once) {
    loose = count_in_parts(objects.count(), threads, [&](std::uint32_t begin, std::uint32_t end) {
      return writer.send_placed(objects, origin_->places, begin, end);
    });
    if (!loose || loose->objects != origin_->placed || loose->extras != 0 || loose->blended != 0) {
      origin_.reset();
      return false;
    }
  }
  writer.write_header();
  writer.write_lights(light_sets, objects.projector_sizes());
  writer.write_surfaces(textures);
  writer.write_csg(objects.csg());
  writer.write_polygons(objects.polygons());
  writer.write_instanced(instanced);
  if (order)
    writer.write_objects(objects, {order->objects, loose->objects}, order->cells, threads);
  else if (!at_once)
    writer.send_objects(objects, origin_->places, threads);
  // Where there are no instances, only what builds a BVH reads groups.
  if (updated.prototype_count != 0) writer.write_groups(origin_->groups, threads);
  writer.write_instances(instances, threads);
  writer.write_unbounded(objects, census);
  writer.write_bounds(loose->around);
  eye_ = std::move(eye);
  origin_->material_flags = std::move(textures.object_flags);
  origin_->surfaces_are_apart = textures.objects.empty() && !has_projectors(given);
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
