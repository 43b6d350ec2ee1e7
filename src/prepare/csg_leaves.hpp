// Visits an object or, if it is a CSG, the CSG's leaves.
#pragma once

#include "celltrace/scene.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

namespace celltrace {

/// The place of a leaf of an object's CSG. `inverse` is true if the object consists of the leaf's outside.
struct LeafPlace {
  Transform transform;
  bool inverse = false;

  LeafPlace within(const Object& object) const {
    return {object.transform.then(transform), inverse != object.inverse};
  }
  LeafPlace part(const Csg& csg, std::size_t number) const {
    return {transform, inverse != (csg.operation == Csg::Operation::difference && number > 0)};
  }
};

/// Returns whether `predicate(leaf, inverse)` is true for an object that is no CSG, or for any leaf of a CSG;
/// `inverse` is as in LeafPlace. Finds rare properties without computing places.
template <class Ask> bool has_leaf(const Object& object, bool inverse, const Ask& predicate) {
  const bool is_inverse = inverse != object.inverse;
  const auto* const csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape);
  if (csg == nullptr) return predicate(object, is_inverse);
  const bool takes_away = (*csg)->operation == Csg::Operation::difference;
  for (std::size_t i = 0; i < (*csg)->parts.size(); ++i)
    if (has_leaf((*csg)->parts[i], is_inverse != (takes_away && i > 0), predicate)) return true;
  return false;
}

/// Calls `visit(leaf, place)` for an object that is no CSG, or for all leaves of a CSG in their order. Skips
/// objects that clip.
template <class Visit> void visit_leaves(const Object& object, const LeafPlace& around, Visit& visit) {
  const LeafPlace place = around.within(object);
  const auto* const csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape);
  if (csg == nullptr) return visit(object, place);
  for (std::size_t i = 0; i < (*csg)->parts.size(); ++i)
    visit_leaves((*csg)->parts[i], place.part(**csg, i), visit);
}

/// Returns the object with each leaf replaced for which `change(leaf, place)` returns a new leaf; nothing if
/// there is no new leaf.
template <class Change>
std::optional<Object> with_leaves_changed(const Object& object, const LeafPlace& around, Change& change) {
  const LeafPlace place = around.within(object);
  const auto* const csg = std::get_if<std::shared_ptr<const Csg>>(&object.shape);
  if (csg == nullptr) return change(object, place);
  std::shared_ptr<Csg> copy;
  for (std::size_t i = 0; i < (*csg)->parts.size(); ++i) {
    std::optional<Object> part = with_leaves_changed((*csg)->parts[i], place.part(**csg, i), change);
    if (!part) continue;
    if (!copy) copy = std::make_shared<Csg>(**csg);
    copy->parts[i] = *std::move(part);
  }
  if (!copy) return {};
  Object whole = object;
  whole.shape = std::move(copy);
  return whole;
}

} // namespace celltrace
