// The light of a hit in single precision against the formulas of the reference.
#include "compiled_once.hpp"
#include "kernel/shading/atmosphere.hpp"
#include "kernel/shading/lighting.hpp"
#include "kernel/shading/secondary_rays.hpp"
#include "lanes.hpp"
#include "prepared_scene.hpp"
#include "reference/shading.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

Vec3 colour(Random& random) {
  return {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
}

Material any_material(Random& random) {
  Material m;
  m.pigment = {colour(random), random.below(2) * random.uniform(0, 0.5),
               random.below(2) * random.uniform(0, 0.5)};
  Finish& f = m.finish;
  f.ambient = colour(random);
  f.emission = random.below(2) == 0 ? Vec3(0) : colour(random);
  f.diffuse = random.uniform(0, 1);
  f.brilliance = random.below(2) == 0 ? 1 : random.uniform(0.5, 6);
  f.phong = random.below(2) * random.uniform(0, 1);
  f.phong_size = random.uniform(1, 120);
  f.specular = random.below(2) * random.uniform(0, 1);
  f.roughness = random.uniform(0.005, 0.2);
  f.metallic = random.below(2) * random.uniform(0, 1);
  f.reflection_min = random.below(3) == 0 ? Vec3(0) : colour(random) * 0.5;
  f.reflection_max = random.below(3) == 0 ? f.reflection_min : f.reflection_min + colour(random) * 0.5;
  f.reflection_falloff = random.below(2) == 0 ? 1 : random.uniform(0.5, 5);
  f.reflection_metallic = random.below(2) * random.uniform(0, 1);
  f.reflection_fresnel = random.below(3) == 0;
  return m;
}

std::uint32_t offset_of_interior(const PreparedScene& scene, Index interior) {
  return scene.header().interior_offset + interior * std::uint32_t{sizeof(InteriorRecord)};
}

/// Sixteen hits with a material each, without anything around.
struct Hits {
  VectorLanes point, normal, direction;
  WordLanes material, objects;
  Index index[kSimdLanes];

  Hits(Random& random, const PreparedScene& scene, unsigned materials) {
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      set(point, l, random.point(3));
      const Vec3 n = random.direction();
      const Vec3 d = random.direction();
      set(normal, l, n);
      set(direction, l, glm::dot(n, d) > 0 ? -d : d);
      index[l] = random.below(materials);
      material.lane[l] = scene.header().material_offset + index[l] * 128;
      objects.lane[l] = kNoOffset;
    }
  }
  Surfaces<Simd> surfaces() const {
    return {point.load<Simd>(), normal.load<Simd>(), direction.load<Simd>(), &objects};
  }
};

/// A scene of materials and lights only.
Scene empty_scene(Random& random, double version, unsigned lights) {
  Scene scene;
  scene.version = version;
  scene.ambient_light = colour(random) * 2.0;
  for (int i = 0; i < 12; ++i)
    scene.add(any_material(random));
  for (unsigned i = 0; i < lights; ++i)
    scene.lights.push_back({random.point(8), colour(random) * 1.5, i % 3 == 2});
  return scene;
}

double difference(const Vec3& a, const Vec3& b) {
  const Vec3 d = glm::abs(a - b);
  return std::max({d.x, d.y, d.z});
}

} // namespace

