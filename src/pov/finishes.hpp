// Finishes and indices of refraction.
#pragma once

#include <optional>

#include "pov/session.hpp"
#include "pov/texture.hpp"

namespace celltrace::pov {

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
void set_diffuse(FinishDefinition& finish, bool is_albedo, double before, double behind);
/// Makes of albedos, the shares of light that are sent on to all sides together, what the formulas take.
void settle_albedos(FinishDefinition& finish);
void set_reflection(Finish& finish, const Vec3& colour);
double roughness(Session& session, double value, const Location& where);
double exponent(Session& session, double value, const Location& where);
/// 1 for 0, as in POV-Ray; negative ones are taken.
double ior(Session& session, double value, const Location& where);
/// Nothing unless it is positive.
std::optional<double> ior_of_finish(Session& session, double value, const Location& where);

} // namespace celltrace::pov
