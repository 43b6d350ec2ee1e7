// Renderer from frame to frame: progress, cancelling, reuse, statistics, options.
#include "celltrace/error.hpp"
#include "render/backends.hpp"
#include "render/report_pace.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

#include <functional>
#include <stdexcept>

using namespace celltrace;
using namespace celltrace::test;

namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;

/// Narrow and fast backends: what is tested here has nothing to do with SIMD.
std::vector<TestBackend> one_of_each() {
  return {backends().front(), backends().back()};
}

Image picture(const Scene& scene, int width = kWidth, int height = kHeight) {
  return render(scene, backends().front().options(width, height, 1)).image;
}

/// All the work lies in the lower right half: strips of equal height are far from balanced.
Scene uneven() {
  Scene scene = scene_named("glass and mirrors");
  scene.camera = camera_at({0, 3.5, -6}, {0, 3.2, 0});
  scene.max_trace_level = 20;
  return scene;
}

void check_complete(const RenderResult& result, const TestBackend& backend, const Image& expected) {
  REQUIRE(result.complete);
  REQUIRE(result.statistics.spu == backend.spu());
  CHECK(result.image == expected);
}

/// Enough triangles for runs.
Scene large_scene() {
  Scene scene = scene_named("glass and mirrors");
  Mesh mesh;
  for (int i = 0; i < 5000; ++i) {
    const float x = static_cast<float>(i % 71) * 0.1f - 3.5f;
    const float y = static_cast<float>(i / 71) * 0.1f - 3.5f;
    const auto first = static_cast<Index>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {{x, y, 5}, {x + 0.08f, y, 5.1f}, {x, y + 0.08f, 5.2f}});
    mesh.triangles.push_back({{first, first + 1, first + 2}});
  }
  scene.objects.push_back(mesh_object(mesh, 0, 0));
  return scene;
}

} // namespace

TEST_CASE("Progress starts at 0, never falls and ends at 1") {
  const Scene scene = scene_named("glass and mirrors");
  for (const TestBackend& backend : one_of_each()) {
    for (unsigned spes : {1u, 5u}) {
      INFO(backend.spu() << " with " << spes);
      Renderer renderer(backend.options(kWidth, kHeight, spes));
      for (int frame = 0; frame < 3; ++frame) {
        std::vector<double> fractions;
        const RenderResult result = renderer.render(scene, [&](double fraction) {
          fractions.push_back(fraction);
          return true;
        });
        REQUIRE(result.complete);
        check_completed(fractions);
      }
    }
  }
}