TEST_CASE("Ambient light, diffuse light and highlights of mixed materials") {
  Random random(60);
  for (int k = 0; k < 300; ++k) {
    const unsigned lights = random.below(7);
    const Scene source = empty_scene(random, k % 2 == 0 ? 3.7 : 3.62, lights);
    PreparedScene scene(source);
    REQUIRE(scene.prepare().built);
    DirectSpu spu;
    SceneAccess<DirectSpu> access(spu, CacheConfig(), scene.frame().image);
    Traversal<DirectSpu> traversal(access, scene.frame());
    const Hits hits(random, scene, 12);
    const std::uint32_t lanes = random.below(3) == 0 ? random.word() & 0xFFFF : 0xFFFF;
    const auto materials = gather_materials(access, hits.material, lanes);
    VectorLanes light;
    light.store<Simd>({0.0f, 0.0f, 0.0f});
    const Vec3 weight = colour(random);
    const float channels[3] = {static_cast<float>(weight.x), static_cast<float>(weight.y),
                               static_cast<float>(weight.z)};
    const V3<Simd> weights = splat3<Simd>(channels);
    VectorLanes gathered[kLightsARound];
    std::uint64_t shadow_rays = 0;
    for (std::uint32_t first = 0; first == 0 || first < lights; first += kLightsARound) {
      LightRound round = LightRound::from(scene.frame(), first, gathered);
      round.clear<Simd>();
      const V3<Simd> rest =
          weights * local_light(access, scene.frame(), round, hits.surfaces(), materials, lanes, weights);
      for_each_light(access, scene.frame(), round.first, round.count,
                     [&](unsigned number, const LightRecord& record) {
                       VectorLanes& sent = gathered[number - first];
                       const std::uint32_t asked = lanes_above<Simd>(sent, lanes, kLeastLight);
                       shadow_rays += static_cast<unsigned>(__builtin_popcount(asked));
                       IncidentLight<Simd> incident;
                       aim(spu, record, hits.point.load<Simd>(), incident);
                       RayPacket rays;
                       FloatLanes distance;
                       make_shadow_rays(hits.point.load<Simd>(), hits.objects, incident, rays, distance);
                       traversal.transmittance(rays, asked, distance, sent);
                     });
      light.store<Simd>(light.load<Simd>() + rest);
      round.add_to<Simd>(light, lanes);
    }

    // Rays that are traced for certain, and those that may be: rounding decides about light at the limit.
    std::uint64_t certain_rays = 0, possible_rays = 0;
    for_each_lane(lanes, [&](unsigned l) {
      const Material& m = source.materials[hits.index[l]];
      const Vec3 normal = test::at(hits.normal, l);
      Vec3 expected = weight * m.pigment.rgb * (m.finish.ambient * source.ambient_light + m.finish.emission) *
                      reference::opacity(m.pigment, source.version);
      for (const Light& each : source.lights) {
        const Vec3 to_light = glm::normalize(each.location - test::at(hits.point, l));
        const Vec3 lit = weight * reference::lit(m, source.version, each.colour, to_light,
                                                 test::at(hits.direction, l), normal, !each.shadowless);
        expected += lit;
        if (each.shadowless) continue;
        certain_rays += difference(lit, Vec3(0)) > 2 * kLeastLight;
        possible_rays += difference(lit, Vec3(0)) > 0.5 * kLeastLight;
      }
      // Exponents up to 200 magnify the rounding of the cosines.
      REQUIRE(difference(test::at(light, l), expected) < 1e-4);
    });
    REQUIRE(shadow_rays >= certain_rays);
    REQUIRE(shadow_rays <= possible_rays);
  }
}

TEST_CASE("Phong's highlight is cut off where POV-Ray cuts it off") {
  // R.L just above and below 0.0008: from phong_size 60 on the latter gives nothing; 0 gives nothing at all.
  for (double size : {1.0, 59.9, 60.0}) {
    for (double cosine : {-0.1, 0.0, 0.0007, 0.0009, 0.5}) {
      // Seen along the normal, so that the mirrored ray is the normal too; the light stands at `cosine` to
      // it.
      const Vec3 to_light(std::sqrt(1 - cosine * cosine), cosine, 0);
      MaterialLanes<Simd> lanes{};
      lanes.phong = F(1.0f);
      lanes.phong_size = F(static_cast<float>(size));
      VectorLanes normal, direction, light;
      for (unsigned l = 0; l < kSimdLanes; ++l) {
        set(normal, l, {0, 1, 0});
        set(direction, l, {0, -1, 0});
        set(light, l, to_light);
      }
      const Surfaces<Simd> surfaces = {normal.load<Simd>(), normal.load<Simd>(), direction.load<Simd>(),
                                       nullptr};
      IncidentLight<Simd> arrival(LightRecord().colour);
      arrival.direction = light.load<Simd>();
      arrival.facing = 0xFFFF;
      const double term = lanes_of(kernel::detail::phong_term<Simd>(surfaces, lanes, arrival)).lane[3];
      const bool cut = cosine <= 0 || (size >= 60 && cosine <= 0.0008);
      INFO("phong_size " << size << ", cosine " << cosine);
      CHECK(term == Approx(cut ? 0 : std::pow(cosine, size)).epsilon(1e-4).margin(1e-9));
    }
  }
}

