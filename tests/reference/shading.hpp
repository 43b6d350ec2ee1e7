// POV-Ray 3.7's shading of one hit in double precision, to compare with. Directions are of unit length;
// `normal` is flipped toward the viewer; cosines are to the normal.
#pragma once

#include "celltrace/scene.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace celltrace::reference {

/// Luminance, as POV-Ray weighs it for its limits.
double grey(const Vec3& colour);

double opacity(const Pigment& pigment, double version);
/// What a surface lets through of light that crosses it.
Vec3 filter_colour(const Pigment& pigment);

/// Tint of metallic highlights and reflections.
Vec3 metallic_tint(double metallic, double cosine, const Vec3& pigment);

/// A light as it comes to a point if nothing is in the way.
struct Incoming {
  Vec3 to_light;   ///< of unit length
  double distance; ///< that shadows are looked for; not greater than 0: there are none
  Vec3 colour;
};
Incoming incoming(const Light& light, const Vec3& point);

/// What a light of `colour` in direction `to_light` adds to what is seen along `direction`. `is_lit_through`:
/// also from behind.
Vec3 lit(const Material& material, double version, const Vec3& colour, const Vec3& to_light,
         const Vec3& direction, const Vec3& normal, bool highlights, bool is_lit_through = false);

/// The factors that irid gives what is sent on of one light.
Vec3 film(const Finish& finish, const Vec3& wavelength, double cosine_of_light, double cosine_of_ray);

/// What is left of light of each colour after a distance in an interior.
Vec3 faded(const Interior& interior, double distance);

/// What a fog, without turbulence, lets through along a ray, and what it adds.
struct Fogged {
  Vec3 pass, add;
};
Fogged through(const Fog& fog, const Vec3& origin, const Vec3& direction, double distance);

/// The same of a rainbow; nothing if the ray does not look at it. Without jitter.
std::optional<Fogged> through(const Rainbow& rainbow, const Vec3& direction, double distance);

/// The reflectance of unpolarised light by Fresnel's equations; `ratio` is the index on this side over that
/// on the other; 1 beyond the critical angle.
double fresnel_reflectance(double ratio, double cosine);

/// Share of each colour that is mirrored; `ratio` matters to Fresnel's kind only.
Vec3 reflectivity(const Material& material, double cosine, double ratio);

Vec3 mirror(const Vec3& direction, const Vec3& normal);
/// By Snell's law; nothing beyond the critical angle.
std::optional<Vec3> refract(const Vec3& direction, const Vec3& normal, double ratio);

/// The interiors that a ray is inside of, outermost first.
using InteriorStack = std::vector<Index>;

/// Goes through the surface of `interior`; returns the index on this side over that on the other.
double cross_surface(InteriorStack& stack, Index interior, const std::vector<Interior>& interiors);

/// The ratio that a Fresnel mirror takes at the surface of `interior`: as cross_surface() on
/// entering and on leaving the only object; leaving one of several, as if entering the innermost from it.
double fresnel_ratio(const InteriorStack& stack, Index interior, const std::vector<Interior>& interiors);

/// One colour channel as the picture has it.
std::uint8_t encode(double value, GammaMode mode, double assumed_gamma);

} // namespace celltrace::reference
