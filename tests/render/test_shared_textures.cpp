// Textures that many objects have, each at another place: what is in their maps is in the image once.
#include "celltrace/image.hpp"
#include "records/pattern.hpp"
#include "render/backends.hpp"
#include "render/image_bytes.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

constexpr int kSide = 24;

Pattern in_space(const pattern::Kind& kind, const Transform& space) {
  Pattern pattern;
  pattern.kind = kind;
  pattern.space = {space};
  return pattern;
}

/// Squares in squares, `levels` deep.
Pigment squares(double low, double high, int levels) {
  if (levels == 0) return Pigment{{low, high, 1 - low}};
  const double middle = 0.5 * (low + high);
  Pigment pigment;
  pigment.map =
      map_of<Pigment>(in_space(pattern::Checker{},
                               Transform::scale(Vec3(0.8)).then(Transform::translate({0.01, 0.02, 0.03}))),
                      {{0, squares(low, middle, levels - 1)}, {1, squares(middle, high, levels - 1)}});
  return pigment;
}

Material painted(Pigment pigment) {
  Material material;
  material.pigment = std::move(pigment);
  return material;
}

/// The same map at another place; `apart`: and none of it is shared.
Pigment moved(const Pigment& pigment, const Transform& by, bool apart) {
  auto map = std::make_shared<PatternMap<Pigment>>(*pigment.map);
  map->pattern.space.emplace_back(by);
  if (apart) {
    const std::function<void(PatternMap<Pigment>&)> copy = [&](PatternMap<Pigment>& of) {
      for (auto& entry : of.entries) {
        if (!entry.value.map) continue;
        auto inner = std::make_shared<PatternMap<Pigment>>(*entry.value.map);
        copy(*inner);
        entry.value.map = std::move(inner);
      }
    };
    copy(*map);
  }
  Pigment changed;
  changed.map = std::move(map);
  return changed;
}

using MakeMaterial = std::function<Material(const Transform&, bool)>;

/// A wall of boxes, each with the material at another place.
Scene wall(const MakeMaterial& make, bool apart) {
  Scene scene;
  scene.camera.location = {0, 0, -5};
  scene.camera.direction = {0, 0, 1.6};
  scene.lights.push_back({{2, 3, -9}});
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const Transform by =
          Transform::rotate({i * 3.0, j * 2.0, 10}).then(Transform::scale(Vec3(0.3 + 0.02 * i)));
      Object object;
      object.shape = Box{{{0, 0, 0.1}, {0.12, 0.12, 0.2}}};
      object.transform = Transform::translate({i * 0.13 - 1.5, j * 0.13 - 1.5, 0});
      object.material = scene.add(make(by, apart));
      scene.objects.push_back(object);
    }
  return scene;
}

void check_alike(const MakeMaterial& make) {
  const Scene shared = wall(make, false), apart = wall(make, true);
  const SceneImage image(shared);
  CHECK(image.header().map_entry_count < 2000);
  CHECK(image.header().pattern_count < 2000);
  for (const TestBackend& backend : backends()) {
    const RenderOptions options = backend.options(pixels(96), pixels(72), 2);
    const Comparison c = compare_images(render(apart, options).image, render(shared, options).image);
    INFO(backend.spu() << ": " << to_text(c));
    CHECK(c.psnr > 60);
  }
}

} // namespace

TEST_CASE("A large pigment that many objects scale is in the image once") {
  const Pigment pigment = squares(0, 1, 7);
  check_alike([&](const Transform& by, bool apart) { return painted(moved(pigment, by, apart)); });
}

TEST_CASE("What a shared pigment's pattern does to space, all of it is in") {
  Pigment pigment = squares(0, 1, 7);
  auto map = std::make_shared<PatternMap<Pigment>>(*pigment.map);
  map->pattern.turbulence.amount = {0.2, 0.1, 0.3};
  map->pattern.space.emplace_back(Turbulence{{0.1, 0.1, 0.1}});
  pigment.map = std::move(map);
  check_alike([&](const Transform& by, bool apart) { return painted(moved(pigment, by, apart)); });
}

TEST_CASE("Many objects may have one average of pigments, and layers that let light through") {
  Pigment average;
  auto map = std::make_shared<PatternMap<Pigment>>();
  map->is_average = true;
  map->entries = {{1, squares(0, 0.5, 6)}, {2, squares(0.5, 1, 6)}};
  average.map = std::move(map);
  Pigment clear;
  clear.map = map_of<Pigment>(in_space(pattern::Checker{}, Transform()),
                              {{0, squares(0.2, 0.7, 5)}, {1, Pigment{{1, 1, 1}, 0, 1}}});
  check_alike([&](const Transform& by, bool apart) {
    const auto below = std::make_shared<const Material>(painted(moved(average, by, apart)));
    return Material{moved(clear, by, apart), {}, nullptr, below};
  });
}

TEST_CASE("A map of textures that are the same everywhere is shared, too") {
  const std::function<Material(double, double, int)> tiles = [&](double low, double high, int levels) {
    Material material;
    if (levels == 0) {
      material.pigment.rgb = {low, high, 1};
      material.finish.phong = low;
      return material;
    }
    const double middle = 0.5 * (low + high);
    material.map =
        map_of<Material>(in_space(pattern::Checker{},
                                  Transform::scale(Vec3(0.8)).then(Transform::translate({0.01, 0.02, 0.03}))),
                         {{0, tiles(low, middle, levels - 1)}, {1, tiles(middle, high, levels - 1)}});
    return material;
  };
  const Material material = tiles(0, 1, 7);
  Scene scenes[2];
  for (const bool apart : {false, true})
    scenes[apart] = wall(
        [&](const Transform& by, bool) {
          Material changed;
          auto map = std::make_shared<PatternMap<Material>>(apart ? *tiles(0, 1, 7).map : *material.map);
          map->pattern.space.emplace_back(by);
          changed.map = std::move(map);
          return changed;
        },
        apart);
  CHECK(SceneImage(scenes[0]).header().map_entry_count < 2000);
  for (const TestBackend& backend : backends()) {
    const RenderOptions options = backend.options(pixels(96), pixels(72), 2);
    CHECK(compare_images(render(scenes[1], options).image, render(scenes[0], options).image).psnr > 60);
  }
}

TEST_CASE("A sealed scene image in which a relative map is in another one is refused") {
  const Pigment pigment = squares(0, 1, 7);
  const Scene scene =
      wall([&](const Transform& by, bool apart) { return painted(moved(pigment, by, apart)); }, false);
  Bytes bytes = bytes_of(SceneImage(scene));
  CHECK_NOTHROW(SceneImage::from_bytes(bytes));
  ImageHeader& h = header_of(bytes);
  auto* patterns = table<PatternRecord>(bytes, h.pattern_offset);
  CHECK((patterns[h.pattern_count - 1].kind_and_flags & pattern_flag::relative) != 0);
  patterns[0].kind_and_flags |= pattern_flag::relative;
  seal(bytes);
  CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
}