TEST_CASE("Statistics agree with each other") {
  const Scene scene = scene_named("glass and mirrors");
  // The work is the same everywhere, by the same accelerator; but secondary rays share packets on `native`.
  const auto options_of = [](const TestBackend& backend, unsigned spes) {
    RenderOptions options = backend.options(kWidth, kHeight, spes);
    options.accelerator = Accelerator::grid;
    return options;
  };
  const RenderStatistics expected = render(scene, options_of(backends().front(), 1)).statistics;
  for (const TestBackend& backend : backends()) {
    INFO(backend.spu());
    const bool shares_packets = backend.backend == Backend::native;
    // SPEs walk where translucent surfaces may be near each other.
    const RenderStatistics alone =
        shares_packets ? expected : render(scene, options_of(backend, 1)).statistics;
    Renderer renderer(options_of(backend, 3));
    for (int frame = 0; frame < 2; ++frame) {
      const RenderStatistics s = renderer.render(scene).statistics;
      CHECK(s.accelerator == Accelerator::grid);
      CHECK(s.backend == backend.backend);
      CHECK(s.spu == backend.spu());
      CHECK(s.width == kWidth);
      CHECK(s.height == kHeight);
      CHECK(s.objects == 8); // six spheres, two triangles
      CHECK(s.primary_rays == kWidth * kHeight);
      CHECK(s.shadow_rays == expected.shadow_rays);
      CHECK(s.reflection_rays == expected.reflection_rays);
      CHECK(s.refraction_rays == expected.refraction_rays);
      CHECK(s.dropped_rays == 0);
      CHECK(s.packet_tests == alone.packet_tests);
      CHECK(s.packet_tests.at("ellipsoid") == 0);
      CHECK(s.accelerator_visits == alone.accelerator_visits);
      CHECK(s.accelerator_list_entries >= s.objects);

      std::uint64_t rays = 0;
      std::uint64_t packets = 0;
      std::uint64_t exchanges = 0;
      std::uint64_t most = 0;
      for (const RenderStatistics::Spe& spe : s.spes) {
        rays += spe.rays;
        packets += spe.packets;
        exchanges += spe.exchanges;
        most = std::max(most, spe.rays);
        CHECK(spe.local_store_peak <= 256 * 1024);
        CHECK(spe.local_store_peak > 0);
      }
      CHECK(rays == s.total_rays());
      CHECK(packets == kWidth / 4 * (kHeight / 4));
      CHECK(exchanges == s.balance_exchanges);
      CHECK(s.balance_units_moved >= s.balance_exchanges);
      CHECK(s.imbalance == Approx(static_cast<double>(most) * 3 / static_cast<double>(rays) - 1));

      const bool cached = backend.backend == Backend::cell_emu;
      for (const auto& cache : {s.list_cache, s.object_cache, s.material_cache, s.light_cache}) {
        CHECK((cache.hits + cache.misses != 0) == cached);
        CHECK(cache.hit_rate() <= 1);
      }
      if (cached) {
        CHECK(s.object_cache.hit_rate() > 0.9);
        CHECK(s.dma_bytes_read > 0);
        CHECK(s.dma_bytes_written >= kWidth * kHeight * 4);
      }
    }
  }
}

TEST_CASE("Statistics are of their frame alone") {
  const Scene scene = scene_named("glass and mirrors");
  RenderOptions options = TestBackend{Backend::cell_emu, SimdLevel::automatic}.options(kWidth, kHeight, 1);
  options.balance = Balance::fixed; // cuts the work of all frames alike
  Renderer renderer(options);
  const RenderStatistics first = renderer.render(scene).statistics;
  for (int frame = 0; frame < 2; ++frame) {
    const RenderStatistics s = renderer.render(scene.camera).statistics;
    CHECK(s.dma_bytes_written == first.dma_bytes_written);
    CHECK(s.dma_bytes_read <= first.dma_bytes_read); // the cache is warm
    CHECK(s.dma_bytes_read > 0);
    CHECK(s.prepare_seconds == 0);
    CHECK(s.prepare_cycles == 0);
  }
}

TEST_CASE("The cache's shape changes the misses, not the picture") {
  const Scene scene = scene_named("meshes");
  const Image expected = picture(scene);
  CacheConfig off;
  off.enabled = false;
  CacheConfig tiny;
  tiny.ways = 1;
  tiny.sets = 2;
  CacheConfig full;
  full.ways = 64;
  full.sets = 1;
  full.replacement = CacheReplacement::lru;
  CacheConfig fifo;
  fifo.ways = 2;
  fifo.sets = 16;
  fifo.replacement = CacheReplacement::fifo;
  for (const CacheConfig& cache : {off, tiny, full, fifo}) {
    RenderOptions options = TestBackend{Backend::cell_emu, SimdLevel::automatic}.options(kWidth, kHeight, 2);
    options.cache = cache;
    const RenderResult result = render(scene, options);
    CHECK(result.statistics.spu == "cell_emu");
    CHECK(result.image == expected);
    CHECK((result.statistics.object_cache.hits == 0) == !cache.enabled);
  }
}

