// What the grammar's rules do, where it takes more than a line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pov/mesh.hpp"
#include "pov/object.hpp"
#include "pov/session.hpp"
#include "pov/shapes.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

/// Adds to a list of the scene's, which a loop must not make endless.
template <class T, class U = T>
void append(Session& session, std::vector<T>& list, U&& element, const Location& where) {
  if (list.size() >= session.options.limits.list_entries) session.fail(where, "this list is too long");
  list.push_back(std::forward<U>(element));
}

// ---- Numbers ----

/// The component a word behind a dot names, as in v.x or c.red.
double component(Session& session, const Quantity& quantity, int which, const Location& where);
/// Adds one to a vector being read.
void append_component(Session& session, Quantity& vector, double component, const Location& where);
Transform matrix(Session& session, const std::vector<ListEntry>& numbers, const Location& where);
Transform inverse(Session& session, const Transform& transform, const Location& where);

// ---- Arrays (arrays.cpp) ----

/// A deep copy: arrays are values.
std::shared_ptr<Array> copy(Session& session, const Array& array, const Location& where);
Array to_array(const std::vector<Quantity>& numbers);
std::size_t array_size(Session& session, double size, const Location& where);
/// An array of the given dimensions from `level` on, without values.
std::shared_ptr<Array> make_array(Session& session, const std::vector<std::size_t>& dimensions,
                                  std::size_t level, const Location& where);
/// The same with the given elements, which must fit it.
std::shared_ptr<Array> filled_array(Session& session, const std::vector<std::size_t>& dimensions,
                                    const std::shared_ptr<Array>& elements, const Location& where);
int dimensions(const Array& array);
double dimension_size(Session& session, const Array& array, double dimension, const Location& where);

// ---- Scene ----

void set_assumed_gamma(Session& session, double gamma, const Location& where);
void set_max_trace_level(Session& session, double level, const Location& where);

// ---- Textures ----

/// The inside of reflection { }. What it does not say stays as the finish has it.
struct ReflectionDefinition {
  Vec3 min{0, 0, 0};
  Vec3 max{0, 0, 0};
  bool has_min = false;
  std::optional<double> falloff, exponent, metallic;
  std::optional<bool> is_fresnel;

  void set(const Vec3& only);
  void set(const Vec3& first, const Vec3& second);
  void apply(Finish& finish) const;
};

/// The old form, one colour.
void set_reflection(Finish& finish, const Vec3& colour);
double roughness(Session& session, double value, const Location& where);
double exponent(Session& session, double value, const Location& where);
double ior(Session& session, double value, const Location& where);

// ---- Objects ----

/// Counts `part` as one that is inside `object`.
void nest(Session& session, ObjectDefinition& object, const ObjectDefinition& part, const Location& where);
/// The texture that an object's pigment or finish changes.
const TexturePtr& texture_of(Session& session, const ObjectDefinition& object);
std::shared_ptr<ObjectDefinition> shape(Session& session, const WrittenShape& written);
std::shared_ptr<ObjectDefinition> csg(Session& session, Compound compound, const Location& where);
/// An object that other ones can be limited by.
ObjectPtr limiting(Session& session, const ObjectPtr& object, const Location& where);
/// Adds to one of the object's own lists of limits.
void limit(Session& session, ObjectDefinition& object, std::vector<Limit>& list,
           const std::vector<Limit>& added, const Location& where);
void apply(const std::shared_ptr<const MaterialDefinition>& material, ObjectDefinition& object,
           const Location& where);

// ---- Meshes ----

std::shared_ptr<ObjectDefinition>
lone_triangle(Session& session, std::shared_ptr<TriangleDefinition> triangle, const Location& where);
void add_triangle(Session& session, MeshBuilder& builder, const TriangleDefinition& triangle,
                  const Location& where);
std::shared_ptr<ObjectDefinition> mesh(Session& session, MeshBuilder& builder, const Location& where);
std::shared_ptr<ObjectDefinition> mesh2(Session& session, Mesh2Definition& definition, const Location& where);
/// Checks the count that leads a list of mesh2.
void check_count(Session& session, double announced, std::size_t found, const Location& where);
/// The list without the count that leads it, which must be right.
std::vector<ListEntry> counted(Session& session, std::vector<ListEntry>& list, const Location& where);
/// The same for face_indices, where only the vectors count.
std::vector<ListEntry> faces(Session& session, std::vector<ListEntry>& list, const Location& where);
/// The same where every entry must be finite.
std::vector<ListEntry> vectors(Session& session, std::vector<ListEntry>& list, const Location& where);

// ---- What is not supported ----

std::string quoted(Session& session, NameId name);
UnsupportedPtr make_unsupported(const std::string& what, const Location& where);
/// Passes over the rest of the block too.
UnsupportedPtr unsupported_rest(Session& session, const std::string& what, const Location& where);
/// Null for zero.
UnsupportedPtr unless_zero(const std::string& what, double value, const Location& where);
ObjectPtr unsupported_object(const std::string& what, const Location& where);
[[noreturn]] void refuse(Session& session, const std::string& what, const Location& where);

} // namespace celltrace::pov
