#include "scene_image/surface_records.hpp"

#include "kernel/lights/list.hpp"
#include "records/offsets.hpp"
#include "scene_image/pattern_space.hpp"
#include "scene_image/record_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

/// Returns the opacity of a colour; the rule changed with language version 3.7.
double opacity(const Pigment& p, double version) {
  if (version < 3.7) return 1 - (p.filter * std::max({p.rgb.x, p.rgb.y, p.rgb.z}) + p.transmit);
  return 1 - p.filter - p.transmit;
}

std::uint32_t kind_of(Light::Kind kind) {
  switch (kind) {
  case Light::Kind::point:
    return kLightKind<PointLight>;
  case Light::Kind::spotlight:
    return kLightKind<SpotLight>;
  case Light::Kind::cylinder:
    return kLightKind<CylinderLight>;
  }
  return kLightKind<PointLight>;
}

void set_axis(const Light& light, LightRecord& r) {
  const Vec3 axis = light.point_at - light.location;
  const double length = glm::length(axis);
  if (length > 0)
    copy(axis / length, r.axis);
  else
    copy(Vec3(0), r.colour);
}

/// Sets the edge of a beam, between two distances from its axis. As in POV-Ray, an edge that would end before
/// it begins is a step at its beginning.
void set_edge(double inner, double outer, LightRecord& r) {
  constexpr double kStep = 1e30;
  r.inner = static_cast<float>(inner);
  r.inverse_edge = static_cast<float>(outer > inner ? std::min(1 / (outer - inner), kStep) : kStep);
}

/// Returns 1 minus the cosine of an angle in degrees.
double versine(double angle) {
  const double sine = std::sin(angle * std::numbers::pi / 360);
  return 2 * sine * sine;
}

/// Sets the width of a cylindrical light. As in POV-Ray, a light without a radius has no edge.
void set_width(const Light& light, LightRecord& r) {
  constexpr double kNoWidth = 1e-30;
  const double width = std::max(light.falloff, kNoWidth);
  r.inverse_width = static_cast<float>(1 / width);
  set_edge(light.radius > 0 ? light.radius / width : 1, 1, r);
}

float inverse_of_steps(int places) {
  return places > 1 ? 1.0f / static_cast<float>(places - 1) : 0;
}

/// Sets the area of a light. As in POV-Ray, an area of one row and one column is a point in the middle, and
/// an area that turns to surfaces is round.
void set_area(const LightArea& area, LightRecord& r) {
  if (area.columns == 1 && area.rows == 1) return;
  copy(area.across, r.across);
  copy(area.along, r.along);
  r.columns = static_cast<std::uint32_t>(area.columns);
  r.rows = static_cast<std::uint32_t>(area.rows);
  r.inverse_columns = inverse_of_steps(area.columns);
  r.inverse_rows = inverse_of_steps(area.rows);
  r.adaptive = static_cast<std::uint32_t>(area.adaptive);
  r.kind_and_flags |= light_flag::area;
  if (area.jitter) r.kind_and_flags |= light_flag::jitter;
  if (area.circular || area.orient) r.kind_and_flags |= light_flag::circular;
  if (area.orient) r.kind_and_flags |= light_flag::orient;
}

/// Returns the flags of features that the kernel needs because of a record's numbers.
std::uint32_t numeric_flags(const MaterialRecord& r) {
  const auto any = [](const float(&v)[3]) { return v[0] != 0 || v[1] != 0 || v[2] != 0; };
  std::uint32_t flags = 0;
  const auto set = [&](bool is_needed, std::uint32_t flag) { flags |= is_needed ? flag : 0; };
  set(r.brilliance != 1, material_flag::brilliance);
  set(r.phong > 0, material_flag::phong);
  set(r.specular > 0, material_flag::specular);
  set(r.metallic != 0, material_flag::metallic);
  set(any(r.reflection_min) || any(r.reflection_max), material_flag::reflects);
  set(r.reflection_metallic != 0, material_flag::metallic_mirror);
  set(r.reflection_falloff != 1, material_flag::falloff);
  set(r.inverse_reflection_exponent != 1, material_flag::reflection_exponent);
  set(r.filter != 0 || r.transmit != 0, material_flag::transmits);
  return flags;
}

} // namespace

