// Polygons in the planes that they lie in, as triangles, and the table of their edges.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/primitives/polygon.hpp"

#include <optional>
#include <unordered_map>
#include <vector>

namespace celltrace {

/// From the space of the kernel's polygon to this one: its square from -1 to 1 in x and y is just around the
/// points, its z axis is the normal, which is that of the first corner that is one: (b - a) x (c - a).
/// Nothing if the polygon has no area.
std::optional<Transform> frame_of(const Polygon& polygon);

/// The same as triangles, transformed to the world; without any if the polygon is not convex, has many
/// corners or its points lie beside the plane.
Mesh triangles_of(const Polygon& polygon, const Transform& to_world);

/// The edges of polygons, in the frames of these; polygons that objects share have them once.
class PolygonTable {
public:
  /// Those of an object, or of all parts of a CSG.
  void add(const Object& object);

  const std::vector<kernel::PolygonEdgeRecord>& edges() const { return edges_; }
  /// Those of a polygon that has been added: `first` is an index.
  kernel::PolygonEdges of(const Polygon& polygon) const { return known_.at(&polygon); }

private:
  void add(const Polygon& polygon);

  std::vector<kernel::PolygonEdgeRecord> edges_;
  std::unordered_map<const Polygon*, kernel::PolygonEdges> known_;
};

} // namespace celltrace