TEST_CASE("No highlight is left out but those too faint to see") {
  Random random(65);
  for (int k = 0; k < 20000; ++k) {
    // The surface leans in one lane, where the light comes to that is in the viewer's direction; in others it
    // is nearly turned away, or light does not come to it.
    const unsigned lane = random.below(kSimdLanes);
    const double size = std::exp(random.uniform(0, 8)), cosine = std::exp(random.uniform(-1, 0) * 40 / size);
    MaterialLanes<Simd> lanes{};
    lanes.phong = lanes.specular = F(0.5f);
    lanes.phong_size = lanes.inverse_roughness = F(static_cast<float>(size));
    VectorLanes normal, direction, light;
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      const double c = l == lane ? cosine : random.below(2) == 0 ? 0.01 : 1;
      set(normal, l, {std::sqrt(1 - c * c), c, 0});
      set(direction, l, {0, -1, 0});
      set(light, l, {0, 1, 0});
    }
    const Surfaces<Simd> surfaces = {normal.load<Simd>(), normal.load<Simd>(), direction.load<Simd>(),
                                     nullptr};
    IncidentLight<Simd> arrival(LightRecord().colour);
    arrival.direction = light.load<Simd>();
    arrival.facing = 1u << lane;
    INFO("exponent " << size << ", cosine " << cosine);
    const double specular =
        lanes_of(kernel::detail::specular_term<Simd>(surfaces, lanes, arrival)).lane[lane];
    CHECK(specular == Approx(0.5 * std::pow(cosine, size)).epsilon(1e-3).margin(1e-9));
    const double mirrored = 2 * cosine * cosine - 1; // the mirrored ray leans twice as far
    const double phong = lanes_of(kernel::detail::phong_term<Simd>(surfaces, lanes, arrival)).lane[lane];
    CHECK(phong == Approx(mirrored <= 0 ? 0 : 0.5 * std::pow(mirrored, size)).epsilon(1e-3).margin(1e-9));
  }
}

TEST_CASE("Metallic tint") {
  Random random(61);
  for (int k = 0; k < 5000; ++k) {
    FloatLanes metallic, cosine;
    VectorLanes pigment;
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      metallic.lane[l] = static_cast<float>(random.uniform(0, 1));
      cosine.lane[l] = static_cast<float>(l == 0 ? 0 : l == 1 ? 1 : random.uniform(0, 1));
      set(pigment, l, colour(random));
    }
    const VectorLanes tint =
        lanes_of(metallic_tint<Simd>(load(metallic), load(cosine), pigment.load<Simd>()));
    for (unsigned l = 0; l < kSimdLanes; ++l)
      REQUIRE(difference(test::at(tint, l), reference::metallic_tint(metallic.lane[l], cosine.lane[l],
                                                                     test::at(pigment, l))) < 3e-6);
  }
}

