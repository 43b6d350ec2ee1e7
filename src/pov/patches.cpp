#include "pov/patches.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "celltrace/error.hpp"
#include "pov/mesh.hpp"
#include "pov/session.hpp"

namespace celltrace::pov {

namespace {

constexpr std::size_t kPoints = 16;
constexpr std::size_t kMostOldOptions = 4; ///< type, flatness, u_steps, v_steps

using Curve = std::array<Vec3, 4>;

/// Splits a Bezier curve in its middle.
void halve(const Curve& curve, Curve& first, Curve& second) {
  const auto middle = [](const Vec3& a, const Vec3& b) { return (a + b) * 0.5; };
  const Vec3 ab = middle(curve[0], curve[1]), bc = middle(curve[1], curve[2]),
             cd = middle(curve[2], curve[3]);
  const Vec3 abc = middle(ab, bc), bcd = middle(bc, cd);
  first = {curve[0], ab, abc, middle(abc, bcd)};
  second = {first[3], bcd, cd, curve[3]};
}

ControlNet transposed(const ControlNet& net) {
  ControlNet result;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      result[j][i] = net[i][j];
  return result;
}

/// Splits a net across its rows.
std::array<ControlNet, 2> halves(const ControlNet& net) {
  std::array<ControlNet, 2> result;
  const ControlNet columns = transposed(net);
  for (std::size_t j = 0; j < 4; ++j)
    halve(columns[j], result[0][j], result[1][j]);
  return {transposed(result[0]), transposed(result[1])};
}

std::array<ControlNet, 2> halves_of_rows(const ControlNet& net) {
  std::array<ControlNet, 2> result;
  for (std::size_t i = 0; i < 4; ++i)
    halve(net[i], result[0][i], result[1][i]);
  return result;
}

/// Returns whether all control points are nearer than `flatness` to the plane of three corners. POV-Ray
/// divides a piece whose corners are on a line.
bool is_flat(const ControlNet& net, const Transform& transform, double flatness) {
  const Vec3 corner = transform.point(net[0][0]);
  const Vec3 across = glm::cross(transform.point(net[0][3]) - corner, transform.point(net[3][0]) - corner);
  const double length = glm::length(across);
  constexpr double kLeast = 1e-10;
  if (!(length > kLeast)) return false;
  for (const auto& row : net)
    for (const Vec3& point : row)
      if (!(std::abs(glm::dot(transform.point(point) - corner, across)) <= flatness * length)) return false;
  return true;
}

/// The weights of a Bezier curve's control points at `t`, and those of its derivative.
struct Weights {
  std::array<double, 4> value, slope;

  explicit Weights(double t) {
    const double u = 1 - t;
    value = {u * u * u, 3 * t * u * u, 3 * t * t * u, t * t * t};
    slope = {-3 * u * u, 3 * u * (u - 2 * t), 3 * t * (2 * u - t), 3 * t * t};
  }
};

Vec3 weighted(const ControlNet& net, const std::array<double, 4>& along_s,
              const std::array<double, 4>& along_q) {
  Vec3 sum(0);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      sum += net[i][j] * (along_s[i] * along_q[j]);
  return sum;
}

/// Divides a patch into triangles.
class Tessellation {
public:
  Tessellation(const BicubicPatch& patch, const Transform& transform,
               const std::function<void(std::size_t)>& count_triangles)
      : patch_(patch), transform_(transform), count_triangles_(count_triangles) {}

  std::shared_ptr<MeshDefinition> run() {
    if (!may_be_flat()) count_triangles_(std::size_t{2} << (patch_.s_steps + patch_.q_steps));
    add({patch_.points, {0, 1}, {0, 1}, 0});
    return builder_.finish();
  }

private:
  struct Piece {
    ControlNet net;
    std::array<double, 2> s, q; ///< its part of the patch
    int depth;
  };
  struct Corner {
    Vec3 point, normal;
    Vec2f coordinates;
  };

  void add(const Piece& piece) {
    const bool splits_s = piece.depth < patch_.s_steps, splits_q = piece.depth < patch_.q_steps;
    if ((!splits_s && !splits_q) || (may_be_flat() && is_flat(piece.net, transform_, patch_.flatness))) {
      add_triangles(piece);
      return;
    }
    const double s = (piece.s[0] + piece.s[1]) / 2, q = (piece.q[0] + piece.q[1]) / 2;
    const int depth = piece.depth + 1;
    if (!splits_q) {
      const auto [low, high] = halves(piece.net);
      add({low, {piece.s[0], s}, piece.q, depth});
      add({high, {s, piece.s[1]}, piece.q, depth});
      return;
    }
    const auto [left, right] = halves_of_rows(piece.net);
    const std::array<double, 2> before{piece.q[0], q}, behind{q, piece.q[1]};
    if (!splits_s) {
      add({left, piece.s, before, depth});
      add({right, piece.s, behind, depth});
      return;
    }
    const auto [low_left, high_left] = halves(left);
    const auto [low_right, high_right] = halves(right);
    add({low_left, {piece.s[0], s}, before, depth});
    add({low_right, {piece.s[0], s}, behind, depth});
    add({high_left, {s, piece.s[1]}, before, depth});
    add({high_right, {s, piece.s[1]}, behind, depth});
  }

