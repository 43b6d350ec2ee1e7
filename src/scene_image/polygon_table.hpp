// The edges of polygons, against which points in a polygon's plane are tested.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/primitives/polygon.hpp"

#include <unordered_map>
#include <vector>

namespace celltrace {

/// The edges of polygons, each in its polygon's frame; a polygon that several objects share is stored once.
class PolygonTable {
public:
  /// Adds the polygons of an object, or of all parts of a CSG.
  void add(const Object& object);

  const std::vector<kernel::PolygonEdgeRecord>& edges() const { return edges_; }
  /// Returns the edges of a polygon that has been added, with `first` as an index in edges().
  kernel::PolygonEdges of(const Polygon& polygon) const { return known_.at(&polygon); }

private:
  void add(const Polygon& polygon);

  std::vector<kernel::PolygonEdgeRecord> edges_;
  std::unordered_map<const Polygon*, kernel::PolygonEdges> known_;
};

} // namespace celltrace
