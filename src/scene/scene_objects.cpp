#include "scene/scene_objects.hpp"

#include "celltrace/error.hpp"
#include "celltrace/spe/simd_host.hpp"
#include "kernel/direct/build_bvh_bounds.hpp"
#include "scene/parallel.hpp"
#include "scene/triangles.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

using Simd = HostSimd<xsimd::sse2>;
using LaneAabb = bvh::LaneAabb<Simd>;

constexpr std::uint32_t kVerticesPerThread = 16384;
/// Objects whose records are on their way while one is written, for they lie anywhere.
constexpr std::uint32_t kAhead = 16;

void copy(const Vec3& from, float* to) {
  for (int i = 0; i < 3; ++i)
    to[i] = static_cast<float>(from[i]);
}

/// The factor by which a transformation scales everything, or 0 if it does not scale all directions alike.
double uniform_scale(const Transform& t) {
  const double x = glm::length(t.rows[0]);
  const double y = glm::length(t.rows[1]);
  const double z = glm::length(t.rows[2]);
  const double tolerance = 1e-9 * x * x;
  const bool round = std::abs(x - y) <= 1e-9 * x && std::abs(x - z) <= 1e-9 * x &&
                     std::abs(glm::dot(t.rows[0], t.rows[1])) <= tolerance &&
                     std::abs(glm::dot(t.rows[0], t.rows[2])) <= tolerance &&
                     std::abs(glm::dot(t.rows[1], t.rows[2])) <= tolerance;
  return round ? x : 0;
}

/// Kind and geometry of a sphere in the world. Spheres that a transformation leaves round stay spheres.
ObjectKind place_sphere(const Object& object, const Sphere& sphere, float (&geometry)[12]) {
  const double radius = std::abs(sphere.radius);
  const double scale = object.transform.is_identity() ? 1 : uniform_scale(object.transform);
  if (scale > 0) {
    copy(object.transform.point(sphere.centre), geometry);
    geometry[3] = static_cast<float>(radius * scale);
    return ObjectKind::sphere;
  }
  const Transform inverse = object.transform.inverse();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      const double value = inverse.rows[column][row] - (column == 3 ? sphere.centre[row] : 0);
      geometry[row * 4 + column] = static_cast<float>(value / radius);
    }
  return ObjectKind::ellipsoid;
}

PlacedObject placed(const Box& box, std::uint32_t source) {
  return {{box.min[0] + box.max[0], box.min[1] + box.max[1], box.min[2] + box.max[2]}, source};
}

Simd::F4 lanes_of(const Vec3f& vertex) {
  return four<Simd>(vertex.x, vertex.y, vertex.z, 0.0f);
}

Box box_of(const LaneAabb& lanes) {
  bvh::Reference around;
  lanes.min.store(around.min); // over the words beside
  lanes.max.store(around.max);
  return {{around.min[0], around.min[1], around.min[2]}, {around.max[0], around.max[1], around.max[2]}};
}

/// Whether check_size() surely accepts it.
bool has_size(const LaneAabb& box) {
  constexpr float kSmall = 0.99e18f;
  return (not_above_bits(Simd::F4::splat(-kSmall), box.min) &
          not_above_bits(box.max, Simd::F4::splat(kSmall)) & 7) == 7;
}

/// In parts of a reasonable size.
template <class Change>
std::vector<Vec3f> changed(const std::vector<Vec3f>& from, unsigned threads, Change change) {
  std::vector<Vec3f> to(from.size());
  const auto count = static_cast<std::uint32_t>(from.size());
  const unsigned parts = std::clamp(count / kVerticesPerThread, 1u, threads);
  for_each_part(parts, [&](unsigned part) {
    const HostPart mine(count, part, parts);
    for (std::uint32_t i = mine.begin; i < mine.end; ++i)
      to[i] = change(from[i]);
  });
  return to;
}

} // namespace

SceneObjects::SceneObjects(const Scene& scene, const MeshInstances& instances, unsigned threads) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (instances.contains(i)) continue;
    if (std::holds_alternative<Sphere>(object.shape))
      add_sphere(object);
    else
      add_mesh(object, *std::get<std::shared_ptr<const Mesh>>(object.shape), threads);
  }
}

void SceneObjects::grow(std::size_t objects) {
  // Beyond that the image would be too large, whatever can be hit.
  if (objects > std::numeric_limits<std::uint32_t>::max() - count_)
    throw InputError("the scene is too large: it has more objects than 32 bits can count");
  count_ += static_cast<std::uint32_t>(objects);
}

