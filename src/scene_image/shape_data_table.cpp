#include "scene_image/shape_data_table.hpp"

#include "geometry/basis.hpp"
#include "geometry/data_shapes.hpp"
#include "geometry/polygons.hpp"
#include "kernel/primitives/list.hpp"
#include "scene_image/shapes.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

using Records = std::vector<ShapeDataRecord>;

ShapeDataRecord record(double a, double b, double c, double d) {
  return {{static_cast<float>(a), static_cast<float>(b), static_cast<float>(c), static_cast<float>(d)}};
}

// One overload of put() for each shape that has records.

void put(const Polygon& polygon, Records& records) {
  const std::optional<Transform> frame = frame_of(polygon);
  if (!frame) return;
  const Transform to_frame = frame->inverse();
  for (const std::vector<Vec3>& loop : polygon.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      Vec3 low = to_frame.point(loop[i]), high = to_frame.point(loop[i + 1 == loop.size() ? 0 : i + 1]);
      if (low.y > high.y) std::swap(low, high);
      const ShapeDataRecord edge = record(low.y, high.y, low.x, (high.x - low.x) / (high.y - low.y));
      if (edge.value[0] < edge.value[1]) records.push_back(edge);
    }
}

void put(const Polynomial& polynomial, Records& records) {
  records.push_back(record(polynomial.degree, scale_of(polynomial), 0, 0));
  const std::vector<double>& c = polynomial.coefficients;
  const auto at = [&](std::size_t i) { return i < c.size() ? c[i] : 0; };
  for (std::size_t i = 0; i < c.size(); i += 4)
    records.push_back(record(c[i], at(i + 1), at(i + 2), at(i + 3)));
}

/// Writes curves whose points (x, y) become ((x - origin_x) / size_x, (y - origin_y) / size_y).
void put_curve(const std::vector<CurveSegment>& curve, double origin_x, double size_x, double origin_y,
               double size_y, Records& records) {
  for (CurveSegment s : curve) {
    s.x[0] -= origin_x;
    s.y[0] -= origin_y;
    for (int k = 0; k < 4; ++k) {
      s.x[k] /= size_x;
      s.y[k] /= size_y;
    }
    const CurveBounds b = CurveBounds::of(s);
    constexpr double kWiden = 1e-5;
    records.push_back(record(s.x[0], s.x[1], s.x[2], s.x[3]));
    records.push_back(record(s.y[0], s.y[1], s.y[2], s.y[3]));
    records.push_back(record(s.x[0] + s.x[1] + s.x[2] + s.x[3], s.y[0] + s.y[1] + s.y[2] + s.y[3], 0, 0));
    records.push_back(record(0.5 * (b.min_x + b.max_x), 0.5 * (b.min_y + b.max_y),
                             0.5 * (b.max_x - b.min_x) + kWiden, 0.5 * (b.max_y - b.min_y) + kWiden));
  }
  // A segment ends where the next one begins, to the bit.
  constexpr std::size_t kEach = CurvePiece::kRecords;
  const std::size_t first = records.size() - curve.size() * kEach;
  std::size_t loop = 0;
  const auto start = [&](std::size_t i) { return &records[first + i * kEach]; };
  for (std::size_t i = 0; i < curve.size(); ++i) {
    float* const end = start(i)[2].value;
    const auto is_start = [&](std::size_t j) {
      constexpr float kNear = 1e-5f;
      return std::fabs(end[0] - start(j)[0].value[0]) < kNear && std::fabs(end[1] - start(j)[1].value[0]) < kNear;
    };
    const bool goes_on = i + 1 < curve.size() && is_start(i + 1);
    if (!goes_on && !is_start(loop)) {
      loop = i + 1;
      continue;
    }
    const ShapeDataRecord* const next = start(goes_on ? i + 1 : loop);
    end[0] = next[0].value[0];
    end[1] = next[1].value[0];
    if (!goes_on) loop = i + 1;
  }
}

void put(const Prism& prism, Records& records) {
  const std::optional<Transform> frame = frame_of(prism);
  if (!frame) return;
  records.push_back(
      record(degree_of(prism.outline), prism.is_conic, prism.open, double{lower_end_of(prism)}));
  const Vec3(&rows)[4] = frame->rows;
  const double height = prism.is_conic ? rows[2].y : 1;
  put_curve(prism.outline, rows[3].x, rows[0].x / height, rows[3].z, rows[1].z / height, records);
}

