// Sessions: what changes is made anew, and the picture is that of a fresh render.
#include "celltrace/error.hpp"
#include "celltrace/session.hpp"
#include "render/all_machines.hpp"
#include "render/scenes.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <functional>
#include <random>
#include <stdexcept>
#include <thread>

using namespace celltrace;
using namespace celltrace::test;

namespace {

using Preparation = RenderStatistics::Preparation;

constexpr int kWidth = 64;
constexpr int kHeight = 48;

/// One of native, and the emulated one.
std::vector<TestBackend> one_of_each() {
  return {backends().front(), backends().back()};
}

Scene many_spheres(int count) {
  Scene scene = scene_named("glass and mirrors");
  scene.objects.clear();
  scene.camera = camera_at({0, 2, -14}, {0, 0, 0});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-5, 5), radius(0.05, 0.3);
  for (int i = 0; i < count; ++i) {
    Object object;
    object.shape = Sphere{{place(random), place(random), place(random)}, radius(random)};
    object.material = static_cast<Index>(i) % static_cast<Index>(scene.materials.size());
    object.interior = scene.add(Interior());
    scene.objects.push_back(object);
  }
  return scene;
}

/// An even sheet, bent by `phase`.
Mesh sheet(int side, float phase) {
  Mesh mesh;
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(side) - 0.5f;
      const float v = static_cast<float>(y) / static_cast<float>(side) - 0.5f;
      mesh.vertices.emplace_back(6 * u, 6 * v, 0.5f * std::sin(9 * u + phase) * std::cos(7 * v - phase));
    }
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto first = static_cast<Index>(y * (side + 1) + x);
      const auto above = first + static_cast<Index>(side) + 1;
      mesh.triangles.push_back({{first, first + 1, above}});
      mesh.triangles.push_back({{first + 1, above + 1, above}});
    }
  return mesh;
}

Scene bent_sheet(float phase, int side = 60) {
  Scene scene = many_spheres(40);
  scene.objects.push_back(mesh_object(sheet(side, phase), 0, 0));
  return scene;
}

/// The next frame is that of a fresh render.
RenderResult check_next(Session& session) {
  const RenderResult next = session.render();
  REQUIRE(next.complete);
  CHECK(next.statistics.diagnostics.empty());
  const RenderResult fresh = render(session.scene(), session.options());
  CHECK(next.image == fresh.image);
  CHECK(next.colours.rgba == fresh.colours.rgba);
  CHECK(next.first_hits.depth == fresh.first_hits.depth);
  CHECK(next.blocks.blocks == fresh.blocks.blocks);
  return next;
}

/// Cancels `times` frames of square pictures at moments that are spread over all that they take: those of
/// which only the camera is new, of which objects have moved, and of which everything is new. The next frame
/// is what it would have been.
void cancel_frames(const TestBackend& backend, const Scene& scene, int edge, int times, unsigned seed) {
  INFO(backend.spu());
  Session session(scene, backend.options(edge, edge, 2));
  const auto change = [&](int round) {
    if (round % 3 == 1) session.set_transform(static_cast<Index>(round) % 20, Transform());
    if (round % 3 == 2) session.replace(scene);
  };
  Image expected;
  std::chrono::duration<double, std::micro> longest[3];
  for (int round = 0; round < 6; ++round) {
    change(round);
    const auto start = std::chrono::steady_clock::now();
    expected = session.render().image;
    longest[round % 3] = std::chrono::steady_clock::now() - start;
  }
  std::mt19937 random(seed);
  int cancelled = 0;
  for (int round = 0; cancelled < times; ++round) {
    REQUIRE(round < 20 * times); // or hardly any frame hears of it
    change(round);
    std::atomic<bool> over = false;
    const std::chrono::microseconds delay(random() % (static_cast<unsigned>(longest[round % 3].count()) + 1));
    std::thread canceller([&] {
      std::this_thread::sleep_for(delay);
      for (; !over; std::this_thread::yield())
        session.cancel();
    });
    const RenderResult broken = session.render();
    over = true;
    canceller.join();
    if (broken.complete) REQUIRE(broken.image == expected);
    cancelled += !broken.complete;
    const RenderResult next = session.render();
    REQUIRE(next.complete);
    REQUIRE(next.statistics.diagnostics.empty());
    REQUIRE(next.image == expected);
  }
}

} // namespace

