#include "reference/shading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace celltrace::reference {

double grey(const Vec3& colour) {
  return 0.297 * colour.r + 0.589 * colour.g + 0.114 * colour.b;
}

double opacity(const Pigment& p, double version) {
  const double brightest = version < 3.7 ? std::max({p.rgb.r, p.rgb.g, p.rgb.b}) : 1;
  return 1 - (p.filter * brightest + p.transmit);
}

Vec3 filter_colour(const Pigment& p) {
  return p.rgb * p.filter + p.transmit;
}

Vec3 metallic_tint(double metallic, double cosine, const Vec3& pigment) {
  const double x = std::acos(std::clamp(cosine, 0.0, 1.0)) / (std::numbers::pi / 2);
  const double f = std::clamp(0.014567225 / ((x - 1.12) * (x - 1.12)) - 0.011612903, 0.0, 1.0);
  return 1.0 + metallic * (1 - f) * (pigment - 1.0);
}

namespace {

double smooth_step(double low, double high, double x) {
  if (x >= high) return 1;
  if (x <= low) return 0;
  const double p = (x - low) / (high - low);
  return (3 - 2 * p) * p * p;
}

double in_cone(const Light& light, double cosine) {
  const auto cos_of = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180); };
  if (cosine <= 0) return 0;
  return std::pow(cosine, light.tightness) * smooth_step(cos_of(light.falloff), cos_of(light.radius), cosine);
}

/// At `aside` of the axis.
double in_cylinder(const Light& light, double depth, double aside) {
  if (depth <= 0 || aside >= light.falloff) return 0;
  const double rest = 1 - aside / light.falloff;
  const double edge = light.radius > 0 ? smooth_step(0, 1 - light.radius / light.falloff, rest) : 1;
  return std::pow(rest, light.tightness) * edge;
}

Incoming faded(const Light& light, Incoming in) {
  if (light.fade_distance == 0 || light.fade_power <= 0) return in;
  const double power = std::pow(in.distance / light.fade_distance, light.fade_power);
  in.colour *= std::isnan(power) ? 0 : 2 / (1 + power); // of a negative distance it may be none
  return in;
}

} // namespace

Incoming incoming(const Light& light, const Vec3& point) {
  const Vec3 way = light.location - point;
  Incoming in = {glm::normalize(way), glm::length(way), light.colour};
  if (light.kind == Light::Kind::point && !light.parallel) return faded(light, in);
  if (light.point_at == light.location) return {in.to_light, in.distance, Vec3(0)};
  const Vec3 axis = glm::normalize(light.point_at - light.location);
  const double depth = -glm::dot(way, axis);
  if (light.parallel || light.kind == Light::Kind::cylinder) {
    in.to_light = -axis;
    in.distance = depth;
  }
  if (light.kind == Light::Kind::spotlight) in.colour *= in_cone(light, -glm::dot(in.to_light, axis));
  if (light.kind == Light::Kind::cylinder)
    in.colour *= in_cylinder(light, depth, glm::length(-way - depth * axis));
  return faded(light, in);
}

Vec3 lit(const Material& material, double version, const Vec3& colour, const Vec3& to_light,
         const Vec3& direction, const Vec3& normal, bool highlights, bool is_lit_through) {
  const Finish& f = material.finish;
  const Vec3& pigment = material.pigment.rgb;
  const double cosine = glm::dot(normal, to_light);
  const bool is_behind = cosine < 1e-10 && !is_lit_through;
  const double diffuse = is_behind ? f.diffuse_behind : f.diffuse;
  Vec3 sum = pigment * colour * diffuse * opacity(material.pigment, version) *
             std::pow(std::abs(cosine), f.brilliance);
  if (!highlights || is_behind) return sum;

  double strength = 0;
  const double mirrored = glm::dot(mirror(direction, normal), to_light);
  if (f.phong > 0 && mirrored > 0 && (f.phong_size < 60 || mirrored > 0.0008))
    strength += f.phong * std::pow(mirrored, f.phong_size);
  const double half = glm::dot(glm::normalize(to_light - direction), normal);
  if (f.specular > 0 && half > 0) strength += f.specular * std::pow(half, 1 / f.roughness);
  return sum + colour * strength * metallic_tint(f.metallic, cosine, pigment);
}

Vec3 film(const Finish& finish, const Vec3& wavelength, double cosine_of_light, double cosine_of_ray) {
  const double way = finish.irid_thickness * (cosine_of_light + cosine_of_ray);
  Vec3 factors(1);
  for (int i = 0; i < 3; ++i)
    factors[i] += finish.irid * std::cos(2 * std::numbers::pi * way / wavelength[i]);
  return factors;
}

Vec3 faded(const Interior& interior, double distance) {
  if (interior.fade_distance == 0) return Vec3(1);
  const double way = distance / interior.fade_distance;
  if (interior.fade_power >= 1000) return glm::exp((interior.fade_colour - 1.0) * way);
  const double share = 1 / (1 + std::pow(way, interior.fade_power));
  return interior.fade_colour + (1.0 - interior.fade_colour) * share;
}