TEST_CASE("Deep trees spill to main memory") {
  const Scene scene = scene_named("half mirrors");
  const RenderResult deep =
      render(scene, TestBackend{Backend::cell_emu, SimdLevel::automatic}.options(kWidth, kHeight, 2));
  CHECK(deep.statistics.spilled_packets > 0);
  CHECK(deep.statistics.dma_bytes_written > 250'000);
  CHECK(deep.statistics.dropped_rays == 0);
  RenderOptions options = TestBackend{Backend::cell_emu, SimdLevel::automatic}.options(kWidth, kHeight, 2);
  options.max_trace_level = 3;
  const RenderResult shallow = render(scene, options);
  CHECK(shallow.statistics.spilled_packets == 0);
  CHECK(shallow.statistics.dma_bytes_written < 50'000);
  CHECK(shallow.statistics.total_rays() < deep.statistics.total_rays());
}

TEST_CASE("The options' limits replace the scene's") {
  Scene scene = scene_named("glass and mirrors");
  RenderOptions options = backends().front().options(kWidth, kHeight, 2);
  options.max_trace_level = 2;
  options.adc_bailout = 0.05;
  const Image by_options = render(scene, options).image;
  scene.max_trace_level = 2;
  scene.adc_bailout = 0.05;
  CHECK(by_options == picture(scene));
  CHECK(by_options != picture(scene_named("glass and mirrors")));
}

TEST_CASE("Work moves to SPEs that have run dry") {
  const Scene scene = uneven();
  const Image expected = picture(scene, 120, 90);
  for (const TestBackend& backend : one_of_each()) {
    std::uint64_t exchanges = 0;
    for (int attempt = 0; attempt < 10 && exchanges == 0; ++attempt) {
      const RenderResult result = render(scene, backend.options(120, 90, 8));
      check_complete(result, backend, expected);
      exchanges = result.statistics.balance_exchanges;
    }
    INFO(backend.spu());
    CHECK(exchanges > 0);
    RenderOptions options = backend.options(120, 90, 8);
    options.balance = Balance::fixed;
    const RenderResult fixed = render(scene, options);
    check_complete(fixed, backend, expected);
    CHECK(fixed.statistics.balance_exchanges == 0);
  }
}

TEST_CASE("Pictures of any size, also with more SPEs than rows") {
  const Scene scene = scene_named("highlights");
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {5, 7}, {4, 64}, {66, 3}, {31, 33}}) {
    const Image expected = picture(scene, width, height);
    for (const TestBackend& backend : one_of_each())
      for (unsigned spes : {2u, 16u}) {
        INFO(backend.spu() << " with " << spes << ": " << width << "x" << height);
        Renderer renderer(backend.options(width, height, spes));
        for (int frame = 0; frame < 20; ++frame)
          check_complete(renderer.render(scene), backend, expected);
      }
  }
}

TEST_CASE("One Renderer's later frames are as those of a fresh one") {
  for (const TestBackend& backend : one_of_each()) {
    INFO(backend.spu());
    const auto fresh = [&](const Scene& scene) {
      return render(scene, backend.options(kWidth, kHeight, 1)).image;
    };
    Renderer renderer(backend.options(kWidth, kHeight, 4));
    for (const NamedScene& named : scenes()) {
      INFO(named.name);
      Scene scene = named.make();
      check_complete(renderer.render(scene), backend, fresh(scene));
      scene.camera = camera_at({0.5, 0.7, -4.5}, {0.1, 0.2, 0});
      check_complete(renderer.render(scene.camera), backend, fresh(scene));
      scene.camera = orthographic_camera({1, 2, -9}, {0, 0, 0}, 7);
      check_complete(renderer.render(scene.camera), backend, fresh(scene));
    }
  }
}

TEST_CASE("A later scene may need other things in local store, at the same place in memory") {
  const char* const kNeeds[] = {"soft shadows", "dimmed lights", "surfaces", "highlights"};
  for (const TestBackend& backend : one_of_each())
    for (const char* first : kNeeds)
      for (const char* second : kNeeds) {
        INFO(backend.spu() << ": " << first << ", " << second);
        Renderer renderer(backend.options(kWidth, kHeight, 2));
        // The larger image first, so that both have room in one place.
        Scene before = scene_named(first), after = scene_named(second);
        before.max_trace_level = after.max_trace_level = 5;
        before.objects.push_back(mesh_object(ball_mesh(20), 0, before.objects[0].interior));
        renderer.render(before);
        check_complete(renderer.render(after), backend, picture(after));
      }
}

