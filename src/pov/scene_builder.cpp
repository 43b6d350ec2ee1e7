#include "pov/scene_builder.hpp"

#include <algorithm>
#include <cmath>

#include "celltrace/error.hpp"

namespace celltrace::pov {

namespace {

/// The version of a scene without any #version (3.2 for POV-Ray's gamma rules).
constexpr double kVersionIfNoneGiven = 3.62;
constexpr double kVersionOfGamma = 3.7; // and of transparent backgrounds
constexpr double kVersionOfNoise = 3.5; // default generator in range from here on

bool filters(const Pigment& pigment) {
  if (!pigment.map) return pigment.filter != 0;
  const auto& entries = pigment.map->entries;
  return std::any_of(entries.begin(), entries.end(), [](const auto& entry) { return filters(entry.value); });
}

/// Multiplies all colours of a pigment, and so its light if it has no filter.
Pigment multiplied(const Pigment& pigment, const Vec3& factor) {
  Pigment result = pigment;
  result.rgb *= factor;
  if (pigment.map) {
    auto map = std::make_shared<PatternMap<Pigment>>(*pigment.map);
    for (auto& entry : map->entries)
      entry.value = multiplied(entry.value, factor);
    result.map = std::move(map);
  }
  return result;
}

} // namespace

void SceneBuilder::set_version(double version) {
  constexpr double kVersionOfExpressions = 1.5, kVersionOfSeparateTextures = 3.0;
  version_ = version;
  has_old_signs_ = is_before(kVersionOfExpressions);
  has_old_textures_ = is_before(kVersionOfSeparateTextures);
}

bool SceneBuilder::is_before(double version) const {
  return std::lround(this->version() * 100) < std::lround(version * 100);
}

void SceneBuilder::count_triangles(std::size_t count, const Location& where) {
  triangles_ += count;
  if (triangles_ > limits_.triangles)
    diagnostics_.exceed(where, &ParseLimits::triangles, "the scene has", "triangles");
}

const Mesh& SceneBuilder::mesh_of(const std::shared_ptr<MeshDefinition>& definition) const {
  const auto placed = meshes_.find(definition);
  return placed != meshes_.end() ? *placed->second : definition->mesh;
}

void SceneBuilder::set_background(const Pigment& colour) {
  const bool has_alpha = version_.value_or(kVersionIfNoneGiven) >= kVersionOfGamma;
  scene_.background = has_alpha ? colour.rgb * (1 - colour.transmit) : colour.rgb;
  scene_.background_transparency = std::clamp(colour.transmit, 0.0, 1.0);
  scene_.mirrored_background.reset();
  if (has_alpha && colour.transmit > 0) scene_.mirrored_background = colour.rgb;
}

void SceneBuilder::set_sky_sphere(const SkySphereDefinition& sky, const Location& where) {
  diagnostics_.supports(sky.unsupported, where);
  scene_.sky_sphere.clear();
  for (const PigmentDefinition& pigment : sky.pigments) {
    diagnostics_.supports(pigment.first_unsupported(), where);
    Pigment layer = pigment.finish();
    if (sky.emission != Vec3(1)) {
      if (filters(layer)) {
        const std::string what = "'emission' of a sky_sphere whose pigments have a filter";
        diagnostics_.supports(std::make_shared<Unsupported>(Unsupported{what, sky.emission_where}), where);
      }
      layer = multiplied(layer, sky.emission);
    }
    scene_.sky_sphere.push_back(std::move(layer));
  }
}

void SceneBuilder::add_fog(const FogDefinition& fog, const Location& where) {
  diagnostics_.supports(fog.unsupported, where);
  if (scene_.fogs.size() >= limits_.objects)
    diagnostics_.fail(where, "the scene has more than " + std::to_string(limits_.objects) + " fogs");
  scene_.fogs.push_back(fog.value);
}

void SceneBuilder::add_rainbow(const RainbowDefinition& rainbow, const Location& where) {
  diagnostics_.supports(rainbow.unsupported, where);
  if (scene_.rainbows.size() >= limits_.objects)
    diagnostics_.fail(where, "the scene has more than " + std::to_string(limits_.objects) + " rainbows");
  if (!rainbow.value.colours.empty()) scene_.rainbows.push_back(rainbow.value);
}

void SceneBuilder::set_assumed_gamma(std::optional<double> gamma) {
  gamma_given_ = true;
  scene_.gamma_mode = gamma ? GammaMode::assumed : GammaMode::srgb;
  scene_.assumed_gamma = gamma.value_or(1);
}

double SceneBuilder::from_srgb(double channel) const {
  if (scene_.gamma_mode != GammaMode::assumed) return channel;
  const double linear = channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
  return std::copysign(std::pow(std::fabs(linear), 1 / scene_.assumed_gamma), linear);
}

void SceneBuilder::resolve_gamma() {
  scene_.version = version_.value_or(kVersionIfNoneGiven);
  if (!gamma_given_)
    scene_.gamma_mode = scene_.version < kVersionOfGamma ? GammaMode::none : GammaMode::assumed;
}

int SceneBuilder::noise_generator() const {
  return noise_generator_.value_or(version_.value_or(kVersionIfNoneGiven) < kVersionOfNoise ? 1 : 2);
}

void SceneBuilder::show_background(const Location& where) {
  diagnostics_.warn_once(where, "this camera's rays have no direction: it sees nothing but the background");
  leave_background();
}

void SceneBuilder::leave_background() {
  scene_.objects.clear();
  scene_.sky_sphere.clear();
  scene_.fogs.clear();
  scene_.rainbows.clear();
}

Scene SceneBuilder::finish(const std::string& name) {
  scene_.name = name;
  resolve_gamma();
  scene_.noise_generator = noise_generator();
  const CameraDefinition& camera = camera_ ? *camera_ : default_camera;
  diagnostics_.supports(camera.first_unsupported(), camera.where);
  if (has_photon_targets_ && photons_) diagnostics_.supports(photons_, photons_->where);
  try {
    if (const std::optional<Camera> view = camera.finish())
      scene_.camera = *view;
    else
      show_background(camera.where);
  } catch (const InputError& error) {
    diagnostics_.fail(camera.where, error.what());
  }
  if (scene_.adc_bailout > 1) {
    leave_background();
    set_background({});
  }
  return std::move(scene_);
}

} // namespace celltrace::pov