Fogged through(const Fog& fog, const Vec3& origin, const Vec3& direction, double distance) {
  double density = 1;
  if (fog.is_ground) {
    // The integral of the density from the offset up: its own height below, an arc tangent above.
    const auto filled = [](double y) { return y <= 0 ? y : std::atan(y); };
    const double start = (glm::dot(origin, fog.up) - fog.offset) / fog.altitude;
    const double end = start + glm::dot(direction, fog.up) * distance / fog.altitude;
    if (std::abs(end - start) > 1e-9)
      density = (filled(end) - filled(start)) / (end - start);
    else
      density = start <= 0 ? 1 : 1 / (1 + start * start);
  }
  const double pass = std::max(std::exp(-density * distance / fog.distance), fog.transmit);
  return {((1 - fog.filter) + fog.filter * fog.colour) * pass, fog.colour * (1 - pass)};
}

std::optional<Fogged> through(const Rainbow& rainbow, const Vec3& direction, double distance) {
  const auto degrees = [](double cosine) {
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
  };
  const Vec3 axis = glm::normalize(rainbow.direction);
  const double across = (degrees(glm::dot(axis, direction)) - rainbow.angle) / rainbow.width + 0.5;
  const Vec3 up = glm::normalize(rainbow.up - glm::dot(rainbow.up, axis) * axis);
  const double along = degrees(glm::dot(up, glm::normalize(direction - glm::dot(direction, axis) * axis)));
  if (across < 0 || across > 1 || along > rainbow.arc_angle / 2 || glm::dot(axis, direction) < 0)
    return std::nullopt;
  const auto& colours = rainbow.colours;
  const auto after = std::find_if(colours.begin(), colours.end(),
                                  [&](const Rainbow::Colour& colour) { return across <= colour.position; });
  Rainbow::Colour colour = after == colours.end() ? colours.back() : *after;
  if (after != colours.end() && after != colours.begin()) {
    const Rainbow::Colour& before = *(after - 1);
    const double t = (across - before.position) / (colour.position - before.position);
    colour.rgb = glm::mix(before.rgb, colour.rgb, t);
    colour.filter = glm::mix(before.filter, colour.filter, t);
    colour.transmit = glm::mix(before.transmit, colour.transmit, t);
  }
  const double strength = 1 - smooth_step(rainbow.falloff_angle / 2, rainbow.arc_angle / 2, along);
  const double pass = std::max(std::exp(-distance / rainbow.distance), 1 - strength * (1 - colour.transmit));
  return Fogged{(1.0 + colour.filter * (1 - pass) * (colour.rgb - 1.0)) * pass, colour.rgb * (1 - pass)};
}

double fresnel_reflectance(double ratio, double cosine) {
  const double sine = ratio * std::sqrt(1 - cosine * cosine);
  if (sine >= 1) return 1;
  const double other = std::sqrt(1 - sine * sine);
  const double across = (ratio * cosine - other) / (ratio * cosine + other);
  const double along = (cosine - ratio * other) / (cosine + ratio * other);
  return 0.5 * (across * across + along * along);
}

Vec3 reflectivity(const Material& material, double cosine, double ratio) {
  const Finish& f = material.finish;
  const double share =
      f.reflection_fresnel ? fresnel_reflectance(ratio, cosine) : std::pow(1 - cosine, f.reflection_falloff);
  const Vec3 plain = f.reflection_min + (f.reflection_max - f.reflection_min) * share;
  return plain * metallic_tint(f.reflection_metallic, cosine, material.pigment.rgb);
}

Vec3 mirror(const Vec3& direction, const Vec3& normal) {
  return glm::normalize(direction - 2 * glm::dot(direction, normal) * normal);
}

std::optional<Vec3> refract(const Vec3& direction, const Vec3& normal, double ratio) {
  const double cosine = -glm::dot(direction, normal);
  const Vec3 tangent = (direction + normal * cosine) * ratio;
  const double square = 1 - glm::dot(tangent, tangent);
  if (square < 0) return std::nullopt;
  return glm::normalize(tangent - normal * std::sqrt(square));
}

double cross_surface(InteriorStack& stack, Index interior, const std::vector<Interior>& interiors) {
  const auto innermost = [&] { return stack.empty() ? 1.0 : interiors[stack.back()].ior; };
  const auto found = std::find(stack.begin(), stack.end(), interior);
  const double from = innermost();
  if (found == stack.end()) {
    stack.push_back(interior);
    return from / innermost();
  }
  const bool was_innermost = found + 1 == stack.end();
  stack.erase(found);
  return was_innermost ? from / innermost() : 1;
}

double fresnel_ratio(const InteriorStack& stack, Index interior, const std::vector<Interior>& interiors) {
  const bool leaves = std::find(stack.begin(), stack.end(), interior) != stack.end();
  if (leaves && stack.size() > 1) return interiors[interior].ior / interiors[stack.back()].ior;
  InteriorStack after = stack;
  return cross_surface(after, interior, interiors);
}

std::uint8_t encode(double value, GammaMode mode, double assumed_gamma) {
  double c = std::clamp(value, 0.0, 1.0);
  if (mode == GammaMode::assumed) {
    c = std::pow(c, assumed_gamma);
    c = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  }
  return static_cast<std::uint8_t>(std::floor(c * 255 + 0.5));
}

} // namespace celltrace::reference
