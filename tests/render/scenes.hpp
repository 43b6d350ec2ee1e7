// Small scenes that together use everything a Scene can say, and helpers to build others.
#pragma once

#include "celltrace/scene.hpp"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace celltrace::test {

struct NamedScene {
  std::string name;
  std::function<Scene()> make;
  std::string not_in_reference = ""; ///< why the reference tracer cannot render it
};

/// Every scene of the folder.
const std::vector<NamedScene>& scenes();
Scene scene_named(const std::string& name);
/// Two triangles of one plane that share most of it. Rounding decides which of them a ray hits, so that it is
/// another one in double precision.
Scene overlapping_triangles();
/// A plane, and if asked for the lower half of a ball, which ends in that plane.
Scene ground(bool with_bowl);

// --- parts ---

/// Opaque, with POV-Ray's default finish.
Material matte(const Vec3& rgb);
/// Clear, filtering by `rgb`, and mirroring a little.
Material glass(const Vec3& rgb);

template <class T>
std::shared_ptr<const PatternMap<T>>
map_of(const Pattern& pattern, std::vector<typename PatternMap<T>::Entry> entries, bool is_average = false) {
  return std::make_shared<const PatternMap<T>>(PatternMap<T>{pattern, std::move(entries), is_average});
}

Object sphere_at(const Vec3& centre, double radius, Index material, Index interior);
/// Two triangles in the plane y = `height`, from -`half` to `half`.
Mesh floor_mesh(float height, float half);
/// A unit sphere of `rings` x 2 `rings` quadrangles with the sphere's own normals.
Mesh ball_mesh(int rings);
Object mesh_object(Mesh mesh, Index material, Index interior);
/// Of the material and interior 0.
Object csg_object(Csg::Operation operation, std::vector<Object> parts);

/// Looks from `from` to `to` with a horizontal angle of 60 degrees and the aspect 4:3.
Camera camera_at(const Vec3& from, const Vec3& to);
/// Parallel rays from `from` to `to`, `width` units wide, 4:3.
Camera orthographic_camera(const Vec3& from, const Vec3& to, double width);

} // namespace celltrace::test
