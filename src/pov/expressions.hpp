// Values of numbers, vectors, transformations, arrays, functions and splines.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pov/session.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

/// Adds to a list of the scene, whose length is limited, since a loop may add to it.
template <class T, class A, class U = T>
void append(Session& session, std::vector<T, A>& list, U&& element, const Location& where) {
  if (list.size() >= session.options.limits.list_entries)
    session.exceed(where, &ParseLimits::list_entries, "this list has", "entries");
  list.push_back(std::forward<U>(element));
}

template <class T> std::shared_ptr<T> copy_of(const T& definition) {
  return std::make_shared<T>(definition);
}

/// Returns a copy of the T that a name stands for.
template <class T> std::shared_ptr<T> copy_of_named(const Value& value) {
  return copy_of(*std::get<std::shared_ptr<const T>>(value));
}

/// Returns the vector. Fails unless it has at least two components.
Quantity vector(Session& session, const Quantity& components, const Location& where);
/// Returns whether there is a component with this number (Names::Entry::component).
bool has_component(const Quantity& quantity, int which);
/// Returns the component that a word behind a dot names, as in v.x or c.red.
double component(Session& session, const Quantity& quantity, int which, const Location& where);
/// Adds a component to a vector that is being read.
void append_component(Session& session, Quantity& vector, double component, const Location& where);
Transform scale(Session& session, const Quantity& factors, const Location& where);
Transform matrix(Session& session, const std::vector<ListEntry>& numbers, const Location& where);
/// A block transform { } that is being read.
struct WrittenTransform {
  Transform items;
  bool is_inverse = false;
};
Transform complete(Session& session, const WrittenTransform& written, const Location& where);

/// Returns the quotient. Warns of a division by zero, which gives an infinity.
Quantity divided(Session& session, const Quantity& a, const Quantity& b, const Location& where);

/// Converts a colour from sRGB to the space of the scene's colours, which assumed_gamma defines and which
/// must be known by now.
Quantity decoded(Session& session, const Quantity& colour, const Location& where);

// Arrays (arrays.cpp)

/// Returns a deep copy: arrays are values.
std::shared_ptr<Array> copy(Session& session, const Array& array, const Location& where);
Array to_array(const std::vector<Quantity>& numbers);
std::size_t array_size(Session& session, double size, const Location& where);
/// Returns an array with the given dimensions from `level` on, without values.
std::shared_ptr<Array> make_array(Session& session, const std::vector<std::size_t>& dimensions,
                                  std::size_t level, const Location& where);
/// Returns an array with the given elements. Fails if they do not fit it.
std::shared_ptr<Array> filled_array(Session& session, const std::vector<std::size_t>& dimensions,
                                    const std::shared_ptr<Array>& elements, const Location& where);
int dimensions(const Array& array);
/// Returns the size of a dimension; 0 if the array does not have it.
double dimension_size(const Array& array, double dimension);

Quantity call(Session& session, const UserFunction& function, const std::vector<Value>& arguments,
              const Location& where);
/// Returns the point where a ray hits an object, or 0, and writes the normal there, or 0, to a name.
Quantity trace(Session& session, const ObjectDefinition& object, const Quantity& origin,
               const Quantity& direction, std::optional<NameId> normal, const Location& where);
void add(Session& session, Spline& spline, double at, const Quantity& value, const Location& where);
/// Returns the finished spline. Fails if it has no knots.
SplinePtr finished(Session& session, const std::shared_ptr<Spline>& spline, const Location& where);

} // namespace celltrace::pov