TEST_CASE("Objects that move, shrink and change their material are refitted into the BVH") {
  for (const TestBackend& backend : one_of_each()) {
    INFO(backend.spu());
    Session session(many_spheres(300), backend.options(kWidth, kHeight, 2));
    CHECK(check_next(session).statistics.preparation == Preparation::built);
    session.set_transform(17, Transform::translate({0.5, 1, -0.5}));
    CHECK(check_next(session).statistics.preparation == Preparation::refitted);
    session.set_transform(17, Transform::scale({2, 2, 2}));
    session.set_material_of(18, 0);
    CHECK(check_next(session).statistics.preparation == Preparation::refitted);
    Object other = session.scene().objects[3];
    other.shape = Sphere{{1, 1, -2}, 0.7};
    session.set_object(3, other);
    CHECK(check_next(session).statistics.preparation == Preparation::refitted);
    session.set_camera(camera_at({3, 2, -12}, {0, 0, 0}));
    CHECK(check_next(session).statistics.preparation == Preparation::kept);
  }
}

TEST_CASE("Where only boundaries of solids depend on the eye, a camera that moves has only these rewritten") {
  Object box, rod;
  box.shape = Box{{{-2, -1, -1}, {2, 1, 1}}};
  rod.shape = Cylinder{{-3, 0, 0}, {2, 0, 0}, 1.2};
  for (const TestBackend& backend : one_of_each()) {
    INFO(backend.spu());
    Scene scene = many_spheres(40);
    scene.objects.push_back(csg_object(Csg::Operation::intersection, {box, rod}));
    Session session(scene, backend.options(kWidth, kHeight, 2));
    check_next(session);
    for (const double x : {3.0, -400.0, 0.0}) {
      session.set_camera(camera_at({x, 2, -12}, {0, 0, 0}));
      CHECK(check_next(session).statistics.preparation == Preparation::updated);
    }
    // Objects are where the last eye had them put, too.
    session.set_transform(3, Transform::translate({0.5, 1, -0.5}));
    CHECK(check_next(session).statistics.preparation == Preparation::refitted);
    session.set_camera(camera_at({5, 2, -12}, {0, 0, 0}));
    CHECK(check_next(session).statistics.preparation == Preparation::updated);
    // Ends of what is cut out may be moved.
    scene.objects.push_back(csg_object(Csg::Operation::difference, {rod, box}));
    session.replace(scene);
    check_next(session);
    session.set_camera(camera_at({2, 2, -12}, {0, 0, 0}));
    CHECK(check_next(session).statistics.preparation == Preparation::refitted);
  }
}

TEST_CASE("Of a moved sphere of a thousand only its lines are fetched again") {
  const TestBackend emulated = backends().back();
  RenderOptions options = emulated.options(160, 120, 8);
  options.emulation.schedule = Schedule::lockstep;
  Session session(many_spheres(1000), options);
  session.render();
  session.set_transform(500, Transform::translate({0, 0.1, 0}));
  const RenderResult moved = check_next(session);
  CHECK(moved.statistics.preparation == Preparation::refitted);
  // Its record, and the nodes from the root down to its leaf.
  CHECK(moved.statistics.stale_lines >= 2);
  CHECK(moved.statistics.stale_lines <= 12);
}

