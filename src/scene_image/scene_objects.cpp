#include "scene_image/scene_objects.hpp"

#include "celltrace/error.hpp"
#include "geometry/polygons.hpp"
#include "geometry/triangles.hpp"
#include "scene/parallel.hpp"
#include "scene/progress_monitor.hpp"
#include "scene_image/coincident_surfaces.hpp"

#include <algorithm>
#include <limits>

namespace celltrace {

using namespace kernel;

namespace {

constexpr std::uint32_t kVerticesPerThread = 16384;

/// Compares CSG parts by the object that they belong to; parts are sorted by object.
struct ComparesWholes {
  bool operator()(const CsgPart& part, std::size_t whole) const { return part.whole < whole; }
  bool operator()(std::size_t whole, const CsgPart& part) const { return whole < part.whole; }
};

/// Returns the results of `change` for vectors, which threads compute in parts of a reasonable size.
template <class Change>
std::vector<Vec3f> changed(const std::vector<Vec3f>& from, unsigned threads, Change change) {
  std::vector<Vec3f> to(from.size());
  const auto count = static_cast<std::uint32_t>(from.size());
  const unsigned parts = std::clamp(count / kVerticesPerThread, 1u, threads);
  for_each_part(parts, [&](unsigned part) {
    const HostPart mine(count, part, parts);
    for (std::uint32_t i = mine.begin; i < mine.end; ++i) {
      ProgressMonitor::check_cancelled(i);
      to[i] = change(from[i]);
    }
  });
  return to;
}

} // namespace

SceneObjects::SceneObjects(const Scene& scene, const Eye& eye, std::size_t projectors,
                           const std::vector<std::shared_ptr<const Object>>& patterns,
                           const std::vector<std::uint32_t>& material_flags, const InstancedMeshes& instanced,
                           const MeshInstances& instances, unsigned threads, PassedLimits& limits)
    : scene_(scene), material_flags_(material_flags), instanced_(instanced),
      csg_(scene, eye, patterns, projectors, material_flags) {
  order_ = order_of_tests(scene, eye, projectors, csg_, limits);
  for (const std::size_t i : order_) {
    ProgressMonitor::check_cancelled(i);
    const Object& object = scene.objects[i];
    if (CsgParts::contains(object)) {
      add_parts(i, threads);
      continue;
    }
    are_all_seen_ = are_all_seen_ && !object.no_image;
    if (instances.contains(i)) continue;
    const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape);
    if (mesh != nullptr && !instanced.contains(i))
      add_mesh(object, **mesh, nullptr, threads);
    else if (!add_as_triangles(object))
      add_shape(object);
  }
  if (!has_order_of_tests(projectors, csg_)) order_.clear();
  add_projectors(scene, projectors);
}

void SceneObjects::grow(std::size_t objects) {
  // Rejects the scene, since the image would be too large even if some objects could not be hit.
  if (objects > std::numeric_limits<std::uint32_t>::max() - count_)
    throw InputError("the scene is too large: it has more objects than 32 bits can count");
  count_ += static_cast<std::uint32_t>(objects);
}

/// Replaces a polygon by triangles, which are several times faster to test: the triangles of a leaf are
/// tested together. Polygons that let light through or look different from inside stay, because this comes
/// from the polygon as a whole.
bool SceneObjects::add_as_triangles(const Object& object) {
  const auto* polygon = std::get_if<std::shared_ptr<const Polygon>>(&object.shape);
  if (polygon == nullptr || !is_plain(material_flags_[object.material])) return false;
  Mesh mesh = triangles_of(**polygon, object.transform);
  if (mesh.triangles.empty()) return false;
  const Mesh& kept = triangulated_.emplace_back(std::move(mesh));
  pieces_.push_back({count_, &object, &kept, kept.vertices, {}});
  grow(kept.triangles.size());
  return true;
}