  bool may_be_flat() const { return patch_.flatness > 0; }

  void add_triangles(const Piece& piece) {
    if (may_be_flat()) count_triangles_(2);
    const auto& net = piece.net;
    const std::array<Corner, 4> corners{
        corner(net[0][0], piece.s[0], piece.q[0]), corner(net[0][3], piece.s[0], piece.q[1]),
        corner(net[3][3], piece.s[1], piece.q[1]), corner(net[3][0], piece.s[1], piece.q[0])};
    add(corners[0], corners[1], corners[2]);
    add(corners[0], corners[2], corners[3]);
  }

  Corner corner(const Vec3& point, double s, double q) const {
    const Weights along_s(s), along_q(q);
    const Vec3 normal = glm::cross(weighted(patch_.points, along_s.slope, along_q.value),
                                   weighted(patch_.points, along_s.value, along_q.slope));
    const auto& at = patch_.coordinates;
    const glm::dvec2 coordinates =
        (at[0] * (1 - q) + at[1] * q) * (1 - s) + (at[3] * (1 - q) + at[2] * q) * s;
    return {point, normal, Vec2f(coordinates)};
  }

  void add(const Corner& a, const Corner& b, const Corner& c) {
    TriangleDefinition triangle;
    triangle.vertices = {a.point, b.point, c.point};
    triangle.normals = {a.normal, b.normal, c.normal};
    triangle.coordinates = {a.coordinates, b.coordinates, c.coordinates};
    triangle.is_smooth = triangle.is_mapped = true;
    builder_.add(triangle);
  }

  const BicubicPatch& patch_;
  const Transform& transform_;
  const std::function<void(std::size_t)>& count_triangles_;
  MeshBuilder builder_;
};

/// Sets the options of the old form, which have no words: type, flatness if there are four, and steps.
void set_old_options(Session& session, PatchDefinition& definition, std::size_t count,
                     const Location& where) {
  const std::vector<Quantity>& values = definition.values;
  if (count < 3) session.fail(where, "this bicubic_patch needs 'type'");
  BicubicPatch& patch = definition.patch;
  definition.has_type = true;
  patch.flatness = count == kMostOldOptions ? values[1].v[0] : 0;
  patch.s_steps = patch_steps(values[count - 2].v[0]);
  patch.q_steps = patch_steps(values[count - 1].v[0]);
}

} // namespace

int patch_steps(double number) {
  constexpr double kMost = 30; // more triangles than any limit
  return static_cast<int>(std::clamp(number, 0.0, kMost));
}

void add_value(Session& session, PatchDefinition& definition, const Quantity& value, const Location& where) {
  if (definition.values.size() == kPoints + kMostOldOptions)
    session.fail(where, "a bicubic_patch has 16 control points");
  definition.values.push_back(value);
}

void set_coordinates(Session& session, PatchDefinition& definition, const std::array<Vec3, 4>& uv,
                     const Location& where) {
  for (std::size_t i = 0; i < uv.size(); ++i) {
    definition.patch.coordinates[i] = {uv[i].x, uv[i].y};
    if (std::isfinite(uv[i].x) && std::isfinite(uv[i].y)) continue;
    session.diagnostics.warn_once(where, "surface coordinates that are not finite count as 0");
    definition.patch.coordinates[i] = {0, 0};
  }
}

std::shared_ptr<ObjectDefinition> patch(Session& session, PatchDefinition& definition,
                                        const Location& where) {
  const std::vector<Quantity>& values = definition.values;
  std::size_t numbers = 0;
  while (!definition.has_type && numbers < values.size() && numbers < kMostOldOptions &&
         values[numbers].is_float())
    ++numbers;
  if (values.size() != numbers + kPoints)
    session.fail(where,
                 "a bicubic_patch has 16 control points, found " + std::to_string(values.size() - numbers));
  if (!definition.has_type) set_old_options(session, definition, numbers, where);
  BicubicPatch patch = definition.patch;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Quantity& point = values[numbers + i];
    if (!point.is_finite()) session.fail(where, "a control point of this bicubic_patch is not finite");
    patch.points[i / 4][i % 4] = point.vec3();
  }
  auto object = std::make_shared<ObjectDefinition>();
  std::shared_ptr<MeshDefinition> mesh;
  try {
    mesh = make_mesh(patch, Transform(), [&](std::size_t count) {
      session.tokens.spend(count);
      session.builder.count_triangles(count, where);
    });
  } catch (const SceneError&) {
    throw; // has its place
  } catch (const InputError& error) {
    session.fail(where, error.what());
  }
  if (patch.flatness > 0) mesh->patch = std::make_shared<const BicubicPatch>(patch);
  mesh->ignores_clips = true;
  object->shape = std::move(mesh);
  return object;
}

std::shared_ptr<MeshDefinition> make_mesh(const BicubicPatch& patch, const Transform& transform,
                                          const std::function<void(std::size_t)>& count_triangles) {
  return Tessellation(patch, transform, count_triangles).run();
}

} // namespace celltrace::pov
