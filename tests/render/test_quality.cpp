// What levels of quality leave of a scene.
#include "render/quality.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;

namespace {

Pigment clear_map() {
  Pigment entry;
  entry.rgb = {0.1, 0.2, 0.3};
  entry.filter = 0.4;
  entry.transmit = 0.5;
  Pigment pigment;
  pigment.transmit = 0.25;
  pigment.map = map_of<Pigment>(Pattern(), {{0, entry}, {1, entry}});
  return pigment;
}

/// A scene with something of all that a level may leave out.
Scene everything() {
  Scene scene;
  Material below = matte({1, 0, 0});
  below.pigment = clear_map();
  below.normal = std::make_shared<const Normal>();
  below.finish.reflection_max = Vec3(0.5);
  Material top = matte({0, 1, 0});
  top.pigment.filter = 0.5;
  top.finish.reflection_min = Vec3(0.25);
  top.finish.reflection_max = Vec3(0.75);
  top.finish.diffuse = 0.7;
  top.normal = std::make_shared<const Normal>();
  top.below = std::make_shared<const Material>(below);
  Material mapped = matte({0, 0, 1});
  mapped.map = map_of<Material>(Pattern(), {{0, top}, {1, below}});
  scene.materials = {top, mapped, mapped};
  scene.interiors.emplace_back();
  scene.objects = {sphere_at({0, 0, 0}, 1, 0, 0), sphere_at({3, 0, 0}, 1, 1, 0)};
  Light light;
  light.area.emplace();
  light.projected_through = std::make_shared<const Object>(scene.objects[0]);
  light.is_dimmed_by_fog = true;
  scene.lights = {light, light};
  LightGroup group;
  group.lights = {1};
  scene.light_groups = {group};
  scene.fogs.emplace_back();
  scene.rainbows.emplace_back();
  return scene;
}

} // namespace

TEST_CASE("The best quality leaves a scene as it is, the next ones its air out") {
  const Scene scene = everything();
  for (const int quality : {9, 10, 11}) {
    const Scene same = at_quality(scene, quality);
    CHECK(same.fogs.size() == 1);
    CHECK(same.rainbows.size() == 1);
    CHECK(same.materials == scene.materials);
  }
  const Scene clear = at_quality(scene, 8);
  CHECK(clear.fogs.empty());
  CHECK(clear.rainbows.empty());
  CHECK(clear.materials == scene.materials);
  CHECK(clear.lights[0].area);
  CHECK(clear.lights[0].is_dimmed_by_fog);
}

TEST_CASE("Quality below 8 has smooth surfaces that mirror nothing") {
  const Scene scene = everything();
  for (const int quality : {7, 6, 5, 4, 3, 2}) {
    CAPTURE(quality);
    const Scene plain = at_quality(scene, quality);
    CHECK(plain.fogs.empty());
    const Material& top = plain.materials[0];
    CHECK(top.normal == nullptr);
    CHECK(top.finish.reflection_min == Vec3(0));
    CHECK(top.finish.reflection_max == Vec3(0));
    CHECK(top.finish.diffuse == 0.7);
    CHECK(top.pigment == scene.materials[0].pigment);
    REQUIRE(top.below);
    CHECK(top.below->normal == nullptr);
    CHECK(top.below->finish.reflection_max == Vec3(0));
    CHECK(top.below->pigment.map == scene.materials[0].below->pigment.map);
    REQUIRE(plain.materials[1].map);
    CHECK(plain.materials[1].map->entries[0].value.normal == nullptr);
    CHECK(plain.materials[1].map->entries[1].value.finish.reflection_max == Vec3(0));
    CHECK(plain.materials[1].map == plain.materials[2].map);
    CHECK(plain.lights.size() == 2);
    CHECK(plain.light_groups[0].lights.size() == 1);
    const bool has_shadows = quality > 3;
    for (const Light& light : plain.lights) {
      CHECK(light.area.has_value() == (quality > 4));
      CHECK((light.projected_through != nullptr) == has_shadows);
      CHECK(light.is_dimmed_by_fog == has_shadows);
    }
    for (const Object& object : plain.objects)
      CHECK(object.no_shadow == !has_shadows);
  }
}

TEST_CASE("Quality 0 and 1 have colours of the innermost layer, and no light") {
  for (const int quality : {0, 1}) {
    const Scene plain = at_quality(everything(), quality);
    CHECK(plain.lights.empty());
    CHECK(plain.light_groups[0].lights.empty());
    const Material& top = plain.materials[0];
    CHECK(top.below == nullptr);
    CHECK(top.finish.emission == Vec3(1));
    CHECK(top.finish.ambient == Vec3(0));
    CHECK(top.finish.diffuse == 0);
    REQUIRE(top.pigment.map);
    CHECK(top.pigment.transmit == 0);
    for (const auto& entry : top.pigment.map->entries) {
      CHECK(entry.value.rgb == Vec3(0.1, 0.2, 0.3));
      CHECK(entry.value.filter == 0);
      CHECK(entry.value.transmit == 0);
    }
    const auto& entries = plain.materials[1].map->entries;
    CHECK(entries[0].value.finish.emission == Vec3(1));
    CHECK(entries[0].value.pigment.map == entries[1].value.pigment.map); // still shared
  }
}
