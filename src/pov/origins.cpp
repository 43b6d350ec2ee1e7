#include "pov/origins.hpp"

#include "pov/object.hpp"
#include "pov/sources.hpp"

#include <array>
#include <variant>

namespace celltrace::pov {

namespace {

/// Names of shapes, by index in Shape.
constexpr std::array<const char*, std::variant_size_v<Shape>> kShapes = {
    "sphere", "mesh",  "plane",   "disc",           "box",     "cylinder",
    "cone",   "torus", "quadric", "superellipsoid", "polygon", "polynomial",
    "prism",  "lathe", "sor",     "blob",           "union"};
/// Names of operations, by Csg::Operation.
constexpr std::array kOperations = {"union", "merge", "intersection", "difference"};

const char* kind_of(const ObjectDefinition& object) {
  if (const auto* shape = std::get_if<Shape>(&object.shape)) return kShapes[shape->index()];
  if (const auto* csg = std::get_if<std::shared_ptr<const Compound>>(&object.shape))
    return kOperations[static_cast<std::size_t>((*csg)->operation)];
  return std::holds_alternative<std::shared_ptr<TriangleDefinition>>(object.shape) ? "triangle" : "mesh";
}

} // namespace

void Origins::tell(Index index, const ObjectDefinition& object, NameId around, const Location& placed) const {
  ObjectOrigin origin;
  origin.kind = kind_of(object);
  const NameId name = object.name != kNoName ? object.name : around;
  if (name != kNoName) origin.name = names_.text(name);
  origin.file = sources_.name(object.where.file);
  origin.line = object.where.line;
  origin.column = object.where.column;
  origin.placed_file = sources_.name(placed.file);
  origin.placed_line = placed.line;
  options_.places_object(index, origin);
}

std::shared_ptr<const ObjectDefinition> named(const std::shared_ptr<const ObjectDefinition>& object,
                                              NameId name) {
  auto copy = std::make_shared<ObjectDefinition>(*object);
  copy->name = name;
  return copy;
}

} // namespace celltrace::pov
