#include "study/scenes.hpp"

#include <cmath>
#include <cstddef>
#include <random>

namespace celltrace::study {

namespace {

/// Uniform random numbers that are the same with every standard library.
class Random {
public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0;
  }

private:
  std::mt19937 engine_;
};

Camera look(const Vec3& from, const Vec3& at, double width) {
  const auto normalised = [](const Vec3& v) {
    return v * (1 / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z));
  };
  const auto across = [](const Vec3& a, const Vec3& b) {
    return Vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
  };
  Camera camera;
  camera.location = from;
  camera.direction = normalised(at - from);
  const Vec3 right = normalised(across(Vec3(0, 1, 0), camera.direction));
  camera.right = right * width;
  camera.up = across(camera.direction, right) * (width * 0.75);
  return camera;
}

Index paint(Scene& scene, const Vec3& colour, double mirror = 0) {
  Material material;
  material.pigment.rgb = colour;
  material.finish.phong = 0.4;
  material.finish.reflection_min = material.finish.reflection_max = Vec3(mirror);
  return scene.add(material);
}

void add_sphere(Scene& scene, const Vec3& centre, double radius, Index material) {
  scene.objects.push_back({Sphere{centre, radius}, {}, material, scene.add(Interior{}), false});
}

Scene empty(const Camera& camera) {
  Scene scene;
  scene.camera = camera;
  scene.background = Vec3(0.3, 0.5, 0.8);
  scene.lights = {Light{Vec3(40, 60, -50)}};
  return scene;
}

/// Adds a floor of two triangles.
void add_floor(Scene& scene, double y, double size, Index material) {
  auto mesh = std::make_shared<Mesh>();
  for (const auto& [x, z] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    mesh->vertices.emplace_back(x * size, y, z * size);
  mesh->triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  scene.objects.push_back({mesh, {}, material, scene.add(Interior{}), false});
}

Scene few() {
  Scene scene = empty(look(Vec3(0, 3, -12), Vec3(0, 1, 0), 0.9));
  add_floor(scene, -1, 30, paint(scene, Vec3(0.8, 0.8, 0.7)));
  for (int i = 0; i < 8; ++i) {
    const double angle = i * 0.7853981634;
    add_sphere(scene, Vec3(3 * std::cos(angle), 0.2 + 0.1 * i, 3 * std::sin(angle)), 0.9,
               paint(scene, Vec3(0.9 - 0.1 * i, 0.2 + 0.08 * i, 0.3), i % 2 == 0 ? 0.4 : 0.0));
  }
  return scene;
}

/// Makes a chain that wanders through a ball, with smaller atoms around each of its own.
Scene molecule() {
  Scene scene = empty(look(Vec3(0, 0, -26), Vec3(0, 0, 0), 0.8));
  const Index grey = paint(scene, Vec3(0.5)), white = paint(scene, Vec3(0.9)),
              red = paint(scene, Vec3(0.8, 0.1, 0.1), 0.2);
  Random random(7);
  Vec3 at(0);
  for (int i = 0; i < 300; ++i) {
    at += Vec3(random.between(-1.3, 1.3), random.between(-1.3, 1.3), random.between(-1.3, 1.3)) - at * 0.03;
    add_sphere(scene, at, 0.7, i % 5 == 0 ? red : grey);
    for (int j = 0; j < 2; ++j)
      add_sphere(scene,
                 at + Vec3(random.between(-0.8, 0.8), random.between(-0.8, 0.8), random.between(-0.8, 0.8)),
                 0.4, white);
  }
  return scene;
}

/// Makes mirrors in one corner of an otherwise empty space.
Scene corner() {
  Scene scene = empty(look(Vec3(0, 0, -20), Vec3(0, 0, 0), 0.9));
  Random random(11);
  const Index mirror = paint(scene, Vec3(0.2, 0.2, 0.25), 0.8);
  for (int i = 0; i < 400; ++i)
    add_sphere(scene, Vec3(random.between(2, 8.5), random.between(-6.4, -3.6), random.between(-2, 4)), 0.35,
               mirror);
  scene.max_trace_level = 8;
  return scene;
}

/// Makes beads on the edges of a long empty box: rays traverse many voxels of a grid before they hit
/// something, if they do.
Scene cage() {
  Scene scene = empty(look(Vec3(0, 0, -60), Vec3(0, 0, 0), 0.44));
  const Index red = paint(scene, Vec3(0.8, 0.3, 0.2));
  const double half[3] = {10, 7.5, 20};
  const int beads[3] = {37, 37, 300};
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1})
      for (const int other_side : {-1, 1})
        for (int i = 0; i < beads[axis]; ++i) {
          double at[3];
          at[axis] = half[axis] * ((2.0 * i + 1) / beads[axis] - 1);
          at[(axis + 1) % 3] = half[(axis + 1) % 3] * side;
          at[(axis + 2) % 3] = half[(axis + 2) % 3] * other_side;
          add_sphere(scene, Vec3(at[0], at[1], at[2]), 0.04, red);
        }
  return scene;
}

