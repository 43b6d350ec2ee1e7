// Shapes in double precision, to compare with: where rays cross them, and their normals there.
#pragma once

#include "celltrace/scene.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace celltrace::reference {

struct Ray {
  Vec3 origin;
  Vec3 direction; ///< of unit length
};

/// A point of a ray on a surface, before or behind the ray's origin.
struct Crossing {
  double distance;
  double u = 0, v = 0; ///< barycentric weights of a triangle's second and third vertex
};

/// At most four, nearest first.
struct Crossings {
  int count = 0;
  Crossing at[4];

  const Crossing* begin() const { return at; }
  const Crossing* end() const { return at + count; }
};

/// A sphere under an affine transformation, a triangle, or another shape; an object of a scene or a part of
/// one.
struct Shape {
  /// The scene's or, of a part of a CSG, an own one that is placed in the world.
  std::shared_ptr<const Object> object;
  /// CSG and clipping: where a point of the surface is there; null: everywhere.
  std::function<bool(const Vec3&)> condition;
  bool triangle = false;
  /// None of what follows is meant: solids.hpp knows.
  bool solid = false;
  /// Sphere: the sphere, and the way to the space where it is one, which other shapes have too.
  Sphere sphere;
  Transform to_sphere;
  /// Triangle: in the world; normals only if it is smooth. They are of unit length in the mesh's own space.
  Vec3 vertex[3];
  Vec3 normal[3];
  bool smooth = false;
  Vec3 coordinates[3] = {Vec3(0), Vec3(0), Vec3(0)}; ///< u, v, 0 of the surface
  /// One material, or one for each vertex.
  Index material[3] = {0, 0, 0};
  bool blended = false;
};

/// All objects of the scene, meshes and CSG taken apart. The scene must outlive the shapes.
std::vector<Shape> shapes_of(const Scene& scene);

Crossings cross(const Shape& shape, const Ray& ray);

/// Unit normal, with the direction that the geometry gives it.
Vec3 normal_at(const Shape& shape, const Vec3& point, const Crossing& crossing);

/// u, v, 0 of a point of a shape.
Vec3 coordinates_at(const Shape& shape, const Vec3& point, const Crossing& crossing);

/// True inside a sphere or another shape that is no part of a CSG; triangles have no inside.
bool contains(const Shape& shape, const Vec3& point);

} // namespace celltrace::reference