TEST_CASE("Objects are hidden and shown again") {
  Scene scene = bent_sheet(0, 20);
  const auto sheet_object = static_cast<Index>(scene.objects.size() - 1);
  const auto add = [&](auto shape) {
    Object object;
    object.shape = shape;
    object.interior = scene.add(Interior());
    scene.objects.push_back(object);
    return static_cast<Index>(scene.objects.size() - 1);
  };
  const Index plane = add(Plane{{0, 1, 0}, -3});
  auto csg = std::make_shared<Csg>();
  csg->operation = Csg::Operation::difference;
  csg->parts.resize(2);
  csg->parts[0].shape = Box{{{-1, -1, -3}, {1, 1, -2}}};
  csg->parts[1].shape = Sphere{{0, 0, -3}, 0.8};
  const Index difference = add(std::shared_ptr<const Csg>(csg));
  for (const TestBackend& backend : one_of_each()) {
    INFO(backend.spu());
    Session session(scene, backend.options(kWidth, kHeight, 2));
    const Image all = session.render().image;
    for (const Index object : {sheet_object, plane, difference, Index{0}}) {
      INFO("object " << object);
      session.show(object, false);
      const RenderResult without = check_next(session);
      CHECK(without.statistics.preparation == Preparation::refitted);
      Scene removed = session.scene();
      removed.objects.erase(removed.objects.begin() + object);
      CHECK(without.image == render(removed, session.options()).image);
      session.show(object, true);
      CHECK(check_next(session).image == all);
    }
  }
}

TEST_CASE("Materials, lights and interiors change without their objects") {
  for (const TestBackend& backend : one_of_each()) {
    INFO(backend.spu());
    Session session(bent_sheet(1, 20), backend.options(kWidth, kHeight, 2));
    session.render();
    session.set_material(0, matte({0.2, 0.9, 0.1}));
    CHECK(check_next(session).statistics.preparation == Preparation::updated);
    Light light = session.scene().lights[0];
    light.location += Vec3(1, 2, 0);
    light.colour = {0.5, 0.6, 1};
    session.set_light(0, light);
    CHECK(check_next(session).statistics.preparation == Preparation::updated);
    Interior interior;
    interior.ior = 1.3;
    session.set_interior(2, interior);
    CHECK(check_next(session).statistics.preparation == Preparation::updated);
    session.edit({false, true}, [](Scene& scene) { scene.background = {0.3, 0, 0.3}; });
    CHECK(check_next(session).statistics.preparation == Preparation::updated);
    // An area takes more places to look for shadows from, and more of a local store.
    light.area = LightArea{};
    session.set_light(0, light);
    check_next(session);
    light.area = std::nullopt;
    session.set_light(0, light);
    check_next(session);
  }
}

TEST_CASE("What does not fit in its place is made anew") {
  for (const TestBackend& backend : one_of_each()) {
    INFO(backend.spu());
    Session session(many_spheres(50), backend.options(kWidth, kHeight, 2));
    session.render();
    session.edit({}, [](Scene& scene) { scene.objects.pop_back(); });
    CHECK(check_next(session).statistics.preparation == Preparation::built);
    Object none = session.scene().objects[5];
    none.shape = Sphere{{0, 0, 0}, 0};
    session.set_object(5, none);
    CHECK(check_next(session).statistics.preparation == Preparation::built);
    session.edit({false, true}, [](Scene& scene) { scene.lights.push_back(scene.lights.front()); });
    CHECK(check_next(session).statistics.preparation == Preparation::built);
    session.replace(many_spheres(60));
    CHECK(check_next(session).statistics.preparation == Preparation::built);
    session.set_transform(5, Transform::translate({0, 0, 1}));
    CHECK(check_next(session).statistics.preparation == Preparation::refitted);
  }
}