LightRecord make_record(const Light& light) {
  LightRecord r{};
  copy(light.location, r.location);
  copy(light.colour, r.colour);
  r.kind_and_flags = kind_of(light.kind);
  if (light.shadowless) r.kind_and_flags |= light_flag::shadowless;
  if (light.projected_through) r.kind_and_flags |= light_flag::projected;
  if (light.is_dimmed_by_fog) r.kind_and_flags |= light_flag::dimmed;
  bool has_axis = light.parallel;
  bool parallel = light.parallel;
  Lights::dispatch(kind_of(light.kind), [&](auto kind) {
    has_axis |= decltype(kind)::kIsBeam;
    parallel |= decltype(kind)::kIsParallel;
  });
  if (parallel) r.kind_and_flags |= light_flag::parallel;
  if (has_axis) set_axis(light, r);
  if (light.kind == Light::Kind::spotlight) set_edge(versine(light.radius), versine(light.falloff), r);
  if (light.kind == Light::Kind::cylinder) set_width(light, r);
  r.tightness = static_cast<float>(light.tightness);
  if (light.fade_distance != 0 && light.fade_power > 0) {
    r.kind_and_flags |= light_flag::fades;
    r.inverse_fade_distance = static_cast<float>(1 / light.fade_distance);
    r.fade_power = static_cast<float>(light.fade_power);
    const bool is_whole = light.fade_power == std::floor(light.fade_power);
    r.fade_behind = !is_whole ? 1e30f : std::fmod(light.fade_power, 2) == 0 ? 1.0f : -1.0f;
  }
  if (light.area) set_area(*light.area, r);
  r.axis_length = static_cast<float>(glm::distance(light.location, light.point_at));
  return r;
}

MaterialRecord make_record(const Material& material, const Scene& scene) {
  const Pigment& p = material.pigment;
  const Finish& f = material.finish;
  MaterialRecord r{};
  copy(p.rgb, r.pigment);
  r.filter = static_cast<float>(p.filter);
  r.transmit = static_cast<float>(p.transmit);
  r.opacity = static_cast<float>(opacity(p, scene.version));
  copy(f.ambient * scene.ambient_light + f.emission, r.ambient);
  r.diffuse = static_cast<float>(std::max(f.diffuse, 0.0)); // at least 0, as in POV-Ray
  r.diffuse_behind = static_cast<float>(std::max(f.diffuse_behind, 0.0));
  r.brilliance = static_cast<float>(f.brilliance);
  r.phong = static_cast<float>(f.phong);
  r.phong_size = static_cast<float>(f.phong_size);
  r.specular = static_cast<float>(f.specular);
  r.inverse_roughness = static_cast<float>(f.roughness > 0 ? 1 / f.roughness : 1e6);
  r.metallic = static_cast<float>(f.metallic);
  copy(f.reflection_min, r.reflection_min);
  copy(f.reflection_max, r.reflection_max);
  r.reflection_falloff = static_cast<float>(f.reflection_falloff);
  r.reflection_metallic = static_cast<float>(f.reflection_metallic);
  r.inverse_reflection_exponent =
      static_cast<float>(f.reflection_exponent != 0 ? 1 / f.reflection_exponent : 1);
  r.flags = (f.reflection_fresnel ? material_flag::fresnel : 0) |
            (f.conserve_energy ? material_flag::conserve_energy : 0) |
            (scene.version < 3.7 ? material_flag::old_opacity : 0) | numeric_flags(r);
  r.pattern = r.normal = r.below = r.finish = r.inside = kNoOffset;
  return r;
}

namespace {

/// Returns whether a finish has crand, which takes a random share of diffuse light.
bool has_grain(const Finish& finish) {
  return finish.crand != 0 && (finish.diffuse != 0 || finish.diffuse_behind != 0);
}

} // namespace

bool has_record(const Finish& finish) {
  // A thin film counts even without diffuse light: it changes highlights and mirrored light as well.
  return finish.irid != 0 || has_grain(finish);
}

