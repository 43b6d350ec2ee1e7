#include "scene/surface_records.hpp"

#include <algorithm>

namespace celltrace {

using namespace kernel;

namespace {

void copy(const Vec3& from, float* to) {
  for (int i = 0; i < 3; ++i)
    to[i] = static_cast<float>(from[i]);
}

/// The opacity rule changed with language version 3.7.
double opacity(const Pigment& p, double version) {
  if (version < 3.7) return 1 - (p.filter * std::max({p.rgb.x, p.rgb.y, p.rgb.z}) + p.transmit);
  return 1 - p.filter - p.transmit;
}

} // namespace

LightRecord make_record(const Light& light) {
  LightRecord r{};
  copy(light.location, r.location);
  copy(light.colour, r.colour);
  r.flags = light.shadowless ? light_flag::shadowless : 0;
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
  r.diffuse = static_cast<float>(f.diffuse);
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
            (f.conserve_energy ? material_flag::conserve_energy : 0);
  return r;
}

bool is_opaque(const Material& material) {
  return material.pigment.filter == 0 && material.pigment.transmit == 0;
}

} // namespace celltrace