void SceneObjects::add_sphere(const Object& object) {
  const auto goes_on = [&](const Piece& piece) {
    return piece.mesh == nullptr && &object == piece.object + (count_ - piece.first);
  };
  if (pieces_.empty() || !goes_on(pieces_.back())) pieces_.push_back({count_, &object, nullptr, {}, {}});
  grow(1);
}

void SceneObjects::add_mesh(const Object& object, const Mesh& mesh, unsigned threads) {
  if (mesh.triangles.empty()) return;
  Piece piece = {count_, &object, &mesh, mesh.vertices, mesh.normals};
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

std::uint32_t SceneObjects::end_of(const Piece& piece) const {
  return &piece == &pieces_.back() ? count_ : (&piece + 1)->first;
}

const SceneObjects::Piece& SceneObjects::piece_of(std::uint32_t number, const Piece* near) const {
  if (near != nullptr && number >= near->first && number < end_of(*near)) return *near;
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), number,
                                      [](std::uint32_t n, const Piece& piece) { return n < piece.first; });
  return after[-1];
}

bool SceneObjects::is_blended(const Piece& piece, const Mesh::Triangle& triangle) const {
  if (same(triangle.material)) return false;
  const Index own = piece.object->material;
  const auto material = [own](Index index) { return index != kNoIndex ? index : own; };
  return material(triangle.material[0]) != material(triangle.material[1]) ||
         material(triangle.material[0]) != material(triangle.material[2]);
}

ObjectCensus SceneObjects::place(std::uint32_t begin, std::uint32_t end, PlacedObject* to) const {
  ObjectCensus census;
  while (begin < end) {
    const Piece& piece = piece_of(begin, nullptr);
    const std::uint32_t piece_end = std::min(end, end_of(piece));
    if (piece.mesh != nullptr)
      place_triangles(piece, begin, piece_end, census, to);
    else
      place_spheres(piece, begin, piece_end, census, to);
    begin = piece_end;
  }
  return census;
}

void SceneObjects::place_spheres(const Piece& piece, std::uint32_t begin, std::uint32_t end,
                                 ObjectCensus& census, PlacedObject* to) const {
  for (std::uint32_t number = begin; number < end; ++number) {
    const Object& object = piece.object[number - piece.first];
    const Sphere& sphere = std::get<Sphere>(object.shape);
    if (sphere.radius == 0) continue;
    ObjectRecord record;
    record.kind_and_flags = static_cast<std::uint32_t>(place_sphere(object, sphere, record.geometry));
    const Box box = bounding_box(record);
    check_size(box);
    census.around = box_around(census.around, box);
    to[census.objects++] = placed(box, number);
  }
}

void SceneObjects::place_triangles(const Piece& piece, std::uint32_t begin, std::uint32_t end,
                                   ObjectCensus& census, PlacedObject* to) const {
  const Mesh& mesh = *piece.mesh;
  LaneAabb around = LaneAabb::empty();
  PlacedObject* next = to + census.objects;
  for (std::uint32_t number = begin; number < end; ++number) {
    const Mesh::Triangle& triangle = mesh.triangles[number - piece.first];
    const Vec3f &a = piece.vertices[triangle.vertex[0]], &b = piece.vertices[triangle.vertex[1]],
                &c = piece.vertices[triangle.vertex[2]];
    if (!has_area(a, b, c)) continue;
    census.smooth += is_smooth(triangle);
    census.blended += is_blended(piece, triangle);
    LaneAabb box = {lanes_of(a), lanes_of(a)};
    box.grow(lanes_of(b));
    box.grow(lanes_of(c));
    if (!has_size(box)) check_size(box_of(box));
    around.grow(box);
    box.centre().store(next->centre); // over the word behind
    next++->source = number;
  }
  census.objects = static_cast<std::uint32_t>(next - to);
  census.around = box_around(census.around, box_of(around));
}

ObjectCensus SceneObjects::count_tables(std::span<const PlacedObject> objects) const {
  ObjectCensus census;
  const Piece* near = nullptr;
  for (const PlacedObject& object : objects) {
    const Piece& piece = piece_of(object.source, near);
    near = &piece;
    if (piece.mesh == nullptr) continue;
    const Mesh::Triangle& triangle = piece.mesh->triangles[object.source - piece.first];
    census.smooth += is_smooth(triangle);
    census.blended += is_blended(piece, triangle);
  }
  return census;
}

