#include "pov/height_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "celltrace/error.hpp"
#include "pov/session.hpp"

namespace celltrace::pov {

namespace {

/// Returns the height that a pixel stands for: 16 bits, from the grey or from red and green, by POV-Ray's rules.
std::uint16_t height_of(const image::SourceImage& image, std::size_t pixel) {
  if (!image.index.empty()) return static_cast<std::uint16_t>(image.index[pixel] * 256);
  const std::uint16_t* const rgba = image.rgba.data() + 4 * pixel;
  const bool is_png = image.format == image::SourceFormat::png;
  if (image.is_grey && (image.bits > 8 || !is_png)) return rgba[0];
  if (image.is_grey) {
    // The grey of three equal channels, in single precision: some levels come out one lower.
    const float v = static_cast<float>(rgba[0] / 257) / 255.0f;
    const float grey = 0.297f * v + 0.589f * v + 0.114f * v;
    return static_cast<std::uint16_t>(257 * static_cast<int>(255.0f * grey));
  }
  if (image.bits <= 8) return static_cast<std::uint16_t>(256 * (rgba[0] / 257) + rgba[1] / 257);
  const double grey = 0.297 * rgba[0] + 0.589 * rgba[1] + 0.114 * rgba[2];
  return static_cast<std::uint16_t>(grey);
}

/// Makes the triangles of a height field.
class Surface {
public:
  explicit Surface(const HeightField& field) : field_(field), mesh_(std::make_shared<MeshDefinition>()) {
    const auto [low, high] = std::minmax_element(field.heights->begin(), field.heights->end());
    (void)high;
    constexpr double kMargin = 0.001; // of POV-Ray's box around the surface, in steps of height
    level_ = (std::max<double>(*low, 65536 * field.water_level) - kMargin) / 65536;
  }

  std::shared_ptr<MeshDefinition> make() {
    Mesh& mesh = mesh_->mesh;
    for (int row = 0; row < field_.height; ++row)
      for (int column = 0; column < field_.width; ++column) {
        mesh.vertices.emplace_back(point(column, row));
        if (field_.is_smooth) mesh.normals.emplace_back(normal(column, row));
      }
    for (int row = 0; row + 1 < field_.height; ++row)
      for (int column = 0; column + 1 < field_.width; ++column) {
        add(index(column, row), index(column + 1, row), index(column, row + 1));
        add(index(column + 1, row + 1), index(column, row + 1), index(column + 1, row));
      }
    mesh.inside_vector = Vec3(0, 1, 0); // a point below the surface is inside, however deep
    return mesh_;
  }

private:
  /// Returns the index of a sample; rows are counted from z = 0 here, as cells are.
  Index index(int column, int row) const {
    return static_cast<Index>(row) * static_cast<Index>(field_.width) + static_cast<Index>(column);
  }
  double height(int column, int row) const {
    const auto from_top = static_cast<std::size_t>(field_.height - 1 - row);
    return (*field_.heights)[from_top * static_cast<std::size_t>(field_.width) + static_cast<std::size_t>(column)];
  }
  Vec3 point(int column, int row) const {
    return {column / (field_.width - 1.0), height(column, row) / 65536, row / (field_.height - 1.0)};
  }
  /// Returns the mean of the unit normals of the four triangles between a sample and its neighbours, in the
  /// picture's units, as POV-Ray has it.
  Vec3 normal(int column, int row) const {
    const auto at = [&](int dx, int dz) {
      return Vec3(dx, height(column + dx, row + dz) - height(column, row), dz);
    };
    const bool has_right = column + 1 < field_.width, has_left = column > 0, has_up = row + 1 < field_.height,
               has_down = row > 0;
    Vec3 sum(0);
    const auto add_corner = [&](const Vec3& a, const Vec3& b) {
      Vec3 n = glm::cross(a, b);
      if (n.y < 0) n = -n;
      sum += glm::normalize(n);
    };
    if (has_right && has_up) add_corner(at(1, 0), at(0, 1));
    if (has_up && has_left) add_corner(at(0, 1), at(-1, 0));
    if (has_left && has_down) add_corner(at(-1, 0), at(0, -1));
    if (has_down && has_right) add_corner(at(0, -1), at(1, 0));
    // POV-Ray keeps 16 bits of each component. Of the height's, which is small, this leaves few.
    sum = glm::trunc(glm::normalize(sum) * 32767.0);
    // From the picture's units to the unit cube: normals are scaled by the inverse.
    return glm::normalize(Vec3(sum.x * (field_.width - 1), sum.y * 65536, sum.z * (field_.height - 1)));
  }