TEST_CASE("A mesh that bends is refitted, and built again when the BVH has become bad") {
  for (const TestBackend& backend : one_of_each()) {
    INFO(backend.spu());
    Session session(bent_sheet(0), backend.options(kWidth, kHeight, 2));
    session.render();
    const auto last = static_cast<Index>(session.scene().objects.size() - 1);
    for (const float phase : {0.2f, 0.4f, 0.9f}) {
      Object object = session.scene().objects[last];
      object.shape = std::make_shared<const Mesh>(sheet(60, phase));
      session.set_object(last, object);
      CHECK(check_next(session).statistics.preparation == Preparation::refitted);
    }
    // Vertices anywhere.
    Mesh mesh = sheet(60, 0);
    std::shuffle(mesh.vertices.begin(), mesh.vertices.end(), std::mt19937(3));
    Object object = session.scene().objects[last];
    object.shape = std::make_shared<const Mesh>(mesh);
    session.set_object(last, object);
    CHECK(check_next(session).statistics.preparation == Preparation::built);
  }
}

TEST_CASE("A scene of triangles alone is refitted as long as the same ones can be hit") {
  Scene scene = many_spheres(0);
  scene.objects.push_back(mesh_object(sheet(60, 0), 0, 0));
  scene.objects.push_back(mesh_object(sheet(10, 1), 1, 0));
  scene.objects.back().transform = Transform::translate({1, 0, 3});
  for (const TestBackend& backend : one_of_each()) {
    INFO(backend.spu());
    Session session(scene, backend.options(kWidth, kHeight, 2));
    const Image first = session.render().image;
    const auto bend = [&](const Mesh& mesh) {
      Object object = session.scene().objects[0];
      object.shape = std::make_shared<const Mesh>(mesh);
      session.set_object(0, object);
    };
    bend(sheet(60, 0.2f));
    CHECK(check_next(session).statistics.preparation == Preparation::refitted);
    Mesh pinched = sheet(60, 0.2f);
    pinched.vertices[1000] = pinched.vertices[1001];
    bend(pinched);
    CHECK(check_next(session).statistics.preparation == Preparation::built);
    bend(sheet(60, 0.3f));
    CHECK(check_next(session).statistics.preparation == Preparation::built);
    Mesh two_materials = sheet(60, 0.3f);
    two_materials.triangles[70].material[1] = 2;
    bend(two_materials);
    CHECK(check_next(session).statistics.preparation == Preparation::built);
    bend(sheet(60, 0.4f));
    CHECK(check_next(session).statistics.preparation == Preparation::built);
    Mesh huge = sheet(60, 0.4f);
    huge.vertices[0].x = 1e30f;
    bend(huge);
    CHECK_THROWS_AS(session.render(), InputError);
    bend(sheet(60, 0));
    CHECK(check_next(session).image == first);
  }
}

TEST_CASE("Instances of meshes move by themselves") {
  Scene scene = many_spheres(30);
  const Object mesh = mesh_object(sheet(50, 0), 0, 0);
  for (int i = 0; i < 4; ++i) {
    scene.objects.push_back(mesh);
    scene.objects.back().transform = Transform::translate({2.0 * i - 3, 0, 3.0 * i});
  }
  for (const TestBackend& backend : one_of_each()) {
    INFO(backend.spu());
    Session session(scene, backend.options(kWidth, kHeight, 2));
    session.render();
    session.set_transform(31, Transform::translate({0, 1, -1}));
    CHECK(check_next(session).statistics.preparation == Preparation::refitted);
    session.show(32, false);
    CHECK(check_next(session).statistics.preparation == Preparation::refitted);
  }
}

