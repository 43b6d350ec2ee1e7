#include "pov/session.hpp"

#include <cmath>

namespace celltrace::pov {

namespace {

void require_finite(const Session& session, const Quantity& quantity, const Location& where) {
  if (!quantity.is_finite()) session.fail(where, "this number is not finite");
}

} // namespace

double Session::number(const Quantity& quantity, const Location& where) const {
  if (!quantity.is_float()) fail(where, std::string("expected a float, found ") + kind_name(quantity));
  require_finite(*this, quantity, where);
  return quantity.v[0];
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

void Session::count_text(std::size_t bytes, const Location& where) {
  text_bytes += bytes;
  tokens.spend(bytes / 64);
  if (text_bytes > options.limits.text_bytes)
    exceed(where, &ParseLimits::text_bytes, "the scene makes", "bytes of text");
}

} // namespace celltrace::pov
