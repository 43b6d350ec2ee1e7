// Values of numbers, vectors, transformations, arrays, functions and splines.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pov/session.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

/// Adds to a list of the scene's, which a loop must not make endless.
template <class T, class A, class U = T>
void append(Session& session, std::vector<T, A>& list, U&& element, const Location& where) {
  if (list.size() >= session.options.limits.list_entries)
    session.exceed(where, &ParseLimits::list_entries, "this list has", "entries");
  list.push_back(std::forward<U>(element));
}

template <class T> std::shared_ptr<T> copy_of(const T& definition) {
  return std::make_shared<T>(definition);
}

/// A copy of what a name stands for, which is a T.
template <class T> std::shared_ptr<T> copy_of_named(const Value& value) {
  return copy_of(*std::get<std::shared_ptr<const T>>(value));
}

/// Fails unless a vector has at least two components.
Quantity vector(Session& session, const Quantity& components, const Location& where);
/// Whether there is a component of this number (Names::Entry::component).
bool has_component(const Quantity& quantity, int which);
/// The component a word behind a dot names, as in v.x or c.red.
double component(Session& session, const Quantity& quantity, int which, const Location& where);
/// Adds one to a vector being read.
void append_component(Session& session, Quantity& vector, double component, const Location& where);
Transform scale(Session& session, const Quantity& factors, const Location& where);
Transform matrix(Session& session, const std::vector<ListEntry>& numbers, const Location& where);
/// A block transform { } while it is read.
struct WrittenTransform {
  Transform items;
  bool is_inverse = false;
};
Transform complete(Session& session, const WrittenTransform& written, const Location& where);

/// Warns of a division by zero, which gives an infinity.
Quantity divided(Session& session, const Quantity& a, const Quantity& b, const Location& where);

/// From sRGB to what the scene's colours mean, as its assumed_gamma, which must be known by now, says.
Quantity decoded(Session& session, const Quantity& colour, const Location& where);

// Arrays (arrays.cpp)

/// A deep copy: arrays are values.
std::shared_ptr<Array> copy(Session& session, const Array& array, const Location& where);
Array to_array(const std::vector<Quantity>& numbers);
std::size_t array_size(Session& session, double size, const Location& where);
/// An array of the given dimensions from `level` on, without values.
std::shared_ptr<Array> make_array(Session& session, const std::vector<std::size_t>& dimensions,
                                  std::size_t level, const Location& where);
/// Returns an array with the given elements, which must fit it.
std::shared_ptr<Array> filled_array(Session& session, const std::vector<std::size_t>& dimensions,
                                    const std::shared_ptr<Array>& elements, const Location& where);
int dimensions(const Array& array);
/// 0 of dimensions that it does not have.
double dimension_size(const Array& array, double dimension);

Quantity call(Session& session, const UserFunction& function, const std::vector<Value>& arguments,
              const Location& where);
/// The point, or 0; also writes the normal there, or 0, to a name.
Quantity trace(Session& session, const ObjectDefinition& object, const Quantity& origin,
               const Quantity& direction, std::optional<NameId> normal, const Location& where);
void add(Session& session, Spline& spline, double at, const Quantity& value, const Location& where);
/// Fails if the spline has no knots.
SplinePtr finished(Session& session, const std::shared_ptr<Spline>& spline, const Location& where);

} // namespace celltrace::pov