void put(const Lathe& lathe, Records& records) {
  const std::optional<Transform> frame = frame_of(lathe);
  if (!frame) return;
  const CurveBounds b = CurveBounds::of(lathe.curve);
  const double radius = frame->rows[0].x;
  const auto square = [&](double x) { return x * std::fabs(x) / (radius * radius); };
  records.push_back(record(degree_of(lathe.curve), square(b.min_x), square(b.max_x), 0));
  put_curve(lathe.curve, 0, radius, frame->rows[3].y, frame->rows[2].y, records);
}

void put(const SurfaceOfRevolution& sor, Records& records) {
  const std::optional<Transform> frame = frame_of(sor);
  if (!frame) return;
  const double radius = frame->rows[0].x, bottom = frame->rows[3].y, height = frame->rows[2].y;
  const double square = 1 / (radius * radius);
  const auto at = [&](const SurfaceOfRevolution::Piece& piece, double y) {
    const auto& c = piece.square;
    return (((c[3] * y + c[2]) * y + c[1]) * y + c[0]) * square;
  };
  records.push_back(record(sor.open, at(sor.pieces.front(), sor.pieces.front().low),
                           at(sor.pieces.back(), sor.pieces.back().high), square));
  for (const SurfaceOfRevolution::Piece& piece : sor.pieces) {
    // Taylor's coefficients at the bottom, in units of the height
    const auto& c = piece.square;
    records.push_back(record(at(piece, bottom), (c[1] + (2 * c[2] + 3 * c[3] * bottom) * bottom) * height * square,
                             (c[2] + 3 * c[3] * bottom) * height * height * square,
                             c[3] * height * height * height * square));
    records.push_back(record((piece.low - bottom) / height, (piece.high - bottom) / height, 0, 0));
  }
}

void put(const Blob& blob, Records& records) {
  const std::optional<Transform> frame = frame_of(blob);
  if (!frame) return;
  records.push_back(record(blob.threshold, 0, 0, 0));
  for (const Blob::Component& component : blob.components) {
    const Vec3 line = component.b - component.a;
    const double length = glm::length(line);
    Transform unit;
    unit.rows[2] = length > 0 ? line / length : Vec3(0, 0, 1);
    complete_basis(unit.rows[2], unit.rows[0], unit.rows[1]);
    for (int i = 0; i < 3; ++i)
      unit.rows[i] *= component.radius;
    const auto add = [&](BlobElement::Kind kind, const Vec3& origin) {
      unit.rows[3] = origin;
      float map[12];
      write_map(frame->then(component.transform.inverse()).then(unit.inverse()), map);
      for (int row = 0; row < 3; ++row)
        records.push_back({{map[row * 4], map[row * 4 + 1], map[row * 4 + 2], map[row * 4 + 3]}});
      records.push_back(record(component.strength, kind, length / component.radius, 0));
    };
    if (length == 0) {
      add(BlobElement::ball, component.a);
      continue;
    }
    add(BlobElement::cylinder, component.a);
    add(BlobElement::lower_half, component.a);
    add(BlobElement::upper_half, component.b);
  }
}

/// Returns the address of a shape that has records; null for any other one.
const void* address_of(const decltype(Object::shape)& shape) {
  return std::visit(
      [](const auto& s) -> const void* {
        if constexpr (requires(Records& records) { put(*s, records); }) return s.get();
        return nullptr;
      },
      shape);
}

} // namespace

void ShapeDataTable::add(const Object& object) {
  if (const auto* csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape)) {
    for (const Object& part : (*csg)->parts)
      add(part);
    return;
  }
  const void* const address = address_of(object.shape);
  if (address == nullptr || known_.contains(address)) return;
  const std::size_t first = records_.size();
  std::visit(
      [&](const auto& s) {
        if constexpr (requires { put(*s, records_); }) put(*s, records_);
      },
      object.shape);
  // A table that is too long is rejected when the image is laid out.
  known_[address] = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(records_.size() - first)};
}

ShapeData ShapeDataTable::of(const Object& object) const {
  const auto known = known_.find(address_of(object.shape));
  return known != known_.end() ? known->second : ShapeData{0, 0};
}

} // namespace celltrace