TEST_CASE("A later scene may need deeper trees") {
  Scene scene = scene_named("half mirrors");
  for (const TestBackend& backend : one_of_each()) {
    Renderer renderer(backend.options(kWidth, kHeight, 4));
    for (int level : {5, 30, 100, 2, 60}) {
      INFO(backend.spu() << ", level " << level);
      scene.max_trace_level = level;
      check_complete(renderer.render(scene), backend, picture(scene));
    }
  }
}

TEST_CASE("A later scene's soft shadows know nothing of the objects before") {
  const auto below = [](int objects, const std::function<decltype(Object::shape)(int)>& shape) {
    Scene scene;
    scene.camera = camera_at({0, 1, -4}, {0, 0, 0});
    Light light{{0, 20, 0}};
    light.area = LightArea{{2, 0, 0}, {0, 0, 2}, 5, 5, 1};
    scene.lights.push_back(light);
    Object object;
    object.interior = scene.add(Interior{});
    object.material = scene.add(matte({1, 1, 1}));
    object.shape = Plane{{0, 1, 0}, 0};
    scene.objects.push_back(object);
    for (int i = 0; i < objects; ++i) {
      object.shape = shape(i);
      scene.objects.push_back(object);
    }
    return scene;
  };
  // Sheets that leave no light, and fewer specks that leave most of it, but are too many to be gathered.
  // Records of the sheets are still there behind those of the specks.
  const Scene dark = below(400, [](int i) {
    return Box{{{-20, 2 + 0.02 * i, -20}, {20, 2.01 + 0.02 * i, 20}}};
  });
  const Scene lit = below(30, [](int i) {
    return Sphere{{0.1 * (i % 6) - 0.3, 19, 0.1 * (i / 6) - 0.2}, 0.02};
  });
  for (const TestBackend& backend : one_of_each()) {
    INFO(backend.spu());
    // Several SPEs: the one that builds the BVH starts afresh for every scene, the others do not.
    Renderer renderer(backend.options(32, 24, 4));
    for (const Scene& scene : {dark, lit})
      check_complete(renderer.render(scene), backend, picture(scene, 32, 24));
  }
}

TEST_CASE("A cancelled frame is broken off, and the next one is as usual") {
  const Scene scene = uneven();
  const Image expected = picture(scene);
  for (const TestBackend& backend : one_of_each()) {
    for (unsigned spes : {1u, 8u}) {
      INFO(backend.spu() << " with " << spes);
      Renderer renderer(backend.options(kWidth, kHeight, spes));
      for (double limit : {0.0, 0.2, 0.6, 0.9}) {
        double last = -1;
        const RenderResult result = renderer.render(scene, [&](double fraction) {
          last = fraction;
          return fraction < limit;
        });
        CHECK_FALSE(result.complete);
        CHECK(last >= limit);
        CHECK(last < 1);
        CHECK(result.image.width == kWidth);
        check_complete(renderer.render(scene), backend, expected);
        // Only the camera's frame is broken off.
        CHECK_FALSE(renderer.render(scene.camera, [](double) { return false; }).complete);
        check_complete(renderer.render(scene.camera), backend, expected);
      }
    }
  }
}

TEST_CASE("On the host an SPE says little where nobody asks how far it is") {
  const Scene scene = uneven();
  Renderer renderer(backends().front().options(kWidth, kHeight, 1));
  const auto words = [&](const Progress& progress) {
    return renderer.render(scene.camera, progress).statistics.mailbox_words;
  };
  renderer.render(scene);
  CHECK(words({}) <= 2);
  CHECK(words([](double) { return true; }) > 2);
  CHECK(words({}) <= 2);
}

TEST_CASE("Pixels of a cancelled frame are finished or transparent black") {
  const Scene scene = scene_named("glass and mirrors");
  const Image expected = picture(scene);
  Renderer renderer(backends().back().options(kWidth, kHeight, 2));
  const RenderResult result = renderer.render(scene, [](double fraction) { return fraction < 0.4; });
  int finished = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const std::uint8_t* p = result.image.pixel(x, y);
      const bool untouched = p[0] == 0 && p[1] == 0 && p[2] == 0 && p[3] == 0;
      if (untouched) continue;
      ++finished;
      REQUIRE(std::equal(p, p + 4, expected.pixel(x, y)));
    }
  CHECK(finished >= kWidth * kHeight * 4 / 10);
}

