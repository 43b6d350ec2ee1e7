#include "scene_image/image_parts.hpp"

#include "prepare/projectors.hpp"
#include "scene/progress_monitor.hpp"
#include "scene_image/image_layout.hpp"
#include "scene_image/near_surfaces.hpp"

#include <algorithm>
#include <utility>

namespace celltrace {

using namespace kernel;

namespace {

/// Reports progress and returns the scene, so that initialisers can report progress before they build a part.
const Scene& reached(double fraction, const Scene& scene) {
  ProgressMonitor::report(fraction);
  return scene;
}

} // namespace

ImageParts::ImageParts(const Scene& scene_given, Eye scene_eye, unsigned threads)
    : given(scene_given), eye(std::move(scene_eye)), with_projectors(add_projectors(given, {eye, {}})),
      surfaces(with_projectors ? *with_projectors : given),
      prepared(given, {eye, surfaces.textures.object_flags, &limits}),
      instanced(reached(0.05, scene()), prepared.own_objects(), surfaces.textures.object_flags, threads),
      instances(scene(), instanced, surfaces.textures.object_flags, threads),
      objects(reached(0.2, scene()), eye, prepared.own_objects(), surfaces.textures.objects,
              surfaces.textures.object_flags, instanced, instances, threads, limits) {
}

unsigned ImageParts::threads_for(std::uint32_t objects_a_thread, unsigned threads) const {
  const std::uint64_t all = std::uint64_t{objects.count()} + instances.counts().objects;
  return static_cast<unsigned>(std::clamp<std::uint64_t>(all / objects_a_thread, 1, threads));
}

std::vector<ObjectForm> ImageParts::forms() const {
  std::vector<ObjectForm> forms(given.objects.size());
  for (std::size_t i = 0; i < forms.size(); ++i)
    forms[i] = instanced.contains(i)   ? ObjectForm::instance
               : instances.contains(i) ? ObjectForm::copy
                                       : ObjectForm::itself;
  return forms;
}

std::vector<Index> ImageParts::owners(std::span<const PlacedObject> in_order) const {
  std::vector<Index> owners = objects.unbounded_owners();
  const std::vector<Index> loose = objects.owners();
  owners.reserve(owners.size() + in_order.size() + instances.counts().objects);
  for (const PlacedObject& object : in_order)
    owners.push_back(loose[object.source]);
  instances.append_owners(owners);
  return owners;
}

ImageHeader ImageParts::header(const ObjectPlaces& places) const {
  ObjectCounts counts = places.counts;
  counts.add(instances.counts());
  return make_header(scene(), surfaces.light_sets, surfaces.textures, objects, counts, places.groups,
                     instanced, instances, has_near_surfaces(given, surfaces.textures.object_flags));
}

void ImageParts::write(std::byte* base, const ImageHeader& header, const ObjectPlaces& places,
                       unsigned threads) {
  TableWriter writer = this->writer(base, header);
  writer.write_header();
  surfaces.write(writer, objects.projector_sizes());
  writer.write_csg(objects.csg());
  writer.write_shape_data(objects.shape_data());
  writer.write_instanced(instanced);
  if (places.in_order)
    writer.write_objects(objects, *places.in_order, places.cells, threads);
  else if (!places.are_written)
    writer.send_objects(objects, places.by_object, threads);
  ProgressMonitor::report(0.9);
  // Where objects keep their places, no new BVH is built, so that groups are needed only for copies of
  // meshes.
  if (!places.are_known || header.prototype_count != 0) writer.write_groups(places.groups, threads);
  writer.write_instances(instances, threads);
  ObjectCounts counts = places.counts;
  counts.add(instances.counts());
  writer.write_unbounded(objects, counts);
  writer.write_bounds(places.counts.around);
}

} // namespace celltrace