void SceneObjects::add_shape(const Object& object) {
  csg_.shape_data.add(object);
  if (!has_bounds(object)) {
    unbounded_.push_back({&object, nullptr});
    return;
  }
  const auto goes_on = [&](const Piece& piece) {
    return piece.mesh == nullptr && piece.part == nullptr && &object == piece.object + (count_ - piece.first);
  };
  if (pieces_.empty() || !goes_on(pieces_.back())) pieces_.push_back({count_, &object, nullptr, {}, {}});
  grow(1);
}

void SceneObjects::add_projectors(const Scene& scene, std::size_t first) {
  for (std::size_t i = first; i < scene.objects.size(); ++i) {
    const std::size_t before = projectors_.size();
    csg_.shape_data.add(scene.objects[i]);
    if (!CsgParts::contains(scene.objects[i])) {
      if (!place_shape(scene.objects[i]).is_empty) projectors_.push_back({&scene.objects[i], nullptr});
    } else {
      for (const CsgPart& part : csg_.parts)
        if (part.whole == i) projectors_.push_back({&part.object, &part});
    }
    projector_sizes_.push_back(static_cast<std::uint32_t>(projectors_.size() - before));
  }
}

void SceneObjects::add_parts(std::size_t whole, unsigned threads) {
  csg_.shape_data.add(scene_.objects[whole]);
  const auto parts = std::equal_range(csg_.parts.begin(), csg_.parts.end(), whole, ComparesWholes());
  for (auto part = parts.first; part != parts.second; ++part) {
    are_all_seen_ = are_all_seen_ && !part->object.no_image;
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&part->object.shape)) {
      add_mesh(part->object, **mesh, &*part, threads);
      continue;
    }
    if (!part->is_bounded) {
      unbounded_.push_back({&part->object, &*part});
      continue;
    }
    const auto goes_on = [&](const Piece& piece) {
      return piece.mesh == nullptr && piece.part != nullptr && &*part == piece.part + (count_ - piece.first);
    };
    if (pieces_.empty() || !goes_on(pieces_.back()))
      pieces_.push_back({count_, nullptr, nullptr, {}, {}, &*part});
    grow(1);
  }
}

void SceneObjects::add_mesh(const Object& object, const Mesh& mesh, const CsgPart* part, unsigned threads) {
  if (mesh.triangles.empty()) return;
  Piece piece = {count_, &object, &mesh, mesh.vertices, mesh.normals, part};
  if (!object.transform.is_identity()) {
    transformed_.push_back(changed(mesh.vertices, threads, [&](const Vec3f& vertex) {
      return Vec3f(object.transform.point(Vec3(vertex)));
    }));
    piece.vertices = transformed_.back();
  }
  if (!mesh.normals.empty()) {
    const NormalTransform to_world(object.transform);
    transformed_.push_back(
        changed(mesh.normals, threads, [&](const Vec3f& normal) { return to_world(unit_normal(normal)); }));
    piece.normals = transformed_.back();
  }
  pieces_.push_back(piece);
  grow(mesh.triangles.size());
}

std::vector<Index> SceneObjects::owners() const {
  std::vector<Index> owners;
  owners.reserve(count_);
  for (const Piece& piece : pieces_)
    for (std::uint32_t number = piece.first; number < end_of(piece); ++number)
      owners.push_back(
          owner_of(piece.mesh != nullptr ? Placed{piece.object, piece.part} : placed_at(piece, number)));
  return owners;
}

std::vector<Index> SceneObjects::unbounded_owners() const {
  std::vector<Index> owners;
  for (const Placed& object : unbounded_)
    owners.push_back(owner_of(object));
  return owners;
}

std::uint32_t SceneObjects::unbounded_extras() const {
  const auto extras = [this](const std::vector<Placed>& objects) {
    return static_cast<std::uint32_t>(std::count_if(
        objects.begin(), objects.end(), [this](const Placed& placed) { return has_extra(placed); }));
  };
  return extras(projectors_) + extras(unbounded_);
}

} // namespace celltrace