TEST_CASE("Reflectivity of mixed materials") {
  Random random(62);
  for (int k = 0; k < 500; ++k) {
    const Scene source = empty_scene(random, 3.7, 0);
    const PreparedScene scene(source);
    DirectSpu spu;
    SceneAccess<DirectSpu> access(spu, CacheConfig(), scene.frame().image);
    const Hits hits(random, scene, 12);
    const auto materials = gather_materials(access, hits.material, 0xFFFF);
    FloatLanes cosine, ratio;
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      cosine.lane[l] = static_cast<float>(random.uniform(0.001, 1));
      ratio.lane[l] = static_cast<float>(random.uniform(0.4, 2.5));
    }
    const VectorLanes mirrored = lanes_of(reflectivity<Simd>(materials, load(cosine), load(ratio)));
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      const Material& m = source.materials[hits.index[l]];
      const double sine = ratio.lane[l] * std::sqrt(1 - std::pow(cosine.lane[l], 2));
      if (m.finish.reflection_fresnel && std::abs(sine - 1) < 2e-3) continue;
      REQUIRE(difference(test::at(mirrored, l), reference::reflectivity(m, cosine.lane[l], ratio.lane[l])) <
              1e-5);
    }
  }
}

TEST_CASE("Fresnel's reflectance") {
  Random random(63);
  for (int k = 0; k < 5000; ++k) {
    FloatLanes cosine, ratio;
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      cosine.lane[l] = static_cast<float>(l == 0 ? 1 : random.uniform(1e-3, 1));
      ratio.lane[l] = static_cast<float>(l < 4 ? 1 / 1.5 : l < 8 ? 1.5 : random.uniform(0.3, 3));
    }
    const FloatLanes actual = lanes_of(fresnel_reflectance<Simd>(load(ratio), load(cosine)));
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      const double sine = ratio.lane[l] * std::sqrt(1 - std::pow(cosine.lane[l], 2));
      if (std::abs(sine - 1) < 2e-3) continue; // at the critical angle the slope is infinite
      REQUIRE(actual.lane[l] ==
              Approx(reference::fresnel_reflectance(ratio.lane[l], cosine.lane[l])).margin(1e-5));
      if (sine > 1) REQUIRE(actual.lane[l] == 1);
    }
  }
  CHECK(lanes_of(fresnel_reflectance<Simd>(F(1.0f / 1.5f), F(1.0f))).lane[0] == Approx(0.04));
  CHECK(lanes_of(fresnel_reflectance<Simd>(F(1.0f), F(0.5f))).lane[0] == Approx(0).margin(1e-6));
}

namespace {

/// Rays at surfaces, with their ratios of indices of refraction.
struct RaysAtSurfaces {
  VectorLanes direction, normal;
  FloatLanes ratio;

  /// `away`: normals are turned away from the rays.
  RaysAtSurfaces(Random& random, bool away) {
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      const Vec3 n = random.direction();
      const Vec3 d = random.direction();
      set(normal, l, n);
      set(direction, l, (glm::dot(n, d) > 0) == away ? d : -d);
      ratio.lane[l] = static_cast<float>(l < 8 ? random.uniform(0.4, 2.5) : l % 2 == 0 ? 1.5 : 1 / 1.5);
    }
  }
};

} // namespace

TEST_CASE("Mirrored and refracted directions, and total reflection") {
  Random random(64);
  unsigned beyond = 0;
  for (int k = 0; k < 5000; ++k) {
    const RaysAtSurfaces rays(random, false);
    const auto& [direction, normal, ratio] = rays;
    const Vec d = direction.load<Simd>();
    const Vec n = normal.load<Simd>();
    const F cosine = -dot<Simd>(d, n);
    M total = M::none();
    const VectorLanes bent = lanes_of(refract<Simd>(d, n, cosine, load(ratio), total));
    const VectorLanes mirrored = lanes_of(mirror<Simd>(d, n, n));
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      const Vec3 from = test::at(direction, l);
      const Vec3 normal_here = test::at(normal, l);
      REQUIRE(glm::length(test::at(mirrored, l) - reference::mirror(from, normal_here)) < 1e-6);
      const double c = glm::dot(from, normal_here);
      const double square = 1 - ratio.lane[l] * ratio.lane[l] * (1 - c * c);
      const bool is_total = (total.bits() >> l & 1) != 0;
      if (std::abs(square) > 1e-5) REQUIRE(is_total == (square < 0));
      if (is_total) ++beyond;
      const auto expected = reference::refract(from, normal_here, ratio.lane[l]);
      if (is_total || !expected) continue;
      REQUIRE(glm::length(test::at(bent, l) - *expected) < 2e-6 / std::sqrt(std::max(square, 1e-6)));
    }
  }
  CHECK(beyond > 1000);
}