TEST_CASE("Pictures change their size, their region and their sampling while the scene stays") {
  for (const TestBackend& backend : one_of_each()) {
    INFO(backend.spu());
    Session session(many_spheres(100), backend.options(kWidth, kHeight, 3));
    session.render();
    RenderOptions options = session.options();
    const auto check_kept = [&] {
      session.set_picture(options);
      CHECK(check_next(session).statistics.preparation == Preparation::kept);
    };
    options.width = 33;
    options.height = 70;
    check_kept();
    options.antialiasing = Antialiasing{};
    check_kept();
    options.region = PictureRegion{3, 30, 20, 60};
    check_kept();
    options.antialiasing->method = Antialiasing::Method::adaptive;
    check_kept();
    options.antialiasing.reset();
    options.colours = true;
    check_kept();
    options.colours = false;
    options.region.reset();
    check_kept();
    options.antialiasing = Antialiasing{};
    options.alpha = options.first_hits = true;
    check_kept();
    options.antialiasing->method = Antialiasing::Method::adaptive;
    check_kept();
    options.antialiasing.reset();
    options.alpha = options.first_hits = false;
    options.blocks = true;
    check_kept();
    options.blocks = false;
    check_kept();
    options.work_map = true;
    session.set_picture(options);
    CHECK(!session.render().work.empty());
    options.work_map = false;
    options.antialiasing = Antialiasing{};
    check_kept();
    options.antialiasing.reset();
    check_kept();
    options.antialiasing = Antialiasing{};
    check_kept();
    options.width = 0;
    CHECK_THROWS_AS(session.set_picture(options), InputError);
    CHECK(session.options().width == 33);
    CHECK(check_next(session).image.width == 33);
  }
}

TEST_CASE("A framebuffer fills with what the result has") {
  for (const TestBackend& backend : one_of_each())
    for (const bool samples : {false, true}) {
      INFO(backend.spu() << (samples ? " with antialiasing" : ""));
      RenderOptions options = backend.options(53, 41, 3);
      if (samples) options.antialiasing = Antialiasing{};
      Session session(many_spheres(100), options);
      std::vector<std::uint8_t> pixels(41 * 160, 7);
      session.set_framebuffer(Framebuffer{pixels.data(), 160, PixelFormat::rgb8});
      const RenderResult result = session.render();
      CHECK(session.generation() > 1);
      bool equal = true;
      for (int y = 0; y < 41; ++y) {
        for (int x = 0; x < 53; ++x)
          equal = equal && std::equal(&pixels[y * 160 + x * 3], &pixels[y * 160 + x * 3 + 3],
                                      result.image.pixel(x, y));
        equal = equal && pixels[y * 160 + 159] == 7;
      }
      CHECK(equal);
      CHECK_THROWS_AS(session.set_framebuffer(Framebuffer{pixels.data(), 158, PixelFormat::rgb8}),
                      InputError);
      options.width = 54;
      CHECK_THROWS_AS(session.set_picture(options), InputError);
      options = session.options();
      options.antialiasing.reset();
      options.blocks = true;
      CHECK_THROWS_AS(session.set_picture(options), InputError); // which have no pixels to watch
      session.set_framebuffer(std::nullopt);
      const std::uint64_t before = session.generation();
      session.render();
      CHECK(session.generation() == before);
    }
}

TEST_CASE("A framebuffer of numbers has those of the result when the frame is complete") {
  for (const TestBackend& backend : one_of_each()) {
    RenderOptions options = backend.options(21, 14, 2);
    options.region = PictureRegion{2, 19, 1, 13};
    Session session(many_spheres(40), options);
    std::vector<float> floats(std::size_t{14} * 96, -1.0f);
    session.set_framebuffer(Framebuffer{floats.data(), 96 * sizeof(float), PixelFormat::rgba32f});
    CHECK(session.render().colours.rgba.empty());
    CHECK(session.generation() == 1);
    CHECK_FALSE(session.render([](double) { return false; }).complete);
    CHECK(session.generation() == 1);
    std::vector<std::uint16_t> words(std::size_t{14} * 90, 7);
    session.set_framebuffer(Framebuffer{words.data(), 90 * sizeof(std::uint16_t), PixelFormat::rgba16});
    options.colours = true;
    session.set_picture(options);
    const ColourImage colours = session.render().colours;
    const DeepImage deep = to_deep_image(colours);
    bool equal = true;
    for (int y = 1; y < 13; ++y) {
      const auto at = static_cast<std::size_t>(y);
      equal &= std::equal(colours.pixel(2, y), colours.pixel(19, y), &floats[at * 96 + 8]);
      equal &= std::equal(deep.pixel(2, y), deep.pixel(19, y), &words[at * 90 + 8]);
      equal &= words[at * 90 + 7] == 7 && words[at * 90 + 19 * 4] == 7 && floats[at * 96 + 19 * 4] == -1;
    }
    CHECK(equal);
    CHECK(floats[8] == -1);
    CHECK_THROWS_AS(session.set_framebuffer(Framebuffer{floats.data(), 335, PixelFormat::rgba32f}),
                    InputError);
    session.set_framebuffer(std::nullopt);
    session.render();
    CHECK(session.generation() == 2);
  }
}