FinishRecord make_record(const Finish& finish, const Scene& scene) {
  FinishRecord r{};
  r.crand = has_grain(finish) ? static_cast<float>(finish.crand) : 0;
  r.irid = static_cast<float>(finish.irid);
  r.irid_thickness = static_cast<float>(finish.irid_thickness);
  r.irid_turbulence = static_cast<float>(finish.irid_turbulence);
  r.first_generator = scene.noise_generator == 1 ? 1 : 0;
  for (int i = 0; i < 3; ++i)
    r.inverse_wavelength[i] =
        static_cast<float>(scene.irid_wavelength[i] != 0 ? 1 / scene.irid_wavelength[i] : 0);
  return r;
}

InteriorRecord make_record(const Interior& interior) {
  // POV-Ray's unit of caustics
  constexpr double kCausticsUnit = 45;
  InteriorRecord r{};
  r.ior = static_cast<float>(interior.ior);
  const auto refraction = static_cast<float>(std::max(interior.refraction, 0.0));
  r.signed_refraction = interior.hollow ? -refraction : refraction;
  if (interior.fade_distance != 0) {
    r.inverse_fade_distance = static_cast<float>(1 / std::abs(interior.fade_distance));
    r.fade_power = static_cast<float>(interior.fade_power);
    copy(interior.fade_colour, r.fade_colour);
  }
  r.caustics = static_cast<float>(interior.caustics * kCausticsUnit);
  return r;
}

FogRecord make_record(const Fog& fog, const Scene& scene) {
  constexpr double kNoAltitude = 1e-6, kOfNoise = 4096; // the period of noise in units
  FogRecord r{};
  copy(fog.colour, r.colour);
  r.least = static_cast<float>(fog.transmit);
  copy(Vec3(1 - fog.filter) + fog.filter * fog.colour, r.tint);
  r.inverse_distance = static_cast<float>(fog.distance != 0 ? 1 / fog.distance : 0);
  if (fog.is_ground) {
    const double altitude = fog.altitude != 0 ? fog.altitude : kNoAltitude;
    r.flags |= fog_flag::ground;
    copy(fog.up / altitude, r.up);
    r.offset = static_cast<float>(fog.offset / altitude);
  }
  if (fog.turbulence.amount != Vec3(0)) r.flags |= fog_flag::turbulent;
  if (scene.noise_generator == 1) r.flags |= fog_flag::first_generator;
  r.turbulence = words_of(fog.turbulence);
  r.turbulence_depth = static_cast<float>(fog.turbulence_depth);
  const bool repeats = fog.turbulence.lambda == std::floor(fog.turbulence.lambda);
  for (int i = 0; i < 3; ++i) {
    const double offset = -fog.turbulence_origin[i] * fog.turbulence.amount[i];
    r.turbulence_offset[i] = static_cast<float>(repeats ? std::remainder(offset, kOfNoise) : offset);
  }
  return r;
}

bool is_visible(const Rainbow& rainbow) {
  return rainbow.width != 0 && rainbow.distance > 0;
}

RainbowRecord make_record(const Rainbow& rainbow) {
  constexpr double kTurn = 360;
  RainbowRecord r{};
  const Vec3 direction = glm::normalize(rainbow.direction);
  const Vec3 right = glm::normalize(glm::cross(direction, rainbow.up));
  copy(direction, r.direction);
  copy(right, r.right);
  copy(glm::cross(right, direction), r.up);
  r.angle = static_cast<float>(rainbow.angle / kTurn);
  r.inverse_width = static_cast<float>(kTurn / rainbow.width);
  r.inverse_distance = static_cast<float>(1 / rainbow.distance);
  r.jitter = static_cast<float>(rainbow.jitter);
  const double arc = rainbow.arc_angle / 2, falloff = rainbow.falloff_angle / 2;
  r.arc = static_cast<float>(arc / kTurn);
  r.falloff = static_cast<float>(falloff / kTurn);
  r.inverse_fade = static_cast<float>(falloff < arc ? kTurn / (arc - falloff) : 0);
  return r;
}

bool is_opaque(const Pigment& pigment) {
  return pigment.filter == 0 && pigment.transmit == 0;
}

} // namespace celltrace