TEST_CASE("Disturbed normals that are turned away refract as if they were turned around") {
  Random random(67);
  unsigned beyond = 0;
  for (int k = 0; k < 1000; ++k) {
    const RaysAtSurfaces rays(random, true);
    const auto& [direction, normal, ratio] = rays;
    const Vec d = direction.load<Simd>();
    const Vec n = normal.load<Simd>();
    M total = M::none();
    const VectorLanes bent = lanes_of(refract<Simd>(d, n, -dot<Simd>(d, n), load(ratio), total));
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      const Vec3 from = test::at(direction, l), turned = -test::at(normal, l);
      const double c = glm::dot(from, turned);
      const double square = 1 - ratio.lane[l] * ratio.lane[l] * (1 - c * c);
      if (std::abs(square) < 1e-5) continue;
      const auto expected = reference::refract(from, turned, ratio.lane[l]);
      REQUIRE((total.bits() >> l & 1) == (expected ? 0 : 1));
      if (!expected)
        ++beyond;
      else
        REQUIRE(glm::length(test::at(bent, l) - *expected) < 2e-6 / std::sqrt(square));
    }
  }
  CHECK(beyond > 1000);
}

TEST_CASE("Mirrored by disturbed normals no ray goes below its surface") {
  Random random(66);
  unsigned away = 0, below = 0;
  for (int k = 0; k < 2000; ++k) {
    VectorLanes direction, normal, smooth;
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      const Vec3 n = random.direction();
      const Vec3 d = random.direction();
      set(smooth, l, n);
      set(normal, l, glm::normalize(n + random.point(1)));
      set(direction, l, glm::dot(n, d) > 0 ? -d : d);
    }
    const VectorLanes mirrored =
        lanes_of(mirror<Simd>(direction.load<Simd>(), normal.load<Simd>(), smooth.load<Simd>()));
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      const Vec3 from = test::at(direction, l), unit = test::at(smooth, l), disturbed = test::at(normal, l);
      const double cosine = -glm::dot(from, disturbed);
      if (std::abs(cosine) < 1e-5) continue;
      if (cosine < 0) ++away;
      Vec3 expected = reference::mirror(from, cosine < 0 ? unit : disturbed);
      const double height = glm::dot(expected, unit);
      if (height < 0) {
        ++below;
        expected = reference::mirror(expected, unit);
      }
      REQUIRE(glm::length(test::at(mirrored, l) - expected) < 2e-6);
    }
  }
  CHECK(away > 500);
  CHECK(below > 500);
}

TEST_CASE("The interiors that a ray is inside of") {
  Random random(65);
  Scene source;
  for (double ior : {1.0, 1.33, 1.5, 1.5, 2.4, 0.9, 1.0})
    source.add(Interior{ior});
  const PreparedScene scene(source);
  DirectSpu spu;
  SceneAccess<DirectSpu> access(spu, CacheConfig(), scene.frame().image);
  const auto offset = [&](Index interior) { return offset_of_interior(scene, interior); };
  // Random crossings: into, out of the innermost, out of another one, in any lanes.
  for (int k = 0; k < 200; ++k) {
    RayNode node{};
    std::vector<reference::InteriorStack> stacks(kSimdLanes);
    for (int step = 0; step < 30; ++step) {
      const std::uint32_t lanes = random.word() & 0xFFFF;
      WordLanes interior{};
      Index chosen[kSimdLanes];
      for (unsigned l = 0; l < kSimdLanes; ++l) {
        chosen[l] = random.below(7);
        interior.lane[l] = offset(chosen[l]);
      }
      std::uint64_t overflows = 0;
      const FloatLanes mirrors = fresnel_ratios(access, interior, lanes, node);
      for_each_lane(lanes, [&](unsigned l) {
        REQUIRE(mirrors.lane[l] ==
                Approx(reference::fresnel_ratio(stacks[l], chosen[l], source.interiors)).epsilon(1e-6));
      });
      const Refraction r = cross_surfaces(access, interior, lanes, node, overflows);
      REQUIRE(overflows == 0);
      for (unsigned l = 0; l < kSimdLanes; ++l) {
        double ratio = 1;
        if ((lanes >> l & 1) != 0) {
          ratio = reference::cross_surface(stacks[l], chosen[l], source.interiors);
          REQUIRE(((r.straight >> l & 1) != 0) == (std::abs(ratio - 1) < 1e-6));
          REQUIRE(r.ratio.lane[l] == Approx(ratio).epsilon(1e-6));
        }
        REQUIRE(node.interior_depth.lane[l] == stacks[l].size());
        for (std::size_t d = 0; d < stacks[l].size(); ++d)
          REQUIRE(node.interiors[d].lane[l] == offset(stacks[l][d]));
      }
    }
  }
}

