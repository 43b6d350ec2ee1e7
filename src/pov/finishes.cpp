// Finishes and indices of refraction.
#include <cmath>

#include "pov/actions.hpp"

namespace celltrace::pov {

void ReflectionDefinition::set(const Vec3& only) {
  max = only;
}

void ReflectionDefinition::set(const Vec3& first, const Vec3& second) {
  min = first;
  max = second;
  has_min = true;
}

void ReflectionDefinition::apply(Finish& finish) const {
  // A single colour is the whole range, except that Fresnel's law needs one.
  finish.reflection_min = has_min || is_fresnel.value_or(false) ? min : max;
  finish.reflection_max = max;
  finish.reflection_falloff = falloff.value_or(finish.reflection_falloff);
  finish.reflection_exponent = exponent.value_or(finish.reflection_exponent);
  finish.reflection_metallic = metallic.value_or(finish.reflection_metallic);
  finish.reflection_fresnel = is_fresnel.value_or(finish.reflection_fresnel);
}

void set_diffuse(FinishDefinition& finish, bool is_albedo, double before, double behind) {
  finish.value.diffuse = before;
  finish.value.diffuse_behind = behind;
  finish.diffuse_is_albedo |= is_albedo; // as POV-Ray has it, also if it is said again without
}

/// The formulas are POV-Ray's.
void resolve_albedos(FinishDefinition& finish) {
  Finish& value = finish.value;
  if (finish.diffuse_is_albedo) {
    value.diffuse *= (value.brilliance + 1) / 2;
    value.diffuse_behind *= (value.brilliance + 1) / 2;
  }
  if (finish.phong_is_albedo) value.phong *= (value.phong_size + 1) / 2;
  if (finish.specular_is_albedo) {
    const double exponent = 1 / value.roughness;
    value.specular *= (exponent + 2) / (4 * (2 - std::exp2(-exponent / 2)));
  }
  finish.diffuse_is_albedo = finish.phong_is_albedo = finish.specular_is_albedo = false;
}

void set_reflection(Finish& finish, const Vec3& colour) {
  finish.reflection_min = colour;
  finish.reflection_max = colour;
}

double roughness(Session& session, double value, const Location& where) {
  // As in POV-Ray, where it becomes an exponent of 0.
  constexpr double kSameEverywhere = 1e30;
  if (value > 0) return value;
  session.diagnostics.warn_once(where, value == 0 ? "with a roughness of 0 the highlight is everywhere"
                                                  : "with a negative roughness the highlight is everywhere");
  return kSameEverywhere;
}

double exponent(Session& session, double value, const Location& where) {
  // The colour's power is its inverse.
  constexpr double kNothingBelowWhite = 1e-6;
  if (value != 0) return value;
  session.diagnostics.warn_once(where, "with an exponent of 0 nothing but white is reflected");
  return kNothingBelowWhite;
}

double ior(Session& session, double value, const Location& where) {
  if (value != 0) return value;
  session.diagnostics.warn_once(where, "an ior of 0 counts as 1: nothing is refracted");
  return 1;
}

std::optional<double> ior_of_finish(Session& session, double value, const Location& where) {
  if (value > 0) return value;
  session.diagnostics.warn_once(where, "an ior that is not above 0 is ignored in a finish");
  return std::nullopt;
}

} // namespace celltrace::pov
