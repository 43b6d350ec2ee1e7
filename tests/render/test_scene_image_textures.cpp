// SceneImage: the records of textures.
#include "celltrace/error.hpp"
#include "kernel/textures/list.hpp"
#include "records/light_feature.hpp"
#include "render/image_bytes.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <limits>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

/// Finds records of an image by what they say.
struct TextureRecords {
  explicit TextureRecords(Bytes& bytes) : b(bytes), h(header_of(bytes)) {}

  MaterialRecord& material(std::uint32_t flags) {
    auto* all = table<MaterialRecord>(b, h.material_offset);
    auto* found = std::find_if(all, all + h.material_count,
                               [&](const MaterialRecord& r) { return (r.flags & flags) == flags; });
    REQUIRE(found != all + h.material_count);
    return *found;
  }
  PatternRecord& pattern(std::uint32_t offset) { return *table<PatternRecord>(b, offset); }
  PatternRecord& stepped() {
    auto* all = table<PatternRecord>(b, h.pattern_offset);
    auto* found =
        std::find_if(all, all + h.pattern_count, [&](const PatternRecord& r) { return r.step_count != 0; });
    REQUIRE(found != all + h.pattern_count);
    return *found;
  }
  /// Makes a pattern's first entry a map.
  void nest(std::uint32_t pattern_offset, std::uint32_t child) {
    pattern(pattern_offset).kind_and_flags |= pattern_flag::nested;
    entry_of(pattern_offset).child = child;
  }
  NormalRecord& normal(bool is_mapped) {
    auto* all = table<NormalRecord>(b, h.normal_offset);
    auto* found = std::find_if(all, all + h.normal_count,
                               [&](const NormalRecord& r) { return (r.is_mapped != 0) == is_mapped; });
    REQUIRE(found != all + h.normal_count);
    return *found;
  }
  MapEntryRecord& entry_of(std::uint32_t pattern_offset) {
    return *table<MapEntryRecord>(b, pattern(pattern_offset).entries);
  }
  template <class Record> std::uint32_t offset_of(const Record& record) const {
    return static_cast<std::uint32_t>(reinterpret_cast<const std::byte*>(&record) - b.data());
  }

  Bytes& b;
  ImageHeader& h;
};

/// A pigment of a map whose only entry is `inner`.
Pigment around(const Pigment& inner, const Pattern& pattern = {}) {
  Pigment outer;
  outer.map = map_of<Pigment>(pattern, {{0, inner}});
  return outer;
}
Pigment nested_pigment(int maps) {
  Pigment pigment;
  for (int i = 0; i < maps; ++i)
    pigment = around(pigment);
  return pigment;
}
Scene scene_of(const Material& material) {
  Scene scene;
  scene.materials = {material};
  return scene;
}
Scene scene_of(const Pigment& pigment) {
  Material material;
  material.pigment = pigment;
  return scene_of(material);
}

} // namespace

