// Bicubic patches: surfaces over a square that 4x4 control points define. They become triangles, as in
// POV-Ray.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include <glm/vec2.hpp>

#include "pov/location.hpp"
#include "pov/object.hpp"
#include "pov/quantity.hpp"

namespace celltrace::pov {

struct Session;

/// The control points of a tensor product of cubic Bezier curves: four along s in each of four rows along q.
using ControlNet = std::array<std::array<Vec3, 4>, 4>;

/// A patch, and into what triangles it is divided.
struct BicubicPatch {
  ControlNet points{};
  double flatness =
      0;           ///< a piece is not divided if its control points are nearer than this to a plane; 0: never
  int s_steps = 0; ///< how often it is halved at most along s
  int q_steps = 0; ///< how often it is halved at most along q
  /// Surface coordinates of the corners (0, 0), (0, 1), (1, 1) and (1, 0), in terms of (s, q).
  std::array<glm::dvec2, 4> coordinates{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
};

/// A patch as written.
struct PatchDefinition {
  BicubicPatch patch;
  bool has_type = false;
  std::vector<Quantity> values; ///< options of the old form, and control points
};

/// Sets the surface coordinates of the corners; warns of coordinates that are not finite, and sets them to 0.
void set_coordinates(Session& session, PatchDefinition& definition, const std::array<Vec3, 4>& uv,
                     const Location& where);
/// Adds an option of the old form, or a control point. Fails if there are too many.
void add_value(Session& session, PatchDefinition& definition, const Quantity& value, const Location& where);
/// Returns the object; fails if its options or its control points are incomplete.
std::shared_ptr<ObjectDefinition> patch(Session& session, PatchDefinition& definition, const Location& where);

/// Limits the number of steps to what is more than any limit of a scene allows.
int patch_steps(double number);

/// Returns the patch as triangles in its own space. POV-Ray judges how flat a piece is where `transform`
/// places the patch. `count_triangles` is called before triangles are added. Throws InputError, without a
/// position, if a coordinate is too large.
std::shared_ptr<MeshDefinition> make_mesh(const BicubicPatch& patch, const Transform& transform,
                                          const std::function<void(std::size_t)>& count_triangles);

} // namespace celltrace::pov
