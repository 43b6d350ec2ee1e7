// Scenes of textures only, and points to ask them at.
#pragma once

#include "celltrace/texture.hpp"
#include "compiled_once.hpp"
#include "kernel/textures/pigments.hpp"
#include "lanes.hpp"
#include "scene_image/scene_image.hpp"

#include <functional>
#include <memory>

namespace celltrace::test {

/// A scene of textures only, as the kernel reads it.
class Textures {
public:
  explicit Textures(const Scene& scene) : image_(scene) {}
  explicit Textures(const Material& material) : Textures(scene_of(material)) {}
  explicit Textures(const Pigment& pigment) : Textures(plain(pigment)) {}
  explicit Textures(const Pattern& pattern) : Textures(grey(pattern)) {}

  const kernel::ImageHeader& header() const { return image_.header(); }
  kernel::SceneAccess<DirectSpu>& access() { return access_; }
  const kernel::MaterialRecord& material() { return *access_.material(header().material_offset); }
  /// Of the first material's pigment.
  const kernel::PatternRecord& pattern() { return *access_.pattern(material().pattern); }

  static Material plain(const Pigment& pigment) {
    Material material;
    material.pigment = pigment;
    return material;
  }
  static Pigment grey(const Pattern& pattern) {
    Pigment pigment;
    pigment.map = std::make_shared<const PatternMap<Pigment>>(
        PatternMap<Pigment>{pattern, {{0, Pigment{Vec3(0)}}, {1, Pigment{Vec3(1)}}}});
    return pigment;
  }

private:
  static Scene scene_of(const Material& material) {
    Scene scene;
    scene.materials = {material};
    return scene;
  }

  SceneImage image_;
  DirectSpu spu_;
  kernel::SceneAccess<DirectSpu> access_{spu_, CacheConfig(),
                                         reinterpret_cast<std::uintptr_t>(image_.base())};
};

inline kernel::VectorLanes points_of(const std::function<Vec3(unsigned)>& point) {
  kernel::VectorLanes points;
  for (unsigned l = 0; l < kSimdLanes; ++l)
    set(points, l, point(l));
  return points;
}

/// What POV-Ray 3.7 has at a point: f_noise_generator 1 and 2, vturbulence(2, 0.5, 1, p) and
/// vturbulence(2.3, 0.7, 4, p), to nine decimals.
struct Measured {
  Vec3 point;
  double first, second;
  Vec3 vector, turbulence;
};
constexpr Measured kMeasured[kSimdLanes] = {
    {{0, 0, 0},
     0.0565805,
     0.298322439,
     {-0.4434195, 0.3610055, -0.459716},
     {-1.123181573, 0.914426915, -1.164460607}},
    {{0.5, 0.25, 0.75},
     0.229814691,
     0.383182216,
     {-0.270185309, -0.497926325, 0.332525255},
     {-0.272718763, -0.470404662, 0.567349635}},
    {{-0.5, -0.25, -0.75},
     0.604671367,
     0.56680794,
     {0.104671367, 0.089640339, -0.007910775},
     {0.771303719, -0.104499934, -0.182046826}},
    {{1.5, 2.5, 3.5},
     0.445319369,
     0.488748437,
     {-0.054680631, -0.004251437, 0.002180225},
     {0.028943051, -0.107113659, 0.021987546}},
    {{-3.25, 7.125, -1.875},
     0.288130172,
     0.411748394,
     {-0.211869828, 0.081637729, 0.052170216},
     {0.023806304, 0.414513503, -0.101258253}},
    {{0.125, 0, 0.875},
     0.41641019,
     0.474587107,
     {-0.08358981, -0.492647391, 0.172313766},
     {-0.106584216, -0.420008271, -0.029334629}},
    {{10.75, -20.375, 30.625},
     0.700087697,
     0.613548185,
     {0.200087697, 0.151176178, -0.311092083},
     {0.355930272, -0.116774602, -0.702680042}},
    {{-100.5, 50.25, -75.125},
     0.485405081,
     0.508384656,
     {-0.014594919, 0.205454652, -0.753889803},
     {-0.013827369, -0.29766214, -1.071709326}},
    {{999.5, -1000.25, 500.75},
     0.216256937,
     0.376540871,
     {-0.283743063, -0.125647252, -0.025769624},
     {-0.119389657, -0.34955151, -0.22837273}},
    {{4095.5, 4096.25, 4097.75},
     0.657352412,
     0.592614057,
     {0.157352412, 0.309392428, -0.19856589},
     {0.217547045, 0.327431188, 0.009924635}},
    {{-4097.5, -4095.25, -8191.75},
     0,
     0.167466242,
     {-0.710551566, 0.003113872, 0.185752223},
     {-0.636550346, 0.342486042, 0.493707688}},
    {{2, 3, 4}, 0.3084, 0.421677687, {-0.1916, 0.1391545, 0.219539}, {0.00637353, 0.140989718, 0.56568207}},
    {{-2, -3, -4},
     0.2314185,
     0.383967851,
     {-0.2685815, 0.2499655, 0.2224995},
     {-0.561687274, 0.025015247, 0.134204789}},
    {{0.9375, -0.0625, 0.5},
     0.059433484,
     0.29971999,
     {-0.440566516, -0.60716104, 0.279824825},
     {-0.483067819, -0.681248959, 0.160574524}},
    {{12345.5, -23456.25, 34567.75},
     0,
     0.214094586,
     {-0.615363673, -0.159040229, 0.214713506},
     {-0.645534229, -0.234935871, 0.47922753}},
    {{3.625, -4.375, 5.0625},
     0.749586527,
     0.637795475,
     {0.249586527, -0.412988479, -0.148927661},
     {0.164990307, -0.213151041, -0.465783186}},
};
inline kernel::VectorLanes measured_points() {
  return points_of([](unsigned l) { return kMeasured[l].point; });
}

inline Pattern gradient(const Vec3& direction) {
  Pattern pattern;
  pattern.kind = pattern::Gradient{direction};
  return pattern;
}

} // namespace celltrace::test