class SceneObjects::Writer {
public:
  Writer(const SceneObjects& objects, const RecordTables& tables, const ObjectCensus& before)
      : objects_(objects), tables_(tables), smooth_(before.smooth), blended_(before.blended) {}

  ObjectRecord sphere(const Object& object) const {
    ObjectRecord r = start_record(object, ObjectKind::sphere, tables_.interior_offset);
    r.kind_and_flags |=
        static_cast<std::uint32_t>(place_sphere(object, std::get<Sphere>(object.shape), r.geometry));
    tables_.set_material(r, object.material);
    return r;
  }

  void triangle(const Piece& piece, const Mesh::Triangle& triangle, ObjectRecord& r) {
    if (piece.object != object_ || triangle.material[0] != material_)
      start(*piece.object, triangle.material[0]);
    r = head_;
    for (int v = 0; v < 3; ++v)
      std::memcpy(r.geometry + 3 * v, &piece.vertices[triangle.vertex[v]], sizeof(Vec3f));
    if (objects_.is_blended(piece, triangle)) blend(r, *piece.object, triangle);
    if (is_smooth(triangle)) {
      r.kind_and_flags |= object_flag::smooth;
      r.normals = tables_.offset_of_normals(smooth_);
      NormalsRecord record{};
      for (int v = 0; v < 3; ++v)
        for (int i = 0; i < 3; ++i)
          record.normal[v * 3 + i] = piece.normals[triangle.normal[v]][i];
      tables_.normals[smooth_++] = record;
    }
  }

private:
  /// What triangles of one material have in common.
  void start(const Object& object, Index material) {
    object_ = &object;
    material_ = material;
    head_ = start_record(object, ObjectKind::triangle, tables_.interior_offset);
    tables_.set_material(head_, material != kNoIndex ? material : object.material);
  }

  void blend(ObjectRecord& r, const Object& object, const Mesh::Triangle& triangle) {
    BlendRecord record{};
    bool opaque = true;
    for (int i = 0; i < 3; ++i) {
      const Index material = triangle.material[i] != kNoIndex ? triangle.material[i] : object.material;
      record.material[i] = tables_.offset_of_material(material);
      opaque = opaque && tables_.opaque[material];
    }
    r.kind_and_flags &= ~object_flag::opaque;
    r.kind_and_flags |= object_flag::blended | (opaque ? object_flag::opaque : 0);
    r.material = tables_.blend_offset + blended_ * static_cast<std::uint32_t>(sizeof(BlendRecord));
    tables_.blends[blended_++] = record;
  }

  const SceneObjects& objects_;
  const RecordTables& tables_;
  std::uint32_t smooth_, blended_;
  const Object* object_ = nullptr;
  Index material_ = kNoIndex;
  ObjectRecord head_;
};

void SceneObjects::write(std::span<const PlacedObject> objects, const RecordTables& tables,
                         const ObjectCensus& before, ObjectRecord* to) const {
  Writer writer(*this, tables, before);
  const Piece* near = nullptr;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Piece& piece = piece_of(objects[i].source, near);
    near = &piece;
    const std::uint32_t number = objects[i].source - piece.first;
    if (piece.mesh == nullptr) {
      to[i] = writer.sphere(piece.object[number]);
      continue;
    }
    writer.triangle(piece, piece.mesh->triangles[number], to[i]);
  }
}

void SceneObjects::write_apart(std::uint32_t begin, std::uint32_t end, const std::uint32_t* places,
                               const RecordTables& tables, ObjectRecord* to) const {
  Writer writer(*this, tables, {});
  while (begin < end) {
    const Piece& piece = piece_of(begin, nullptr);
    const std::uint32_t piece_end = std::min(end, end_of(piece));
    for (std::uint32_t number = begin; number < piece_end; ++number) {
      if (piece_end - number > kAhead && places[number + kAhead] != kNoPlace)
        __builtin_prefetch(to + places[number + kAhead], 1);
      if (places[number] == kNoPlace) continue;
      ObjectRecord& record = to[places[number]];
      if (piece.mesh != nullptr)
        writer.triangle(piece, piece.mesh->triangles[number - piece.first], record);
      else
        record = writer.sphere(piece.object[number - piece.first]);
    }
    begin = piece_end;
  }
}

} // namespace celltrace