TEST_CASE("SPEs tell of their progress as often as passes are long") {
  constexpr std::uint32_t kUnits = 10000;
  ReportPace pace;
  const auto words = [&] { return kUnits / pace.units_per_word(kUnits); };
  CHECK(words() == 15); // nothing is known
  pace.learn(kUnits / 10, 0.0001);
  CHECK(words() == 7);
  pace.learn(kUnits / 10, 0.05);
  CHECK(words() == 24);
  pace.learn(kUnits, 1000);
  CHECK(words() == 63);
  pace.learn(0, 0);
  CHECK(pace.units_per_word(0) == 1);
}

TEST_CASE("What the progress function throws passes through, and the next frame is as usual") {
  const Scene scene = scene_named("glass and mirrors");
  const Image expected = picture(scene);
  for (const TestBackend& backend : one_of_each()) {
    for (double limit : {0.0, 0.3, 1.0}) {
      INFO(backend.spu() << " at " << limit);
      Renderer renderer(backend.options(kWidth, kHeight, 4));
      const auto fail = [&](double fraction) -> bool {
        if (fraction >= limit) throw std::domain_error("enough");
        return true;
      };
      CHECK_THROWS_AS(renderer.render(scene, fail), std::domain_error);
      check_complete(renderer.render(scene), backend, expected);
      CHECK_THROWS_AS(renderer.render(scene, fail), std::domain_error);
    }
  }
}

TEST_CASE("Building says how far it is, and can be cancelled") {
  const Scene scene = large_scene();
  const Image expected = render(scene, backends().front().options(kWidth, kHeight, 2)).image;
  for (const TestBackend& backend : one_of_each()) {
    for (Accelerator accelerator : {Accelerator::bvh, Accelerator::grid}) {
      INFO(backend.spu());
      std::vector<double> fractions;
      double limit = 2;
      RenderOptions options = backend.options(kWidth, kHeight, 2);
      options.accelerator = accelerator;
      options.build_progress = [&](double fraction) {
        fractions.push_back(fraction);
        if (limit < 0) throw std::domain_error("enough");
        return fraction < limit;
      };
      Renderer renderer(options);
      CHECK(renderer.render(scene).image == expected);
      CHECK(fractions.front() == 0);
      CHECK(fractions.back() == 1);
      CHECK(std::is_sorted(fractions.begin(), fractions.end()));
      for (double end : {0.0, 0.2, 1.0, -1.0}) {
        limit = end;
        if (end < 0) {
          CHECK_THROWS_AS(renderer.render(scene), std::domain_error);
        } else {
          const RenderResult cancelled = renderer.render(scene);
          CHECK_FALSE(cancelled.complete);
          CHECK(cancelled.statistics.total_rays() == 0);
          const auto& pixels = cancelled.image.rgba;
          CHECK(pixels.size() == std::size_t{kWidth} * kHeight * 4);
          CHECK(std::all_of(pixels.begin(), pixels.end(), [](std::uint8_t byte) { return byte == 0; }));
        }
        CHECK_THROWS_AS(renderer.render(scene.camera), InputError);
      }
      limit = 2;
      CHECK(renderer.render(scene).image == expected);
      // It is of building alone.
      fractions.clear();
      renderer.render(scene.camera);
      CHECK(fractions.empty());
    }
  }
}

