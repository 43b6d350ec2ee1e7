// The records of shapes that are made of any number of parts, such as the edges of polygons.
#pragma once

#include "celltrace/scene.hpp"
#include "records/object.hpp"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace celltrace {

/// The ShapeDataRecords of all shapes, each in its shape's own space; a shape that several objects share is
/// stored once.
class ShapeDataTable {
public:
  /// Adds the shape of an object, or of all parts of a CSG.
  void add(const Object& object);

  const std::vector<kernel::ShapeDataRecord>& records() const { return records_; }
  /// Returns the records of an object's shape, which has been added, with `first` as an index in records();
  /// none if the shape has none.
  kernel::ShapeData of(const Object& object) const;

private:
  std::vector<kernel::ShapeDataRecord> records_;
  std::unordered_map<const void*, kernel::ShapeData> known_; ///< by the address of the shape
};

} // namespace celltrace