  void add(Index a, Index b, Index c) {
    const std::array<Index, 3> corner = {a, b, c};
    const auto is_dry = [&](Index i) { return mesh_->mesh.vertices[i].y >= level_; };
    const auto dry = std::count_if(corner.begin(), corner.end(), is_dry);
    if (dry == 3) return add_triangle(a, b, c);
    if (dry == 0) return;
    // Cuts the triangle at the water: what is left is a triangle or two.
    std::vector<Index> left;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index from = corner[i], to = corner[(i + 1) % 3];
      if (is_dry(from)) left.push_back(from);
      if (is_dry(from) != is_dry(to)) left.push_back(cut(from, to));
    }
    for (std::size_t i = 2; i < left.size(); ++i)
      add_triangle(left[0], left[i - 1], left[i]);
  }
  void add_triangle(Index a, Index b, Index c) {
    Mesh::Triangle triangle;
    const Index corner[3] = {a, b, c};
    for (int i = 0; i < 3; ++i) {
      triangle.vertex[i] = corner[i];
      if (field_.is_smooth) triangle.normal[i] = corner[i];
    }
    mesh_->mesh.triangles.push_back(triangle);
  }
  /// Adds the point where an edge meets the water.
  Index cut(Index from, Index to) {
    Mesh& mesh = mesh_->mesh;
    const Vec3 a(mesh.vertices[from]), b(mesh.vertices[to]);
    const double share = (level_ - a.y) / (b.y - a.y);
    mesh.vertices.emplace_back(a + (b - a) * share);
    if (field_.is_smooth)
      mesh.normals.emplace_back(
          glm::normalize(Vec3(mesh.normals[from]) * (1 - share) + Vec3(mesh.normals[to]) * share));
    return static_cast<Index>(mesh.vertices.size() - 1);
  }

  const HeightField& field_;
  std::shared_ptr<MeshDefinition> mesh_;
  double level_ = 0;
};

void check_size(Session& session, double width, double height, const Location& where) {
  constexpr double kMost = 65535, kMostCells = 1 << 24;
  if (!(width >= 2 && height >= 2 && width <= kMost && height <= kMost && width * height <= kMostCells))
    session.fail(where, "a height_field has 2 to 65535 columns and rows, and at most 16,777,216 points");
}

/// Makes the object's triangles from its height field.
void rebuild(Session& session, ObjectDefinition& object, const HeightField& field, const Location& where) {
  const std::size_t triangles =
      2 * static_cast<std::size_t>(field.width - 1) * static_cast<std::size_t>(field.height - 1);
  session.tokens.spend(triangles);
  session.builder.count_triangles(triangles, where);
  std::shared_ptr<MeshDefinition> mesh = Surface(field).make();
  mesh->height_field = std::make_shared<const HeightField>(field);
  object.shape = std::move(mesh);
}

} // namespace

HeightField height_field_of(Session& session, const WrittenPicture& written) {
  const auto image = read_picture(session, written);
  check_size(session, image->width, image->height, written.where);
  HeightField field;
  field.width = image->width;
  field.height = image->height;
  auto heights = std::make_shared<std::vector<std::uint16_t>>(image->rgba.size() / 4);
  for (std::size_t i = 0; i < heights->size(); ++i)
    (*heights)[i] = height_of(*image, i);
  field.heights = heights;
  return field;
}

HeightField height_field_of(Session& session, const UserFunction& function, double width, double height,
                            const Location& where) {
  check_size(session, width, height, where);
  HeightField field;
  field.width = static_cast<int>(width);
  field.height = static_cast<int>(height);
  auto heights = std::make_shared<std::vector<std::uint16_t>>();
  for (int row = 0; row < field.height; ++row)
    for (int column = 0; column < field.width; ++column) {
      const double at[3] = {column / (field.width - 1.0), row / (field.height - 1.0), 0};
      const Quantity value = call_function(session, function, at, function.parameters, where);
      const double grey = function.returns_vector ? value.grey() : value.v[0];
      // Heights wrap around, as POV-Ray does not limit them.
      const double steps = std::trunc(65535 * grey);
      const double wrapped = std::isfinite(steps) ? steps - 65536 * std::floor(steps / 65536) : 0;
      heights->push_back(static_cast<std::uint16_t>(wrapped));
    }
  field.heights = heights;
  return field;
}

std::shared_ptr<ObjectDefinition> height_field(Session& session, const HeightField& field, const Location& where) {
  auto object = std::make_shared<ObjectDefinition>();
  rebuild(session, *object, field, where);
  return object;
}

void change_height_field(Session& session, ObjectDefinition& object, const std::function<void(HeightField&)>& change,
                         const Location& where) {
  const auto* const mesh = std::get_if<std::shared_ptr<MeshDefinition>>(&object.shape);
  if (mesh == nullptr || !(*mesh)->height_field) session.fail(where, "only a height_field has this option");
  HeightField field = *(*mesh)->height_field;
  change(field);
  rebuild(session, object, field, where);
}

} // namespace celltrace::pov