TEST_CASE("Who hears of rendering alone can end building, too") {
  const Scene scene = large_scene();
  for (const TestBackend& backend : one_of_each()) {
    INFO(backend.spu());
    Renderer renderer(backend.options(kWidth, kHeight, 2));
    int left = -1;
    const auto count = [&](double) { return left < 0 || left-- > 0; };
    const Image expected = renderer.render(scene, count).image;
    bool built = false;
    for (int calls = 0; !built; calls = 2 * calls + 1) {
      left = calls;
      const RenderResult result = renderer.render(scene, count);
      left = -1;
      // A scene that is built stays, even if the frame was cancelled before its first ray.
      try {
        const Image image = renderer.render(scene.camera).image;
        built = true;
        CHECK(image == expected);
      } catch (const InputError&) {
        CHECK_FALSE(result.complete);
        CHECK(result.statistics.total_rays() == 0);
      }
    }
    CHECK(renderer.render(scene, count).image == expected);
  }
}

TEST_CASE("A change that is cancelled half-way is made anew") {
  Scene scene = large_scene();
  for (const TestBackend& backend : one_of_each()) {
    INFO(backend.spu());
    Renderer renderer(backend.options(kWidth, kHeight, 2));
    const SceneChanges changes;
    renderer.render(scene, changes);
    for (Object& object : scene.objects)
      object.transform = Transform::translate({0.1, 0, 0});
    for (int calls = 0; calls < 12; ++calls) {
      int left = calls;
      renderer.render(scene, changes, [&](double) { return left-- > 0; });
    }
    CHECK(renderer.render(scene, changes).image == render(scene, backend.options(kWidth, kHeight, 2)).image);
  }
}

TEST_CASE("A frame that is out of time is broken off, and the next one is as usual") {
  const Scene scene = scene_named("highlights");
  for (const TestBackend& backend : backends()) {
    RenderOptions options = backend.options(kWidth, kHeight, 2);
    options.most_seconds = 1e-9;
    Renderer renderer(options);
    const RenderResult result = renderer.render(scene);
    CHECK_FALSE(result.complete);
    CHECK(result.image.width == kWidth);
    options.most_seconds = 1e9;
    Renderer patient(options);
    CHECK(patient.prepare(scene));
    CHECK(patient.render(scene).complete);
    CHECK(patient.render(scene.camera).image == render(scene, backend.options(kWidth, kHeight, 2)).image);
    // The caller's own function is asked as well.
    CHECK_FALSE(patient.render(scene, [](double) { return false; }).complete);
  }
}

TEST_CASE("A scene that takes more memory than is allowed is refused") {
  Scene scene = scene_named("highlights");
  const Object object = scene.objects.front();
  scene.objects.resize(1000, object);
  RenderOptions options = backends().front().options(kWidth, kHeight, 2);
  options.most_memory = static_cast<std::uint64_t>(kWidth) * kHeight * 4;
  Renderer renderer(options);
  CHECK_THROWS_AS(renderer.render(scene), InputError);
  options.most_memory = 1 << 30;
  CHECK(render(scene, options).complete);
}

TEST_CASE("A Renderer can be moved") {
  const Scene scene = scene_named("highlights");
  Renderer first(backends().front().options(kWidth, kHeight, 2));
  first.render(scene);
  Renderer second = std::move(first);
  CHECK(second.render(scene.camera).image == picture(scene));
}

TEST_CASE("Options out of range are refused") {
  const auto refuses = [](auto change) {
    RenderOptions options = backends().front().options(16, 16, 1);
    change(options);
    CHECK_THROWS_AS(Renderer(options), InputError);
  };
  refuses([](RenderOptions& o) { o.width = 0; });
  refuses([](RenderOptions& o) { o.width = -4; });
  refuses([](RenderOptions& o) { o.height = 0; });
  refuses([](RenderOptions& o) { o.width = 65536; });
  refuses([](RenderOptions& o) { o.height = 65536; });
  refuses([](RenderOptions& o) { o.width = o.height = 65520; }); // more pixels than an Image has
  refuses([](RenderOptions& o) { o.backend = static_cast<Backend>(7); });
  refuses([](RenderOptions& o) { o.simd = static_cast<SimdLevel>(77); });
  refuses([](RenderOptions& o) { o.spes = 257; });
  refuses([](RenderOptions& o) { o.cache.ways = 3; });
  refuses([](RenderOptions& o) { o.cache.sets = 100; });
  refuses([](RenderOptions& o) { o.max_trace_level = 0; });
  refuses([](RenderOptions& o) { o.max_trace_level = 257; });
  refuses([](RenderOptions& o) { o.adc_bailout = -0.1; });
  refuses([](RenderOptions& o) { o.most_seconds = -1; });
  refuses([](RenderOptions& o) { o.most_seconds = std::numeric_limits<double>::quiet_NaN(); });
  refuses([](RenderOptions& o) { o.most_memory = 16 * 16 * 4 - 1; });
  refuses([](RenderOptions& o) {
    o.most_memory = 16 * 16 * 4;
    o.colours = true;
  });
  refuses([](RenderOptions& o) { o.adc_bailout = std::numeric_limits<double>::quiet_NaN(); });
}

