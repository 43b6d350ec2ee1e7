// Values of numbers, vectors, transformations, functions and splines.
#include <algorithm>
#include <cmath>

#include "celltrace/error.hpp"
#include "pov/actions.hpp"
#include "pov/finite.hpp"
#include "pov/object_queries.hpp"

namespace celltrace::pov {

namespace {

constexpr std::size_t kMostKnots = 20000; // of a spline

} // namespace

double positive(Session& session, double value, const char* what, const Location& where) {
  if (!(value > 0)) session.fail(where, std::string(what) + " must be greater than 0");
  return value;
}

bool has_component(const Quantity& quantity, int which) {
  return which == kGreyComponent ? quantity.count >= 3 : which < quantity.count;
}

double component(Session& session, const Quantity& quantity, int which, const Location& where) {
  if (which == kGreyComponent) {
    if (!has_component(quantity, which)) session.fail(where, "only a colour has a grey value");
    return quantity.grey();
  }
  if (!has_component(quantity, which))
    session.fail(where, std::string(kind_name(quantity)) + " of " + std::to_string(quantity.count) +
                            " components has no such component");
  return quantity.v[static_cast<std::size_t>(which)];
}

void append_component(Session& session, Quantity& vector, double component, const Location& where) {
  if (vector.count == 5) session.fail(where, "a vector has at most five components");
  vector.v[static_cast<std::size_t>(vector.count++)] = component;
}

Quantity vector(Session& session, const Quantity& components, const Location& where) {
  if (components.is_float()) session.fail(where, "a vector has at least two components");
  return components;
}

Transform scale(Session& session, const Quantity& factors, const Location& where) {
  const Vec3 v = factors.vec3();
  if (v.x == 0 || v.y == 0 || v.z == 0)
    session.diagnostics.warn_once(where, "a scale by 0 counts as one by 1");
  return Transform::scale(v);
}

Quantity divided(Session& session, const Quantity& a, const Quantity& b, const Location& where) {
  const Quantity divisor = b.promoted(a.count);
  const auto* end = divisor.v.data() + divisor.count;
  if (std::find(divisor.v.data(), end, 0.0) != end) session.diagnostics.warn_once(where, "division by zero");
  return a / b;
}

namespace {

/// POV-Ray makes a scale by 1 of a column that is zero, as exporters write it for flat parts.
void replace_zero_columns(double (&values)[12], Session& session, const Location& where) {
  constexpr double kZero = 1e-10;
  for (std::size_t column = 0; column < 3; ++column) {
    const auto is_zero = [&](std::size_t row) { return std::fabs(values[3 * row + column]) < kZero; };
    if (!is_zero(0) || !is_zero(1) || !is_zero(2)) continue;
    session.diagnostics.warn_once(where, "a matrix with a column of zeros: it counts as a scale by 1");
    values[3 * column + column] = 1;
  }
}

} // namespace

Transform matrix(Session& session, const std::vector<ListEntry>& numbers, const Location& where) {
  if (numbers.size() != 12)
    session.fail(where, "a matrix has 12 numbers, not " + std::to_string(numbers.size()));
  double values[12];
  for (std::size_t i = 0; i < 12; ++i) {
    const ListEntry& entry = numbers[i];
    if (!entry.is_float) session.fail(where, "expected a float, found a vector");
    values[i] = entry.v.x;
  }
  replace_zero_columns(values, session, where);
  return Transform::matrix(values);
}

Transform complete(Session& session, const WrittenTransform& written, const Location& where) {
  if (!written.is_inverse || !is_finite(written.items)) return written.items;
  try {
    return written.items.inverse();
  } catch (const InputError&) {
    session.fail(where, "this transformation is singular: it has no inverse");
  }
}

Quantity decoded(Session& session, const Quantity& colour, const Location& where) {
  if (!session.builder.gamma_is_given())
    session.fail(where, "colours in sRGB need an 'assumed_gamma' in front of them");
  Quantity result = colour;
  for (std::size_t i = 0; i < 3; ++i)
    result.v[i] = session.builder.from_srgb(colour.v[i]);
  return result;
}

Quantity call(Session& session, const UserFunction& function, const std::vector<Value>& arguments,
              const Location& where) {
  check_argument_count(session, function, arguments.size(), where);
  double numbers[kMostParameters];
  std::transform(arguments.begin(), arguments.end(), numbers, [&](const Value& argument) {
    const auto* quantity = std::get_if<Quantity>(&argument);
    if (!quantity)
      session.fail(where, std::string("the arguments of a function are floats, not ") + kind_name(argument));
    return session.any_number(*quantity, where);
  });
  return call_function(session, function, numbers, arguments.size(), where);
}

Quantity trace(Session& session, const ObjectDefinition& object, const Quantity& origin,
               const Quantity& direction, std::optional<NameId> normal, const Location& where) {
  const ObjectHit hit =
      trace(session, object, session.vector(origin, where), session.vector(direction, where), where)
          .value_or(ObjectHit{Vec3(0), Vec3(0)});
  if (normal) session.symbols.declare(*normal, Quantity::vector(hit.normal));
  return Quantity::vector(hit.point);
}

void add(Session& session, Spline& spline, double at, const Quantity& value, const Location& where) {
  if (spline.size() >= kMostKnots) session.fail(where, "this spline is too long");
  spline.add(at, value);
}

SplinePtr finished(Session& session, const std::shared_ptr<Spline>& spline, const Location& where) {
  if (spline->size() == 0) session.fail(where, "this spline has no vectors");
  return spline;
}

} // namespace celltrace::pov
