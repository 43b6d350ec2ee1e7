#include "pov/session.hpp"

#include <cmath>

namespace celltrace::pov {

namespace {

void require_finite(const Session& session, const Quantity& quantity, const Location& where) {
  if (!quantity.is_finite()) session.fail(where, "this number is not finite");
}

/// Replaces infinities by `most`.
Quantity clamped(const Quantity& quantity, double most) {
  Quantity result = quantity;
  for (double& component : result.v)
    if (std::isinf(component)) component = std::copysign(most, component);
  return result;
}

} // namespace

double Session::any_number(const Quantity& quantity, const Location& where) const {
  if (!quantity.is_float()) fail(where, std::string("expected a float, found ") + kind_name(quantity));
  return quantity.v[0];
}

double Session::number(const Quantity& quantity, const Location& where) const {
  const double value = any_number(quantity, where);
  require_finite(*this, quantity, where);
  return value;
}

std::int64_t Session::whole(const Quantity& quantity, const Location& where) const {
  const double value = number(quantity, where);
  if (std::fabs(value) > 1e15) fail(where, "this number is too large");
  return static_cast<std::int64_t>(value);
}

Vec3 Session::vector(const Quantity& quantity, const Location& where) const {
  require_finite(*this, quantity, where);
  return quantity.vec3();
}

Pigment Session::colour(const Quantity& quantity, const Location& where) const {
  require_finite(*this, quantity, where);
  return quantity.pigment();
}

Vec3 Session::corner(const Quantity& quantity, const Location& where) const {
  constexpr double kFarthest = 1e5; // single precision resolves a hundredth there
  return vector(clamped(quantity, kFarthest), where);
}

Pigment Session::light(const Quantity& quantity, const Location& where) {
  constexpr double kBrightest = 1e20; // low enough for finite results of shading
  Quantity colour = clamped(quantity, kBrightest);
  if (colour.is_finite()) return colour.pigment();
  diagnostics.warn_once(where, "this colour is not a number: it counts as black");
  return {};
}

double Session::number_or_0(const Quantity& quantity, const Location& where) {
  const double value = any_number(quantity, where);
  if (std::isfinite(value)) return value;
  diagnostics.warn_once(where, "this number is not finite: it counts as 0");
  return 0;
}

Pigment Session::surface(const Quantity& quantity) const {
  const Pigment pigment = quantity.pigment();
  if (quantity.is_finite()) return pigment;
  if (!std::isfinite(pigment.filter) || !std::isfinite(pigment.transmit)) return {};
  Pigment finite = pigment;
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(finite.rgb[i])) finite.rgb[i] = 0;
  return finite;
}

void Session::count_text(std::size_t bytes, const Location& where) {
  text_bytes += bytes;
  tokens.spend(bytes / 64);
  if (text_bytes > options.limits.text_bytes)
    exceed(where, &ParseLimits::text_bytes, "the scene makes", "bytes of text");
}

} // namespace celltrace::pov