TEST_CASE("What a function throws that hears of finished blocks passes through") {
  for (const TestBackend& backend : one_of_each()) {
    RenderOptions options = backend.options(kWidth, kHeight, 2);
    int calls = 0;
    options.finished_block = [&](const PictureBlock&) {
      if (++calls == 3) throw std::runtime_error("enough");
    };
    Session session(many_spheres(100), options);
    CHECK_THROWS_WITH(session.render(), "enough");
    CHECK(check_next(session).complete);
  }
}

TEST_CASE("Changes that are not valid leave the machine with the scene as it was") {
  for (const TestBackend& backend : one_of_each()) {
    Session session(many_spheres(20), backend.options(kWidth, kHeight, 2));
    session.render();
    CHECK_THROWS_AS(session.set_transform(20, Transform()), InputError);
    CHECK_THROWS_AS(session.set_light(9, Light()), InputError);
    const Object good = session.scene().objects[0];
    Object bad = good;
    bad.material = 1000;
    session.set_object(0, bad);
    CHECK_THROWS_AS(session.render(), InputError);
    session.set_object(0, good);
    check_next(session);
  }
}

TEST_CASE("Frames are cancelled at any moment, and the next one is complete") {
  for (const TestBackend& backend : one_of_each())
    cancel_frames(backend, many_spheres(200), kWidth, 25, 11);
}

TEST_CASE("Frames of the simulator are cancelled at any moment, and the next one is complete") {
  if (const TestBackend backend = all_machines().back(); backend.backend == Backend::cell_sim)
    cancel_frames(backend, many_spheres(20), 16, 3, 12);
}

// The long form: test_render "[.long]".
TEST_CASE("Frames are cancelled a thousand times, and the next one is complete", "[.long]") {
  for (const TestBackend& backend : {backends().front(), TestBackend{Backend::cell_emu}})
    cancel_frames(backend, many_spheres(200), 32, 1000, 13);
  if (const TestBackend backend = all_machines().back(); backend.backend == Backend::cell_sim)
    cancel_frames(backend, many_spheres(20), 16, 1000, 14);
}

TEST_CASE("A work map says of every pixel who rendered it") {
  for (const TestBackend& backend : one_of_each()) {
    INFO(backend.spu());
    RenderOptions options = backend.options(53, 41, 3);
    options.work_map = true;
    options.region = PictureRegion{5, 50, 2, 40};
    Session session(many_spheres(100), options);
    for (int frame = 0; frame < 2; ++frame) {
      const RenderResult result = session.render();
      std::vector<int> covered(53 * 41);
      for (const WorkRecord& record : result.work) {
        CHECK(record.spe < 3);
        CHECK(record.ticks_per_pixel > 0);
        for (int y = record.region.top; y < record.region.bottom; ++y)
          for (int x = record.region.left; x < record.region.right; ++x)
            ++covered[static_cast<std::size_t>(y * 53 + x)];
      }
      for (int y = 0; y < 41; ++y)
        for (int x = 0; x < 53; ++x)
          REQUIRE(covered[static_cast<std::size_t>(y * 53 + x)] == (x >= 5 && x < 50 && y >= 2 && y < 40));
    }
  }
}