TEST_CASE("More interiors than a ray remembers lose the outermost, and are counted") {
  Scene source;
  for (unsigned i = 0; i < kMaxInteriorDepth + 2; ++i)
    source.add(Interior{1 + 0.1 * i});
  const PreparedScene scene(source);
  DirectSpu spu;
  SceneAccess<DirectSpu> access(spu, CacheConfig(), scene.frame().image);
  RayNode node{};
  std::uint64_t overflows = 0;
  for (unsigned i = 0; i < kMaxInteriorDepth + 2; ++i) {
    WordLanes interior{};
    interior.lane[5] = offset_of_interior(scene, i);
    const Refraction r = cross_surfaces(access, interior, 1u << 5, node, overflows);
    CHECK(r.ratio.lane[5] == Approx(i == 0 ? 1.0 : (1 + 0.1 * (i - 1)) / (1 + 0.1 * i)));
    CHECK(overflows == (i < kMaxInteriorDepth ? 0 : i - kMaxInteriorDepth + 1));
  }
  CHECK(node.interior_depth.lane[5] == kMaxInteriorDepth);
  CHECK(node.interiors[0].lane[5] == offset_of_interior(scene, 2));
  CHECK(node.interior_depth.lane[4] == 0);
}

TEST_CASE("Turbulence clears a fog as far as its depth says") {
  Random random(66);
  DirectSpu spu;
  for (int k = 0; k < 60; ++k) {
    FogRecord fog{};
    fog.tint[0] = 1;
    fog.inverse_distance = static_cast<float>(random.uniform(0.02, 0.3));
    fog.flags = fog_flag::turbulent;
    fog.turbulence_depth = static_cast<float>(random.uniform(0.1, 3));
    fog.turbulence = {{0.5f, 1.0f, 0.7f}, 2.0f, 0.5f, 3};
    VectorLanes origin, direction;
    FloatLanes length;
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      set(origin, l, random.point(5));
      set(direction, l, random.direction());
      length.lane[l] = static_cast<float>(random.uniform(0.1, 12));
    }
    const V3<Simd> begin = origin.load<Simd>(), way = direction.load<Simd>();
    const Simd::F far = Simd::F::load(length.lane);
    const auto passage = kernel::detail::through_fog(spu, fog, begin, way, far);
    VectorLanes pass;
    pass.store<Simd>(passage.pass);
    FloatLanes noise;
    const V3<Simd> middle = (begin + way * (far * Simd::F(0.5f))) * splat3<Simd>(fog.turbulence.amount);
    kernel::noise::turbulence_value<Simd>(middle, fog.turbulence, false).store(noise.lane);
    for (unsigned l = 0; l < kSimdLanes; ++l) {
      const double depth = double{length.lane[l]} * fog.inverse_distance;
      const double clear = std::min(1.0, double{noise.lane[l]} * fog.turbulence_depth);
      const double expected = std::exp(-depth * (1 - std::exp(-depth) * clear));
      CHECK(test::at(pass, l).x == Approx(expected).margin(1e-6));
    }
  }
}