/// Adds a sphere with nine on it, and nine on each of those (Haines, "A proposal for standard graphics
/// environments", 1987).
void add_flake(Scene& scene, const Vec3& centre, const Vec3& up, double radius, int levels, Index material) {
  add_sphere(scene, centre, radius, material);
  if (levels == 0) return;
  const Vec3 side = std::abs(up.y) < 0.9 ? Vec3(up.z, 0, -up.x) : Vec3(0, up.z, -up.y);
  const double length = std::sqrt(side.x * side.x + side.y * side.y + side.z * side.z);
  const Vec3 u = side * (1 / length);
  const Vec3 v(up.y * u.z - up.z * u.y, up.z * u.x - up.x * u.z, up.x * u.y - up.y * u.x);
  for (int i = 0; i < 9; ++i) {
    const double angle = (i < 6 ? i : 2 * (i - 6) + 0.5) * 1.0471975512;
    const double rise = i < 6 ? 0.0 : 0.8164965809;
    const double out = i < 6 ? 1.0 : 0.5773502692;
    const Vec3 direction = u * (out * std::cos(angle)) + v * (out * std::sin(angle)) + up * rise;
    add_flake(scene, centre + direction * (radius * 4 / 3), direction, radius / 3, levels - 1, material);
  }
}

Scene flake() {
  Scene scene = empty(look(Vec3(4, 5, -7), Vec3(0, 0.2, 0), 0.7));
  add_floor(scene, -1.4, 12, paint(scene, Vec3(0.9, 0.8, 0.6)));
  add_flake(scene, Vec3(0), Vec3(0, 1, 0), 1.2, 4, paint(scene, Vec3(0.5, 0.45, 0.35), 0.35));
  return scene;
}

/// Makes hills of n x n squares, two triangles each.
Scene hills(int n) {
  Scene scene = empty(look(Vec3(0, 7, -13), Vec3(0, -1, 0), 1.0));
  auto mesh = std::make_shared<Mesh>();
  const auto height = [](double x, double z) {
    return std::sin(x * 0.9) * std::cos(z * 0.7) + 0.35 * std::sin(x * 2.7 + z * 1.9) +
           0.1 * std::sin(x * 7.1 - z * 5.3);
  };
  for (int row = 0; row <= n; ++row)
    for (int column = 0; column <= n; ++column) {
      const double x = 20.0 * column / n - 10, z = 20.0 * row / n - 10;
      mesh->vertices.emplace_back(x, height(x, z), z);
    }
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const auto at = [&](int r, int c) { return static_cast<Index>((row + r) * (n + 1) + column + c); };
      mesh->triangles.push_back({{at(0, 0), at(1, 0), at(0, 1)}});
      mesh->triangles.push_back({{at(1, 0), at(1, 1), at(0, 1)}});
    }
  scene.objects.push_back({mesh, {}, paint(scene, Vec3(0.45, 0.6, 0.3)), scene.add(Interior{}), false});
  return scene;
}

} // namespace

std::vector<StudyScene> make_scenes() {
  return {{"few", "8 spheres on a floor, half of them mirrors", few()},
          {"molecule", "900 spheres in a heap", molecule()},
          {"corner", "400 mirrors in one corner of an empty picture", corner()},
          {"cage", "1,496 beads on the edges of an empty box", cage()},
          {"flake", "7,381 spheres that mirror each other, on a floor", flake()},
          {"terrain", "10,082 triangles", hills(71)},
          {"mountains", "100,352 triangles", hills(224)}};
}

} // namespace celltrace::study