TEST_CASE("A sealed scene image with a fault in its tables of random numbers is refused") {
  const auto bytes_with = [](const pattern::Kind& kind, int generator, const std::vector<SpaceStep>& space) {
    Scene scene;
    Pattern pattern;
    pattern.kind = kind;
    pattern.noise_generator = generator;
    pattern.space = space;
    Material material;
    material.pigment.map = std::make_shared<const PatternMap<Pigment>>(
        PatternMap<Pigment>{pattern, {{0, Pigment{Vec3(0)}}, {1, Pigment{Vec3(1)}}}});
    scene.materials = {material};
    return bytes_of(SceneImage(scene));
  };
  const auto refused = [](const Bytes& good,
                          const std::function<void(ImageHeader&, PatternRecord&)>& change) {
    Bytes bytes = good;
    CHECK_NOTHROW(SceneImage::from_bytes(bytes));
    ImageHeader& header = header_of(bytes);
    change(header, *table<PatternRecord>(bytes, header.pattern_offset));
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  using H = ImageHeader;
  using P = PatternRecord;
  const Bytes crackle = bytes_with(pattern::Crackle{}, 0, {});
  refused(crackle, [](H& h, P&) { h.feature_count = 0; });
  refused(crackle, [](H& h, P&) { --h.feature_count; });
  refused(crackle, [](H& h, P&) { h.feature_offset = 0xFFFFFF80; });
  refused(crackle, [](H&, P& p) { p.table += 16; });
  const Bytes gradients = bytes_with(pattern::Crackle{{-1, 1, 0}, 2, 0, true}, 3, {});
  refused(gradients, [](H& h, P&) { h.gradient_count = 0; });
  refused(gradients, [](H& h, P&) { h.feature_count = 0; });
  refused(gradients, [](H&, P& p) { p.table -= 128; });
  const Bytes waves = bytes_with(pattern::Waves{}, 0, {});
  refused(waves, [](H& h, P&) { h.wave_count = 5; });
  refused(waves, [](H&, P& p) { p.parameter[0] = 1e9f; });
  refused(waves, [](H&, P& p) { p.parameter[0] = 0; });
  refused(waves, [](H&, P& p) { p.table = kNoOffset; });
  refused(bytes_with(pattern::Fractal{}, 0, {}), [](H&, P& p) { p.parameter[2] = 1e9f; });
  const Bytes grey = bytes_with(pattern::Grey{std::make_shared<const Pigment>()}, 0, {});
  // The pigment's own pattern is the first, the one that asks it follows.
  const auto second = [](P& p) -> P& { return *(&p + 1); };
  refused(grey, [&](H&, P& p) { second(p).table += 64; });
  refused(grey, [&](H&, P& p) { second(p).table += sizeof(P); });
  refused(grey, [&](H&, P& p) { second(p).table += 2 * sizeof(P); });
  refused(grey, [&](H&, P& p) { second(p).kind_and_flags &= ~pattern_flag::nested; });
  refused(grey, [](H&, P& p) { p.entry_count = 0; });
  Object ball;
  ball.shape = Sphere{};
  const Bytes inside = bytes_with(pattern::Inside{std::make_shared<const Object>(ball)}, 0, {});
  refused(inside, [](H& h, P&) { h.csg_count = 0; });
  refused(inside, [](H&, P& p) { p.table += 16; });
  warp::BlackHole hole;
  hole.repeat = Vec3(2);
  hole.turbulence = Vec3(1);
  const Bytes holes = bytes_with(pattern::Bozo{}, 0, {hole});
  refused(holes, [](H& h, P&) { h.feature_count = 0; });
}

TEST_CASE("A sealed scene image with a fault in its textures is refused") {
  const Bytes good = bytes_of(SceneImage(scene_named("textures")));
  const auto refused = [&](const std::function<void(TextureRecords&)>& change) {
    Bytes bytes = good;
    TextureRecords records(bytes);
    change(records);
    REQUIRE(bytes != good);
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  using R = TextureRecords;
  SECTION("tables") {
    refused([](R& r) { r.h.pattern_count = 0x10000000; });
    refused([](R& r) { r.h.pattern_offset = 0xFFFFFF80; });
    refused([](R& r) { r.h.space_step_count = 0x10000000; });
    refused([](R& r) { r.h.map_entry_count = 0x10000000; });
    refused([](R& r) { r.h.normal_count = 0x10000000; });
    refused([](R& r) { r.h.pattern_count = 0; });
    refused([](R& r) { r.h.space_step_count = 0; });
    refused([](R& r) { r.h.map_entry_count = 0; });
    refused([](R& r) { r.h.normal_count = 0; });
  }
  SECTION("patterns") {
    refused([](R& r) { r.pattern(r.h.pattern_offset).kind_and_flags |= pattern_flag::kind_mask; });
    refused([](R& r) {
      r.pattern(r.h.pattern_offset).kind_and_flags = pattern_flag::average | Patterns::kCount;
    });
    refused([](R& r) { r.pattern(r.h.pattern_offset).turbulence.octaves = 11; });
    refused([](R& r) { r.pattern(r.material(material_flag::patterned).pattern).entries += 16; });
    refused([](R& r) { r.pattern(r.material(material_flag::patterned).pattern).entries = kNoOffset; });
    refused([](R& r) { r.pattern(r.material(material_flag::patterned).pattern).entry_count = 0xFFFFFFFF; });
    refused([](R& r) { r.pattern(r.material(material_flag::patterned).pattern).entry_count = 0; });
    refused([](R& r) { r.pattern(r.material(material_flag::mapped).pattern).entry_count = 0; });
  }
  SECTION("steps") {
    refused([](R& r) { r.stepped().steps += 64; });
    refused([](R& r) { r.stepped().steps = 0; });
    refused([](R& r) { r.stepped().step_count = 0xFFFFFFFF; });
    refused(
        [](R& r) { table<SpaceStepRecord>(r.b, r.h.space_step_offset)->turbulence.octaves = 0xFFFFFFFF; });
  }
  SECTION("entries, and maps that contain themselves") {
    refused([](R& r) { r.nest(r.material(material_flag::patterned).pattern, 0); });
    refused([](R& r) { r.entry_of(r.material(material_flag::mapped).pattern).child = kNoOffset; });
    refused([](R& r) { r.entry_of(r.normal(true).pattern).child += 32; });
    refused([](R& r) {
      const std::uint32_t pattern = r.material(material_flag::patterned).pattern;
      r.nest(pattern, pattern);
    });
    refused([](R& r) {
      const MaterialRecord& material = r.material(material_flag::mapped);
      r.entry_of(material.pattern).child = r.offset_of(material);
    });
    refused([](R& r) {
      const NormalRecord& normal = r.normal(true);
      r.entry_of(normal.pattern).child = r.offset_of(normal);
    });
  }
  SECTION("normals") {
    refused([](R& r) { r.normal(false).pattern = kNoOffset; });
    refused([](R& r) { r.normal(true).pattern += 64; });
    refused([](R& r) { r.pattern(r.normal(true).pattern).entry_count = 0; });
  }
  SECTION("materials, and layers that go round") {
    refused([](R& r) { r.material(material_flag::patterned).pattern += 64; });
    refused([](R& r) { r.material(material_flag::mapped).pattern = kNoOffset; });
    refused([](R& r) { r.material(material_flag::disturbed).normal = kNoOffset; });
    refused([](R& r) { r.material(material_flag::layered).below += 64; });
    refused([](R& r) { r.material(material_flag::layered).below = kNoOffset; });
    refused([](R& r) {
      MaterialRecord& material = r.material(material_flag::layered);
      material.below = r.offset_of(material);
    });
    refused([](R& r) {
      const std::uint32_t top = r.offset_of(r.material(material_flag::layered));
      MaterialRecord& below = *table<MaterialRecord>(r.b, r.material(material_flag::layered).below);
      below.flags |= material_flag::layered;
      below.below = top;
    });
    refused([](R& r) { // a texture map is no layer
      MaterialRecord& material = r.material(material_flag::mapped);
      material.flags |= material_flag::layered;
      material.below = r.offset_of(material) + std::uint32_t{sizeof(MaterialRecord)};
    });
  }
  SECTION("sky") {
    refused([](R& r) { r.h.sky += 64; });
    refused([](R& r) { r.h.sky = 0; });
    refused([](R& r) { r.h.sky = r.offset_of(r.material(material_flag::mapped)); });
    refused([](R& r) {
      MaterialRecord& top = *table<MaterialRecord>(r.b, r.h.sky);
      table<MaterialRecord>(r.b, top.below)->below = r.h.sky;
    });
    refused([](R& r) {
      MaterialRecord& top = *table<MaterialRecord>(r.b, r.h.sky);
      top.flags &= ~material_flag::layered;
      top.below = r.h.sky;
    });
  }
}

TEST_CASE("A sealed scene image that asks for more of surfaces than is found out is refused") {
  const Bytes good = bytes_of(SceneImage(scene_named("surfaces")));
  CHECK_NOTHROW(SceneImage::from_bytes(good));
  const auto refused = [&](const std::function<void(Bytes&, ImageHeader&)>& change) {
    Bytes bytes = good;
    change(bytes, *table<ImageHeader>(bytes, 0));
    REQUIRE(bytes != good);
    seal(bytes);
    CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
  };
  const auto object_with = [](Bytes& bytes, const ImageHeader& h, std::uint32_t flags) {
    auto* objects = table<ObjectRecord>(bytes, h.object_offset);
    while ((objects->kind_and_flags & flags) != flags)
      ++objects;
    return objects;
  };
  refused([](Bytes&, ImageHeader& h) { h.light_features &= ~light_feature::by_surface; });
  refused([](Bytes&, ImageHeader& h) { h.light_features &= ~light_feature::stepwise; });
  refused([&](Bytes& b, ImageHeader& h) {
    object_with(b, h, object_flag::by_surface)->kind_and_flags &= ~object_flag::by_surface;
  });
  refused([&](Bytes& b, ImageHeader& h) {
    object_with(b, h, object_flag::by_surface | object_flag::blended)->kind_and_flags &=
        ~object_flag::by_surface;
  });
  refused([&](Bytes& b, ImageHeader& h) {
    object_with(b, h, object_flag::by_surface | static_cast<std::uint32_t>(ObjectKind::triangle))->extra += 4;
  });
  refused([&](Bytes& b, ImageHeader& h) { // the sky has no surface
    h.sky = material_word::offset(object_with(b, h, object_flag::by_surface)->material);
  });
}

TEST_CASE("Surface coordinates of a mesh are in its image where a material asks for them") {
  Scene scene = scene_named("surfaces");
  const SceneImage image(scene);
  const ImageHeader& h = image.header();
  const auto* objects = table<ObjectRecord>(image, h.object_offset);
  int mapped = 0;
  for (std::uint32_t i = 0; i < h.object_count; ++i) {
    if ((objects[i].kind_and_flags & object_flag::kind_mask) !=
        static_cast<std::uint32_t>(ObjectKind::triangle))
      continue;
    ++mapped;
    REQUIRE((objects[i].kind_and_flags & object_flag::by_surface) != 0);
    REQUIRE(objects[i].extra != kNoOffset);
    const float(&uv)[6] = table<ExtraRecord>(image, objects[i].extra)->bounds;
    CHECK(uv[0] == 0);
    CHECK(uv[1] == 0);
    CHECK(uv[2] == 1);
    CHECK(uv[5] == ((objects[i].kind_and_flags & object_flag::blended) != 0 ? 1 : 2));
  }
  CHECK(mapped == 2);
  for (Material& material : scene.materials)
    material = matte({1, 1, 1});
  const SceneImage plain(scene);
  CHECK((plain.header().light_features & (light_feature::by_surface | light_feature::stepwise)) == 0);
  auto mesh = std::make_shared<Mesh>(*std::get<std::shared_ptr<const Mesh>>(scene.objects.back().shape));
  mesh->coordinates.pop_back();
  scene.objects.back().shape = std::shared_ptr<const Mesh>(mesh);
  CHECK_THROWS_WITH(SceneImage(scene), Catch::Contains("surface coordinates"));
  Scene sky;
  Pigment pigment = scene_named("patterns").materials[0].pigment;
  auto map = std::make_shared<PatternMap<Pigment>>(*pigment.map);
  map->pattern.uv_mapping = true;
  pigment.map = map;
  sky.sky_sphere = {pigment};
  CHECK_THROWS_WITH(SceneImage(sky), Catch::Contains("no surface"));
}

TEST_CASE("Pigments say of themselves whether an entry is a map") {
  const SceneImage image(scene_of(nested_pigment(2)));
  Bytes bytes = bytes_of(image);
  TextureRecords records(bytes);
  PatternRecord& outer = records.pattern(records.material(material_flag::patterned).pattern);
  CHECK((outer.kind_and_flags & pattern_flag::nested) != 0);
  CHECK((records.pattern(records.entry_of(records.offset_of(outer)).child).kind_and_flags &
         pattern_flag::nested) == 0);
  outer.kind_and_flags &= ~pattern_flag::nested;
  seal(bytes);
  CHECK_THROWS_WITH(SceneImage::from_bytes(bytes), Catch::Contains("offset"));
}

TEST_CASE("Objects say whether secondary rays may leave them") {
  const auto spawns = [](const Material& material) {
    Scene scene;
    scene.objects = {sphere_at({0, 0, 0}, 1, scene.add(material), scene.add(Interior{}))};
    const SceneImage image(scene);
    const auto* object = table<ObjectRecord>(image, image.header().object_offset);
    return (object->material & material_word::spawns) != 0;
  };
  const Material plain = matte({1, 0.5, 0});
  Pigment clear;
  clear.transmit = 0.5;
  const auto with = [&](auto change) {
    Material material = plain;
    change(material);
    return spawns(material);
  };
  const auto mixed = [&](const Pigment& second) {
    return map_of<Pigment>({}, {{0, plain.pigment}, {1, second}});
  };
  CHECK_FALSE(spawns(plain));
  CHECK_FALSE(with([&](Material& m) { m.pigment.map = mixed(Pigment{}); }));
  CHECK_FALSE(with([&](Material& m) { m.normal = std::make_shared<const Normal>(); }));
  CHECK_FALSE(with([&](Material& m) { m.inside = std::make_shared<const Material>(plain); }));
  CHECK(with([&](Material& m) { m.pigment = clear; }));
  CHECK(with([&](Material& m) { m.pigment.map = mixed(clear); }));
  CHECK(with([&](Material& m) { m.pigment.map = mixed(around(clear)); }));
  CHECK(with([&](Material& m) { m.finish.reflection_max = {0, 0, 0.1}; }));
  // What comes through layers stays in them, as long as the lowest is opaque.
  const auto over = [&](const Material& below) {
    return with([&](Material& m) {
      m.pigment = clear;
      m.below = std::make_shared<const Material>(below);
    });
  };
  Material lowest = plain;
  CHECK_FALSE(over(lowest));
  lowest.finish.reflection_max = Vec3(0.1);
  CHECK(over(lowest));
  lowest = plain;
  lowest.pigment = clear;
  CHECK(over(lowest));
  CHECK(with([&](Material& m) { m.map = map_of<Material>({}, {{0, plain}}); }));
  CHECK(with([&](Material& m) {
    Material inside = plain;
    inside.pigment = clear;
    m.inside = std::make_shared<const Material>(inside);
  }));
}

TEST_CASE("Textures that are too deep or too long are refused by name") {
  const auto refused = [](const Scene& scene, const std::string& message) {
    CHECK_THROWS_WITH(validate(scene), message);
    CHECK_THROWS_WITH(SceneImage(scene), message);
  };
  SECTION("maps in maps") {
    CHECK_NOTHROW(SceneImage::from_bytes(bytes_of(SceneImage(scene_of(nested_pigment(kDeepestMap))))));
    refused(scene_of(nested_pigment(kDeepestMap + 1)), "material 0 has maps that nest more than 8 deep");
    Normal normal;
    Material material;
    for (int i = 0; i <= kDeepestMap; ++i) {
      normal.map = map_of<Normal>({}, {{0, normal}});
      material.map = map_of<Material>({}, {{0, material}});
    }
    refused(scene_of(material), "material 0 has maps that nest more than 8 deep");
    Material disturbed;
    disturbed.normal = std::make_shared<const Normal>(normal);
    refused(scene_of(disturbed), "material 0 has maps that nest more than 8 deep");
    Scene scene;
    scene.sky_sphere = {nested_pigment(kDeepestMap + 1)};
    refused(scene, "the sky sphere has maps that nest more than 8 deep");
  }
  SECTION("a map that is known to be sound, deeper inside another one") {
    Scene scene = scene_of(nested_pigment(kDeepestMap));
    const Pigment deep = scene.materials[0].pigment;
    scene.materials[0].pigment.map = map_of<Pigment>({}, {{0, deep.map->entries[0].value}, {1, deep}});
    refused(scene, "material 0 has maps that nest more than 8 deep");
  }
  SECTION("entries") {
    PatternMap<Pigment> map;
    Pigment pigment;
    map.entries.resize(kMostMapEntries, {0.5, Pigment{}});
    pigment.map = std::make_shared<const PatternMap<Pigment>>(map);
    CHECK_NOTHROW(SceneImage(scene_of(pigment)));
    map.entries.push_back({0.5, Pigment{}});
    pigment.map = std::make_shared<const PatternMap<Pigment>>(map);
    refused(scene_of(pigment), "material 0 has a map of more than 256 entries");
    map.entries.clear();
    pigment.map = std::make_shared<const PatternMap<Pigment>>(map);
    refused(scene_of(pigment), "material 0 has a map without entries");
  }
  SECTION("layers") {
    Material material;
    for (int i = 1; i < kMostLayers; ++i)
      material.below = std::make_shared<const Material>(material);
    CHECK_NOTHROW(SceneImage::from_bytes(bytes_of(SceneImage(scene_of(material)))));
    material.below = std::make_shared<const Material>(material);
    refused(scene_of(material), "material 0 has more than 64 layers");
    Scene scene;
    scene.sky_sphere.resize(kMostLayers);
    CHECK_NOTHROW(SceneImage::from_bytes(bytes_of(SceneImage(scene))));
    scene.sky_sphere.emplace_back();
    refused(scene, "the sky sphere has more than 64 layers");
    Material mapped, top;
    mapped.map = map_of<Material>({}, {{0, top}});
    top.below = std::make_shared<const Material>(mapped);
    refused(scene_of(top), "material 0 has a texture map for a layer");
  }
  SECTION("numbers") {
    Pigment pigment = around(Pigment{});
    const auto with = [&](const std::function<void(PatternMap<Pigment>&)>& change) {
      PatternMap<Pigment> map = *pigment.map;
      change(map);
      Pigment changed;
      changed.map = std::make_shared<const PatternMap<Pigment>>(map);
      return scene_of(changed);
    };
    const auto no_number = std::numeric_limits<double>::quiet_NaN();
    refused(with([&](auto& map) { map.entries[0].position = no_number; }),
            "material 0 has a number that is not finite");
    refused(with([&](auto& map) { map.entries[0].value.filter = no_number; }),
            "material 0 has a number that is not finite");
    refused(with([&](auto& map) { map.pattern.phase = no_number; }),
            "material 0 has a number that is not finite");
    refused(with([&](auto& map) { map.is_average = true; }),
            "material 0 has an average whose weights add up to 0");
    refused(with([&](auto& map) { map.pattern.turbulence.octaves = 11; }),
            "material 0 has turbulence whose octaves are not 1 to 10");
    refused(with([&](auto& map) { map.pattern.noise_generator = 4; }),
            "material 0 has a noise generator that is not 0 to 3");
  }
}

TEST_CASE("A map that several share is written once, and maps in several spaces end") {
  // Each level has the one below many times: in one space there is one of each.
  const auto pyramid = [](const Pattern& pattern) {
    Pigment pigment;
    for (int level = 0; level < kDeepestMap; ++level) {
      PatternMap<Pigment> map;
      map.pattern = pattern;
      for (int i = 0; i < kMostMapEntries; ++i) {
        pigment.rgb.x = i; // no two are the same
        map.entries.push_back({i / 256.0, pigment});
      }
      pigment.map = std::make_shared<const PatternMap<Pigment>>(map);
    }
    return scene_of(pigment);
  };
  const SceneImage image(pyramid({}));
  CHECK(image.header().pattern_count == std::uint32_t{kDeepestMap});
  CHECK(image.header().map_entry_count == std::uint32_t{kDeepestMap * kMostMapEntries});
  CHECK_NOTHROW(SceneImage::from_bytes(bytes_of(image)));

  Pattern moved;
  moved.space = {Transform::scale({1, 2, 3})};
  CHECK_NOTHROW(validate(pyramid(moved)));
  CHECK_THROWS_WITH(SceneImage(pyramid(moved)),
                    "all textures together have more than 4194304 entries of maps");
  moved.space.clear();
  for (int i = 0; i < 64; ++i)
    moved.space.emplace_back(Turbulence{{0.1, 0.1, 0.1}});
  CHECK_THROWS_WITH(SceneImage(pyramid(moved)),
                    "all textures together have more than 4194304 warps of patterns");
}

TEST_CASE("Entries of a map that are the same as the one before share its records and are not blended") {
  Pigment noisy;
  PatternMap<Pigment> noise;
  noise.pattern.kind = pattern::Bozo{};
  noise.entries = {{0, {{1, 0, 0}}}, {1, {{0, 1, 0}}}};
  noisy.map = std::make_shared<const PatternMap<Pigment>>(noise);
  Material matt, shiny;
  matt.pigment = shiny.pigment = noisy;
  shiny.finish.phong = 1;
  PatternMap<Material> map;
  map.entries = {{0, matt}, {0.25, matt}, {0.5, shiny}, {0.75, shiny}, {1, matt}};
  Material mapped;
  mapped.map = std::make_shared<const PatternMap<Material>>(map);
  Bytes bytes = bytes_of(SceneImage(scene_of(mapped)));
  TextureRecords records(bytes);
  const MapEntryRecord* const entries = &records.entry_of(records.material(material_flag::mapped).pattern);
  CHECK(entries[1].child == entries[0].child);
  CHECK(entries[2].child != entries[1].child);
  CHECK(entries[3].child == entries[2].child);
  CHECK(entries[4].child != entries[0].child);
  const float widths[] = {0, 0, 4, 0, 4}, positions[] = {0, 0.25f, 0.5f, 0.75f, 1};
  for (int i = 0; i < 5; ++i) {
    INFO("entry " << i);
    CHECK(entries[i].inverse_width == widths[i]);
    CHECK(entries[i].position == positions[i]);
  }
}
