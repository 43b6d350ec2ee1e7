// Counts the objects of a scene, places them and writes their records.
#include "celltrace/spe/simd_host.hpp"
#include "geometry/triangles.hpp"
#include "kernel/direct/build_bvh_bounds.hpp"
#include "scene/progress_monitor.hpp"
#include "scene_image/scene_objects.hpp"

#include <algorithm>
#include <cstring>

namespace celltrace {

using namespace kernel;

namespace {

using Simd = HostSimd<BaselineArch>;
using LaneAabb = bvh::LaneAabb<Simd>;

/// Number of objects by which prefetching is ahead of writing, since objects lie scattered in memory.
constexpr std::uint32_t kAhead = 16;

Simd::F4 lanes_of(const Vec3f& vertex) {
  return four<Simd>(vertex.x, vertex.y, vertex.z, 0.0f);
}

LaneAabb lanes_of(const Aabb& box) {
  return {four<Simd>(box.min[0], box.min[1], box.min[2], 0.0f),
          four<Simd>(box.max[0], box.max[1], box.max[2], 0.0f)};
}

Aabb box_of(const LaneAabb& lanes) {
  bvh::Reference around;
  lanes.min.store(around.min); // also writes the neighbouring words
  lanes.max.store(around.max);
  return {{around.min[0], around.min[1], around.min[2]}, {around.max[0], around.max[1], around.max[2]}};
}

LaneAabb box_around(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  LaneAabb box = {lanes_of(a), lanes_of(a)};
  box.grow(lanes_of(b));
  box.grow(lanes_of(c));
  return box;
}

/// Intersects a box with `bounds`; returns false if the intersection is empty.
bool limit(LaneAabb& box, const Aabb& bounds) {
  const LaneAabb within = lanes_of(bounds);
  box.min = Simd::max(box.min, within.min);
  box.max = Simd::min(box.max, within.max);
  return (not_above_bits(box.min, box.max) & 7) == 7;
}

/// Returns whether check_size() certainly accepts a box.
bool has_size(const LaneAabb& box) {
  constexpr float kSmall = 0.99e18f;
  return (not_above_bits(Simd::F4::splat(-kSmall), box.min) &
          not_above_bits(box.max, Simd::F4::splat(kSmall)) & 7) == 7;
}

} // namespace

SceneObjects::Placed SceneObjects::placed_at(const Piece& piece, std::uint32_t number) {
  if (piece.part == nullptr) return {piece.object + (number - piece.first), nullptr};
  const CsgPart* part = piece.part + (number - piece.first);
  return {&part->object, part};
}

Index SceneObjects::owner_of(const Piece& piece) const {
  return owner_of({piece.object, piece.part});
}

Index SceneObjects::owner_of(const Placed& placed) const {
  if (placed.part != nullptr) return static_cast<Index>(placed.part->whole);
  return static_cast<Index>(placed.object - scene_.objects.data());
}

bool SceneObjects::has_extra(const Placed& placed) const {
  if (placed.part == nullptr)
    return instanced_.find(*placed.object) != nullptr || place_shape(*placed.object).has_parameters;
  return placed.part->is_limited() || placed.part->shape.has_parameters;
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

/// Returns whether a triangle's record has surface coordinates.
bool SceneObjects::is_mapped(const Piece& piece, const Mesh::Triangle& triangle) const {
  if (piece.mesh->coordinates.empty()) return false;
  return std::any_of(std::begin(triangle.material), std::end(triangle.material), [&](Index index) {
    return (material_flags_[index == kNoIndex ? piece.object->material : index] & object_flag::by_surface) !=
           0;
  });
}

ObjectCounts SceneObjects::place(std::uint32_t begin, std::uint32_t end, PlacedObject* to) const {
  return visit_boxes(begin, end, [&](std::uint32_t number, const LaneAabb& box) {
    box.centre().store(to->centre); // also writes the word after it
    to++->source = number;
  });
}

std::optional<ObjectCounts> SceneObjects::count_placed(std::uint32_t begin, std::uint32_t end,
                                                       std::span<const std::uint32_t> places) const {
  bool have_places = true;
  const ObjectCounts counts = visit_boxes(
      begin, end, [&](std::uint32_t number, const LaneAabb&) { have_places &= places[number] != kNoPlace; });
  return have_places ? std::optional(counts) : std::nullopt;
}

template <class Visit>
ObjectCounts SceneObjects::visit_boxes(std::uint32_t begin, std::uint32_t end, Visit visit) const {
  ObjectCounts counts;
  while (begin < end) {
    const Piece& piece = piece_of(begin, nullptr);
    const std::uint32_t piece_end = std::min(end, end_of(piece));
    if (piece.mesh != nullptr)
      visit_triangles(piece, begin, piece_end, counts, visit);
    else
      visit_shapes(piece, begin, piece_end, counts, visit);
    begin = piece_end;
  }
  return counts;
}

template <class Visit>
void SceneObjects::visit_shapes(const Piece& piece, std::uint32_t begin, std::uint32_t end,
                                ObjectCounts& counts, Visit visit) const {
  for (std::uint32_t number = begin; number < end; ++number) {
    ProgressMonitor::check_cancelled(number);
    const Placed object = placed_at(piece, number);
    Aabb box;
    if (object.part != nullptr) {
      box = object.part->bounds;
      counts.extras += has_extra(object);
    } else if (const auto* instance = instanced_.find(*object.object)) {
      box = instance->box;
      ++counts.extras;
    } else {
      const PlacedShape shape = place_shape(*object.object);
      if (shape.is_empty) continue;
      box = shape.bounds();
      counts.extras += shape.has_parameters;
    }
    check_size(box, owner_of(object));
    counts.around = united(counts.around, box);
    ++counts.objects;
    visit(number, lanes_of(box));
  }
}

template <class Visit>
void SceneObjects::visit_triangles(const Piece& piece, std::uint32_t begin, std::uint32_t end,
                                   ObjectCounts& counts, Visit visit) const {
  const Mesh& mesh = *piece.mesh;
  const bool is_limited = piece.is_limited_mesh(), may_be_mapped = !mesh.coordinates.empty();
  LaneAabb around = LaneAabb::empty();
  for (std::uint32_t number = begin; number < end; ++number) {
    ProgressMonitor::check_cancelled(number);
    const Mesh::Triangle& triangle = mesh.triangles[number - piece.first];
    const Vec3f &a = piece.vertices[triangle.vertex[0]], &b = piece.vertices[triangle.vertex[1]],
                &c = piece.vertices[triangle.vertex[2]];
    if (!has_area(a, b, c)) continue;
    LaneAabb box = box_around(a, b, c);
    if (!has_size(box)) check_size(box_of(box), owner_of(piece));
    if (is_limited && !limit(box, piece.part->bounds)) continue;
    counts.extras += is_limited || is_smooth(triangle) || (may_be_mapped && is_mapped(piece, triangle));
    counts.blended += is_blended(piece, triangle);
    around.grow(box);
    ++counts.objects;
    visit(number, box);
  }
  counts.around = united(counts.around, box_of(around));
}

ObjectCounts SceneObjects::count_tables(std::span<const PlacedObject> objects) const {
  ObjectCounts counts;
  const Piece* near = nullptr;
  for (const PlacedObject& object : objects) {
    ProgressMonitor::check_cancelled(static_cast<std::size_t>(&object - objects.data()));
    const Piece& piece = piece_of(object.source, near);
    near = &piece;
    if (piece.mesh == nullptr) {
      counts.extras += has_extra(placed_at(piece, object.source));
      continue;
    }
    const Mesh::Triangle& triangle = piece.mesh->triangles[object.source - piece.first];
    counts.extras += piece.is_limited_mesh() || is_smooth(triangle) || is_mapped(piece, triangle);
    counts.blended += is_blended(piece, triangle);
  }
  return counts;
}

class SceneObjects::Writer {
public:
  Writer(const SceneObjects& objects, const RecordTables& tables, const ObjectCounts& before)
      : objects_(objects), tables_(tables), extras_(before.extras), blended_(before.blended) {}

  ObjectRecord shape(const Placed& placed) {
    const Object& object = *placed.object;
    if (placed.part == nullptr)
      if (const auto* instance = objects_.instanced_.find(object)) return record_of(*instance);
    const PlacedShape shape = placed.part != nullptr ? placed.part->shape : place_shape(object);
    ObjectRecord r = record_of(placed, shape);
    if (object.is_hidden) hide(r, middle_of(placed, shape));
    return r;
  }

  void triangle(const Piece& piece, std::uint32_t number, ObjectRecord& r) {
    write_triangle(piece, number, r);
    if (piece.object->is_hidden) hide(r, piece.vertices[piece.mesh->triangles[number].vertex[0]]);
  }

  /// Writes the record of a triangle that has no record in another table.
  void lone_triangle(const Piece& piece, std::uint32_t number, ObjectRecord& r) {
    const Mesh::Triangle& triangle = piece.mesh->triangles[number];
    write_lone_triangle(piece, triangle, r);
    if (piece.object->is_hidden) hide(r, piece.vertices[triangle.vertex[0]]);
  }

private:
  /// Returns the record of a shape. This function and those below ignore is_hidden: their callers hide
  /// records.
  ObjectRecord record_of(const Placed& placed, const PlacedShape& shape) {
    const Object& object = *placed.object;
    ObjectRecord r = start_record(object, shape.kind_and_flags, tables_);
    std::copy(shape.geometry, shape.geometry + 12, r.geometry);
    tables_.set_material(r, object.material);
    const bool limited = placed.part != nullptr && placed.part->is_limited();
    if (!shape.has_parameters && !limited) return r;
    ExtraRecord extra{};
    std::copy(shape.parameters, shape.parameters + 2, extra.value);
    extra.csg = kNoOffset;
    if (kernel::Primitives::has_data(shape.kind_and_flags & object_flag::kind_mask))
      data_of(object).put_in(extra);
    if (limited) limit_by_csg(*placed.part, placed.part->bounds, r, extra);
    set_extra(r, extra);
    return r;
  }

  ObjectRecord record_of(const InstancedMeshes::Instance& instance) {
    const Object& object = *instance.object;
    ObjectRecord r = start_record(object, kInstanceKind | object_flag::opaque, tables_);
    write_map(object.transform.inverse(), r.geometry);
    r.material = tables_.offset_of_material(object.material);
    set_extra(r, objects_.instanced_.extra_of(instance, tables_.instance_offset));
    if (object.is_hidden) hide(r, middle_of(instance.box));
    return r;
  }

  void write_triangle(const Piece& piece, std::uint32_t number, ObjectRecord& r) {
    const Mesh::Triangle& triangle = piece.mesh->triangles[number];
    write_lone_triangle(piece, triangle, r);
    if (objects_.is_blended(piece, triangle)) blend(r, *piece.object, triangle);
    const bool smooth = is_smooth(triangle), limited = piece.is_limited_mesh();
    const bool mapped = objects_.is_mapped(piece, triangle);
    if (!smooth && !limited && !mapped) return;
    ExtraRecord record{};
    if (smooth) {
      r.kind_and_flags |= object_flag::smooth;
      RecordTables::change_sides(r, *piece.object); // back: the outside is where the triangle's normals point
      for (int v = 0; v < 3; ++v)
        for (int i = 0; i < 3; ++i)
          record.value[v * 3 + i] = piece.normals[triangle.normal[v]][i];
    }
    if (limited) {
      LaneAabb box = box_around(piece.vertices[triangle.vertex[0]], piece.vertices[triangle.vertex[1]],
                                piece.vertices[triangle.vertex[2]]);
      limit(box, piece.part->bounds);
      limit_by_csg(*piece.part, box_of(box), r, record);
    }
    if ((r.kind_and_flags & object_flag::by_surface) != 0)
      for (int v = 0; v < 3; ++v) {
        const Vec2f at = mapped ? piece.mesh->coordinates[number].corner[v] : Vec2f(0);
        record.bounds[v * 2] = at.x;
        record.bounds[v * 2 + 1] = at.y;
      }
    set_extra(r, record);
  }

  void write_lone_triangle(const Piece& piece, const Mesh::Triangle& triangle, ObjectRecord& r) {
    if (piece.object != object_ || triangle.material[0] != material_)
      start(*piece.object, triangle.material[0]);
    r = head_;
    for (int v = 0; v < 3; ++v)
      std::memcpy(r.geometry + 3 * v, &piece.vertices[triangle.vertex[v]], sizeof(Vec3f));
  }

  static Vec3f middle_of(const Placed& placed, const PlacedShape& shape) {
    const bool is_bounded = placed.part != nullptr ? placed.part->is_bounded : shape.is_bounded;
    if (!is_bounded) return Vec3f(0);
    return middle_of(placed.part != nullptr ? placed.part->bounds : shape.bounds());
  }
  static Vec3f middle_of(const Aabb& box) {
    return {0.5f * (box.min[0] + box.max[0]), 0.5f * (box.min[1] + box.max[1]),
            0.5f * (box.min[2] + box.max[2])};
  }

  ShapeData data_of(const Object& object) const {
    ShapeData data = objects_.shape_data().of(object);
    data.first = tables_.shape_data_offset + data.first * std::uint32_t{sizeof(ShapeDataRecord)};
    return data;
  }

  void limit_by_csg(const CsgPart& part, const Aabb& bounds, ObjectRecord& r, ExtraRecord& extra) const {
    r.kind_and_flags |= object_flag::csg;
    extra.csg = tables_.csg_offset + part.condition * static_cast<std::uint32_t>(sizeof(CsgRecord));
    std::copy(bounds.min, bounds.min + 3, extra.bounds);
    std::copy(bounds.max, bounds.max + 3, extra.bounds + 3);
  }

  void set_extra(ObjectRecord& r, const ExtraRecord& extra) {
    r.extra = tables_.offset_of_extra(extras_);
    tables_.extras[extras_++] = extra;
  }

  /// Sets head_ to the fields that all triangles of one material share.
  void start(const Object& object, Index material) {
    object_ = &object;
    material_ = material;
    head_ = start_record(object, static_cast<std::uint32_t>(ObjectKind::triangle), tables_);
    tables_.set_material(head_, material != kNoIndex ? material : object.material);
    RecordTables::change_sides(head_, object);
  }

  void blend(ObjectRecord& r, const Object& object, const Mesh::Triangle& triangle) {
    BlendRecord record{};
    std::uint32_t all = ~0u, any = 0;
    const auto material_of = [&](Index own) { return own != kNoIndex ? own : object.material; };
    const Index first = material_of(triangle.material[0]);
    for (int i = 0; i < 3; ++i) {
      const Index material = material_of(triangle.material[i]);
      record.material[i] = tables_.offset_of_material(material);
      all &= tables_.material_flags[material];
      any |= tables_.material_flags[material];
    }
    // The inside of the triangle looks as its first material says.
    if ((tables_.material_flags[first] & object_flag::two_sided) == 0) any &= ~object_flag::two_sided;
    r.kind_and_flags &= ~object_flag::opaque;
    r.kind_and_flags |= object_flag::blended | (all & object_flag::opaque) |
                        (any & ~(object_flag::opaque | material_word::flags_mask));
    r.material = (tables_.blend_offset + blended_ * static_cast<std::uint32_t>(sizeof(BlendRecord))) |
                 (any & material_word::flags_mask);
    tables_.blends[blended_++] = record;
  }

  const SceneObjects& objects_;
  const RecordTables& tables_;
  std::uint32_t extras_, blended_;
  const Object* object_ = nullptr;
  Index material_ = kNoIndex;
  ObjectRecord head_;
};

void SceneObjects::write(std::span<const PlacedObject> objects, const RecordTables& tables,
                         const ObjectCounts& before, ObjectRecord* to) const {
  Writer writer(*this, tables, before);
  const Piece* near = nullptr;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    ProgressMonitor::check_cancelled(i);
    const Piece& piece = piece_of(objects[i].source, near);
    near = &piece;
    const std::uint32_t number = objects[i].source;
    if (piece.mesh == nullptr)
      to[i] = writer.shape(placed_at(piece, number));
    else
      writer.triangle(piece, number - piece.first, to[i]);
  }
}

bool SceneObjects::are_plain_triangles() const {
  return std::all_of(pieces_.begin(), pieces_.end(), [](const Piece& piece) {
    if (piece.mesh == nullptr || piece.is_limited_mesh()) return false;
    const Vec3f greatest(greatest_magnitude(piece.vertices));
    return has_size(box_around(greatest, -greatest, Vec3f(0)));
  });
}

std::optional<ObjectCounts> SceneObjects::write_placed(std::uint32_t begin, std::uint32_t end,
                                                       std::span<const std::uint32_t> places,
                                                       const RecordTables& tables, ObjectRecord* to) const {
  Writer writer(*this, tables, {});
  const Piece* near = nullptr;
  bool have_places = true;
  const ObjectCounts counts = visit_boxes(begin, end, [&](std::uint32_t number, const LaneAabb&) {
    if (end - number > kAhead && places[number + kAhead] != kNoPlace)
      __builtin_prefetch(to + places[number + kAhead], 1);
    const std::uint32_t place = places[number];
    have_places &= place != kNoPlace;
    if (place == kNoPlace) return;
    near = &piece_of(number, near);
    writer.lone_triangle(*near, number - near->first, to[place]);
  });
  return have_places ? std::optional(counts) : std::nullopt;
}

void SceneObjects::write_apart(std::uint32_t begin, std::uint32_t end, std::span<const std::uint32_t> places,
                               const RecordTables& tables, ObjectRecord* to) const {
  Writer writer(*this, tables, {});
  while (begin < end) {
    const Piece& piece = piece_of(begin, nullptr);
    const std::uint32_t piece_end = std::min(end, end_of(piece));
    for (std::uint32_t number = begin; number < piece_end; ++number) {
      ProgressMonitor::check_cancelled(number);
      if (piece_end - number > kAhead && places[number + kAhead] != kNoPlace)
        __builtin_prefetch(to + places[number + kAhead], 1);
      if (places[number] == kNoPlace) continue;
      ObjectRecord& record = to[places[number]];
      if (piece.mesh != nullptr)
        writer.lone_triangle(piece, number - piece.first, record);
      else
        record = writer.shape(placed_at(piece, number));
    }
    begin = piece_end;
  }
}

void SceneObjects::write_unbounded(const RecordTables& tables, const ObjectCounts& before,
                                   ObjectRecord* to) const {
  Writer writer(*this, tables, before);
  for (const Placed& object : projectors_)
    *to++ = writer.shape(object);
  for (const Placed& object : unbounded_)
    *to++ = writer.shape(object);
}

} // namespace celltrace