TEST_CASE("Scenes and cameras that cannot be rendered are refused, and the Renderer goes on") {
  const Scene good = scene_named("highlights");
  const Image expected = picture(good);
  for (const TestBackend& backend : one_of_each()) {
    Renderer renderer(backend.options(kWidth, kHeight, 2));
    CHECK_THROWS_AS(renderer.render(good.camera), InputError); // no scene yet
    const auto refuses = [&](auto change) {
      Scene scene = good;
      change(scene);
      CHECK_THROWS_AS(renderer.render(scene), InputError);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    refuses([](Scene& s) { s.objects[1].material = 1000; });
    refuses([](Scene& s) { s.objects[1].interior = 1000; });
    refuses([&](Scene& s) { s.camera.location.x = nan; });
    refuses([](Scene& s) {
      s.objects[1].transform = Transform::matrix({1, 2, 3, 2, 4, 6, 0, 0, 1, 0, 0, 0});
    });
    refuses([](Scene& s) { s.objects[1].shape = std::shared_ptr<const Mesh>(); });
    check_complete(renderer.render(good), backend, expected);
    Camera camera = good.camera;
    camera.direction.y = nan;
    CHECK_THROWS_AS(renderer.render(camera), InputError);
    check_complete(renderer.render(good.camera), backend, expected);
  }
}

TEST_CASE("A refused scene leaves the one before in place") {
  const Scene good = scene_named("highlights");
  Renderer renderer(backends().front().options(kWidth, kHeight, 2));
  renderer.render(good);
  Scene bad = good;
  bad.objects[1].material = 1000;
  CHECK_THROWS_AS(renderer.render(bad), InputError);
  CHECK(renderer.render(good.camera).image == picture(good));
}

TEST_CASE("Both accelerators show the same, built by one SPE or by many, also of many triangles") {
  Scene scene = scene_named("glass and mirrors");
  const Mesh ball = ball_mesh(40); // 6,400 triangles: enough for several SPEs
  REQUIRE(ball.triangles.size() > 4096);
  scene.objects.push_back(mesh_object(ball, 0, 0));
  RenderOptions options = backends().front().options(kWidth, kHeight, 1);
  options.accelerator = Accelerator::grid;
  const RenderResult by_grid = render(scene, options);
  CHECK(by_grid.statistics.accelerator == Accelerator::grid);
  CHECK(by_grid.statistics.bvh_nodes == 0);
  std::uint32_t nodes = 0;
  for (const TestBackend& backend : one_of_each()) {
    for (unsigned spes : {1u, 3u, 8u}) {
      INFO(backend.spu() << " with " << spes);
      options = backend.options(kWidth, kHeight, spes);
      options.accelerator = Accelerator::bvh;
      Renderer renderer(options);
      for (int frame = 0; frame < 2; ++frame) {
        const RenderResult result = renderer.render(scene);
        check_complete(result, backend, by_grid.image);
        const RenderStatistics& s = result.statistics;
        CHECK(s.accelerator == Accelerator::bvh);
        CHECK(s.grid_cells[0] == 0);
        CHECK(s.accelerator_list_entries == s.objects);
        CHECK(s.accelerator_bytes <= 64 * s.objects);
        if (nodes == 0) nodes = s.bvh_nodes;
        CHECK(s.bvh_nodes == nodes);
      }
    }
  }
}
