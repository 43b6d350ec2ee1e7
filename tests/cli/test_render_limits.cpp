// Scenes that would take hours to render, and end at the limit that is set.
#include "celltrace/image.hpp"
#include "cli/program_run.hpp"

#include <chrono>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;

namespace {

const std::string kScene = CELLTRACE_SOURCE_DIR "/examples/scenes/first.pov";

struct SlowScene {
  const char* what;
  std::string text;
  std::vector<std::string> options = {};
};

/// Spheres that overlap around the origin.
std::string balls(int count, const std::string& looks) {
  return "#declare R = seed(3);\n#for (I, 1, " + std::to_string(count) +
         ") sphere { (<rand(R), rand(R), rand(R)> - 0.5) * 1.6, 0.5 " + looks + " }\n#end\n";
}

std::vector<SlowScene> slow_scenes() {
  const std::string deep = "global_settings { max_trace_level 256 adc_bailout 0 }\n";
  const std::string view = "camera { location -3*z look_at 0 angle 40 }\n";
  const std::string lamp = "light_source { <5, 5, -9>, 1 }\n";
  const std::string glass = "pigment { rgbt <1, 1, 1, 0.9> } finish { reflection 0.3 } interior { ior 1.3 }";
  const std::string clear = "pigment { rgbt <1, 1, 1, 0.99> }";
  const std::string wide =
      "light_source { <5, 5, -9>, 1 area_light 4*x, 4*y, 256, 256 adaptive 100 jitter }\n";
  const std::string lights = "#for (I, 1, 20000) light_source { <sin(I), cos(I), -2> * 9, 1 / 20000 } #end\n";
  const std::string noise = "warp { turbulence 1 octaves 10 } ";
  std::string layers, deep_map = "rgb 1";
  for (int i = 0; i < 60; ++i)
    layers += "texture { pigment { wrinkles turbulence 1 octaves 10 color_map { [0 rgbt 1] [1 rgbt <1, 0, 0, "
              "0.99>] } "
              "scale 0.0" +
              std::to_string(i + 1) + " } normal { wrinkles 1 turbulence 1 } }\n";
  for (int i = 0; i < 7; ++i)
    deep_map = "wrinkles pigment_map { [0 " + deep_map + "] [1 " + deep_map + "] }";
  const std::vector<std::string> fine = {"--antialias", "0", "--antialias-depth", "9"};
  const std::vector<std::string> finer = {"--antialias",       "0", "--antialias-method", "2",
                                          "--antialias-depth", "9"};
  return {
      {"glass in glass", deep + view + lamp + balls(40, glass)},
      {"many balls of glass", deep + view + lamp + balls(400, glass)},
      {"two mirrors around", deep + view + lamp + "sphere { 0, 9 inverse finish { reflection 1 } }" +
                                 balls(40, "pigment { rgbt 0.9 } finish { reflection 0.9 }")},
      {"shadows through glass", view + wide + balls(200, clear)},
      {"a light of 65,536 places",
       view + wide + balls(30, "pigment { rgb 1 }") + "plane { y, -1 pigment { rgb 1 } }"},
      {"20,000 lights", view + lights + balls(30, "pigment { rgb 1 }")},
      {"20,000 lights through glass", view + lights + balls(100, clear)},
      {"60 layers of noise", view + lamp + "plane { z, 0 " + layers + " }"},
      {"60 layers in a mirror", deep + view + lamp + "plane { z, 1 finish { reflection 1 } " + layers + " }" +
                                    balls(20, "texture { pigment { rgbt 0.9 } finish { reflection 1 } }")},
      {"noise in maps of maps", view + lamp + "plane { z, 0 pigment { " + deep_map + " } }", fine},
      {"262,144 rays a pixel", view + lamp + balls(100, glass), fine},
      {"as many where they differ", view + lamp + balls(100, glass), finer},
      {"bumps that are averaged",
       view + lamp +
           balls(60, "pigment { rgbt 0.9 } normal { average normal_map { "
                     "[1 wrinkles 1 turbulence 1] [1 crackle 1 turbulence 1] "
                     "[1 granite 1 scale 0.01] } }"),
       fine},
      {"iridescent glass",
       deep + view + lamp +
           balls(40, "pigment { rgbt 0.95 } finish { reflection 0.5 irid { 0.9 thickness 0.5 "
                     "turbulence 0.5 } } interior { ior 1.1 }")},
      {"a CSG of 300 parts in glass", deep + view + lamp + "intersection { sphere { 0, 1.2 } union { " +
                                          balls(300, "") + "} " + glass + " }"},
      {"300 holes", view + wide + "difference { sphere { 0, 1.2 } " + balls(300, "") + clear + " }"},
      {"tori within tori",
       deep + view + lamp + "#for (I, 1, 100) torus { 0.9, 0.3 rotate I * <37, 11, 0> " + glass + " } #end"},
      {"crackle of distances",
       view + wide +
           balls(100, "pigment { crackle " + noise +
                          "scale 0.01 color_map { "
                          "[0 rgbt 1] [1 rgbt 0.9] } }"),
       fine},
      {"a fractal of 65,535 turns", view + lamp + "plane { z, 0 pigment { mandel 65535 scale 0.3 } }", fine},
      {"superellipsoids", deep + view + lamp +
                              "#for (I, 1, 60) superellipsoid { <0.2, 0.3> rotate I * <37, 11, 0> " + glass +
                              " } #end"},
      {"fog in turbulence", deep + view + lamp +
                                "#for (I, 1, 8) fog { distance 5 turbulence 1 turb_depth 1 octaves 10 "
                                "rgb 0.5 } #end" +
                                balls(60, glass)},
  };
}

} // namespace

