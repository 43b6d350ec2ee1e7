// Finishes and indices of refraction.
#pragma once

#include <optional>

#include "pov/session.hpp"
#include "pov/texture.hpp"

namespace celltrace::pov {

/// The contents of reflection { }. Properties that it does not set stay those of the finish.
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

void set_diffuse(FinishDefinition& finish, bool is_albedo, double before, double behind);
/// Turns albedos, which are shares of light reflected to all sides together, into the numbers that the
/// formulas take.
void resolve_albedos(FinishDefinition& finish);
/// Sets reflection by the old form, which is one colour.
void set_reflection(Finish& finish, const Vec3& colour);
double roughness(Session& session, double value, const Location& where);
double exponent(Session& session, double value, const Location& where);
/// Returns an index of refraction: 1 for 0, as in POV-Ray. Negative values stay.
double ior(Session& session, double value, const Location& where);
/// Returns the index of refraction of a finish; nothing unless it is positive.
std::optional<double> ior_of_finish(Session& session, double value, const Location& where);

} // namespace celltrace::pov