TEST_CASE("scenes that take hours end at their limit with a partial picture") {
  for (SlowScene& scene : slow_scenes()) {
    const TemporaryFolder folder;
    write_bytes(folder / "s.pov", "#version 3.7;\n" + scene.text);
    std::vector<std::string> arguments = {
        "s.pov", "-W", "1600", "-H", "1200", "--max", "render-seconds=0.2", "-o", "s.png"};
    arguments.insert(arguments.end(), scene.options.begin(), scene.options.end());
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = celltrace_run(folder, arguments);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    CAPTURE(scene.what, outcome.err, seconds.count());
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, Contains("s.png: out of time (--max render-seconds), partial, 1600x1200"));
    CHECK(seconds.count() < 20); // a second, where nothing else runs
    CHECK(load_image(folder / "s.png").width == 1600);
  }
}

TEST_CASE("what a limit broke off goes on with +C") {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments = {kScene,   "-W", "2000", "-H",   "1500",
                                              "--spes", "1",  "-o",   "p.png"};
  std::vector<std::string> limited = arguments;
  limited.insert(limited.end(), {"--max", "render-seconds=0.05"});
  const Outcome first = celltrace_run(folder, limited);
  CAPTURE(first.err);
  CHECK(first.exit_code == 2);
  std::vector<std::string> rest = arguments;
  rest.push_back("+C");
  CHECK(celltrace_run(folder, rest).exit_code == 0);
  std::vector<std::string> whole = arguments;
  whole.back() = "whole.png";
  CHECK(celltrace_run(folder, whole).exit_code == 0);
  CHECK(load_image(folder / "p.png") == load_image(folder / "whole.png"));
}

TEST_CASE("memory of rendering is limited") {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& limit, const std::string& scene) {
    const Outcome outcome =
        celltrace_run(folder, {scene, "-W", "320", "-H", "240", "--max", limit, "-o", "m.png"});
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "m.png"));
    return outcome.err;
  };
  CHECK_THAT(error("render-memory=100K", kScene),
             Contains("the picture takes 307200 bytes, and 102400 are allowed"));
  write_bytes(folder / "many.pov", "#for (I, 1, 20000) sphere { I * x, 0.4 } #end");
  CHECK_THAT(error("render-memory=1M", "many.pov"), Contains("with its BVH, and 1048576 are allowed"));
  CHECK(
      celltrace_run(folder, {"many.pov", "-W", "320", "-H", "240", "--max", "render-memory=64M"}).exit_code ==
      0);
  CHECK_THAT(error("render-minutes=3", kScene), Contains("render-seconds") && Contains("loop-steps"));
}

TEST_CASE("in the sandbox a scene renders as ever") {
  const TemporaryFolder folder;
  write_bytes(folder / "ball.inc", "sphere { 0, 1 pigment { rgb 1 } }");
  write_bytes(folder / "s.pov", "#include \"ball.inc\" #include \"colors.inc\"\n"
                                "camera { location -4*z look_at 0 } light_source { <3, 4, -5>, White }");
  const Outcome free =
      celltrace_run(folder, {"s.pov", "-W", "80", "-H", "60", "-o", "free.png", "--lenient"});
  if (free.exit_code != 0) {
    WARN("skipped: POV-Ray's include files are not installed");
    return;
  }
  // The address sanitizer looks for leaks by a process of its own, which the sandbox does not let it start.
  const Start without_leak_check = {"celltrace", {"ASAN_OPTIONS=detect_leaks=0"}};
  for (const char* backend : {"native", "cell_emu"}) {
    const Outcome outcome = celltrace_run(folder,
                                          {"s.pov", "-W", "80", "-H", "60", "-o", "held.png", "--sandbox",
                                           "--backend", backend, "--stats", "s.json", "--lenient"},
                                          without_leak_check);
    if (outcome.exit_code == 1 && outcome.err.find("--sandbox: this") != outcome.err.npos) {
      WARN("skipped: " + outcome.err);
      return;
    }
    CAPTURE(backend, outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(load_image(folder / "held.png") == load_image(folder / "free.png"));
  }
  // The film of a program of others.
  const Outcome film = celltrace_run(folder, {"s.pov", "--sandbox", "-o", "f.mp4", "--final-frame", "2"});
  CHECK(film.exit_code == 1);
  CHECK_THAT(film.err, Contains("--sandbox starts no process"));
}
