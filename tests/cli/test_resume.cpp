// Runs that are stopped, and go on.
#include "celltrace/image.hpp"
#include "cli/program_run.hpp"

#include <chrono>
#include <map>
#include <random>

#include <nlohmann/json.hpp>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

namespace {

const std::string kFirst = CELLTRACE_SOURCE_DIR "/examples/scenes/first.pov";

/// What takes a while: many rays through glass. A frame of 48x36 takes some ten milliseconds.
void write_slow_scene(const TemporaryFolder& folder) {
  write_bytes(folder / "s.pov",
              "global_settings { max_trace_level 4 }\n"
              "camera { location -6*z look_at 0 angle 30 }\n"
              "light_source { <5, 5, -9>, 1 }\n"
              "plane { y, -1 pigment { checker rgb 1 rgb 0.2 } }\n"
              "#declare R = seed(3);\n"
              "#for (I, 1, 12)\n"
              "  sphere { (<rand(R), rand(R), rand(R)> - 0.5) * 1.6 + clock * x, 0.4\n"
              "    pigment { rgbt <1, 1, 1, 0.9> } finish { reflection 0.3 } interior { ior 1.3 } }\n"
              "#end\n");
}

std::map<std::string, std::string> all_files(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files[entry.path().filename().string()] = read_bytes(entry.path());
  return files;
}

std::vector<std::filesystem::path> pictures(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> pictures;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".png") pictures.push_back(entry.path());
  return pictures;
}

/// Half a minute at most.
void wait_for_pictures(const std::filesystem::path& folder, std::size_t count) {
  const auto start = Clock::now();
  while (pictures(folder).size() < count && Clock::now() - start < std::chrono::seconds(30))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

std::uint64_t primary_rays(const TemporaryFolder& folder, const char* file) {
  return nlohmann::json::parse(read_bytes(folder / file))["rays"]["primary"].get<std::uint64_t>();
}

} // namespace

TEST_CASE("an animation that is killed ten times ends with the same files") {
  const TemporaryFolder folder;
  write_slow_scene(folder);
  const auto arguments = [](const std::string& output) {
    return std::vector<std::string>{"s.pov", "+W48", "+H36", "+KFF100", "+C", "+O" + output + "/", "--quiet"};
  };
  for (const char* name : {"whole", "killed"})
    std::filesystem::create_directory(folder / name);
  REQUIRE(celltrace_run(folder, arguments("whole")).exit_code == 0);

  std::mt19937 random(17);
  int killed = 0;
  std::map<std::string, std::filesystem::file_time_type> seen;
  for (std::size_t i = 0; i < 10; ++i) {
    Run run(folder, arguments("killed"));
    wait_for_pictures(folder / "killed", 5 + 8 * i);
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 15000));
    run.send(SIGKILL);
    killed += run.finish().exit_code == 128 + SIGKILL ? 1 : 0;
    for (const auto& picture : pictures(folder / "killed")) {
      seen.emplace(picture.filename().string(), std::filesystem::last_write_time(picture));
      load_image(picture); // is whole
    }
  }
  CHECK(killed == 10);
  CHECK(seen.size() < 100);
  REQUIRE(celltrace_run(folder, arguments("killed")).exit_code == 0);
  // Frames that were finished are not rendered again; a kill may come before that of one is noted down.
  int again = 0;
  for (const auto& [name, time] : seen)
    again += std::filesystem::last_write_time(folder / "killed" / name) == time ? 0 : 1;
  CHECK(again <= 10);
  auto expected = all_files(folder / "whole"), found = all_files(folder / "killed");
  CHECK(expected.size() == 101);
  expected.erase("s.png.resume"); // in the order in which frames came
  found.erase("s.png.resume");
  CHECK(found == expected);

  // There is nothing left to do.
  const Outcome again_outcome =
      celltrace_run(folder, {"s.pov", "+W48", "+H36", "+KFF100", "+C", "+Okilled/"});
  CHECK(again_outcome.exit_code == 0);
  CHECK_THAT(again_outcome.err, Contains("all frames are finished already"));
}

TEST_CASE("a picture that is interrupted goes on with the rows that are missing") {
  const std::vector<std::string> more =
      GENERATE(std::vector<std::string>{}, std::vector<std::string>{"+A0.1", "+J"},
               std::vector<std::string>{"+A0.1", "+AM2", "+J0.7", "+FN16"},
               std::vector<std::string>{"+FN16", "+SR100", "+SC7"});
  const TemporaryFolder folder;
  write_slow_scene(folder);
  int width = 4;
  const auto arguments = [&](const std::string& name, const std::string& resume) {
    std::vector<std::string> all = {
        "s.pov", "+W" + std::to_string(width), "+H400", "-o", name + ".png", "--stats", name + ".json"};
    all.insert(all.end(), more.begin(), more.end());
    if (!resume.empty()) all.push_back(resume);
    return all;
  };
  // So wide that there is time to interrupt it, and no wider: with sanitizers it takes many times as long.
  Seconds whole{0};
  while (whole < std::chrono::milliseconds(150) && width < 512) {
    width *= 2;
    const auto start = Clock::now();
    REQUIRE(celltrace_run(folder, arguments("whole", "")).exit_code == 0);
    whole = Clock::now() - start;
  }
  // Until it is stopped between its first rows and its last ones.
  Outcome stopped;
  Seconds wait = 0.6 * whole;
  for (int i = 0; i < 20 && !std::filesystem::exists(folder / "part.png.rows"); ++i) {
    std::filesystem::remove(folder / "part.png.resume");
    Run run(folder, arguments("part", "+C"));
    std::this_thread::sleep_for(wait);
    run.interrupt();
    stopped = run.finish();
    wait *= stopped.exit_code == 0 ? 0.7 : 1.2;
  }
  CAPTURE(more, stopped.err);
  CHECK(stopped.exit_code == 2);
  CHECK_THAT(stopped.err, StartsWith("part.png: interrupted, partial, "));
  REQUIRE(std::filesystem::exists(folder / "part.png.rows"));
  CHECK_THAT(stopped.err, Contains("missing rows: ") && Contains("run the same command with --resume (+C)"));
  CHECK(load_image(folder / "part.png").height == 400);

  const Outcome resumed = celltrace_run(folder, arguments("part", "+C"));
  CAPTURE(resumed.err);
  CHECK(resumed.exit_code == 0);
  CHECK_THAT(resumed.err, Contains("rows to go"));
  CHECK(primary_rays(folder, "part.json") < primary_rays(folder, "whole.json"));
  CHECK(read_bytes(folder / "part.png") == read_bytes(folder / "whole.png"));
  CHECK_FALSE(std::filesystem::exists(folder / "part.png.rows"));
}

TEST_CASE("a stopped run is not resumed with other options or another scene") {
  const TemporaryFolder folder;
  write_slow_scene(folder);
  const std::vector<std::string> animation = {"s.pov", "+W16", "+H12", "+KFF3", "+C", "--quiet"};
  REQUIRE(celltrace_run(folder, animation).exit_code == 0);
  const auto with = [&](const std::string& more) {
    std::vector<std::string> arguments = animation;
    arguments.push_back(more);
    return celltrace_run(folder, arguments);
  };
  const Outcome wider = with("+W20");
  CHECK(wider.exit_code == 1);
  CHECK(lines(wider.err) == 1);
  CHECK_THAT(wider.err, Contains("s.png.resume: ") && Contains("width was 16, now 20") && Contains("(+C)"));
  CHECK(with("+Q5").exit_code == 1);
  CHECK(with("+EF2").exit_code == 0); // a part of the same
  CHECK(with("-C").exit_code == 0);   // anew
  CHECK_FALSE(std::filesystem::exists(folder / "s.png.resume"));

  REQUIRE(celltrace_run(folder, animation).exit_code == 0);
  write_bytes(folder / "s.pov", read_bytes(folder / "s.pov") + "background { rgb 1 }\n");
  CHECK_THAT(celltrace_run(folder, animation).err, Contains("scene file was "));
}

TEST_CASE("Ctrl-C keeps what is finished, and says how to go on") {
  const TemporaryFolder folder;
  write_slow_scene(folder);
  const std::vector<std::string> arguments = {"s.pov", "+W160", "+H120", "+KFF400"};
  Run run(folder, arguments);
  while (!std::filesystem::exists(folder / "s003.png"))
    std::this_thread::yield();
  run.interrupt();
  const Outcome outcome = run.finish();
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("s001.png...: interrupted, ") && Contains("missing frames: "));
  const auto first = std::filesystem::last_write_time(folder / "s001.png");
  const Outcome resumed = celltrace_run(folder, {"s.pov", "+W160", "+H120", "+KFF400", "+C", "+EF5"});
  CHECK(resumed.exit_code == 0);
  CHECK_THAT(resumed.err, Contains(" frames are finished, "));
  CHECK(std::filesystem::last_write_time(folder / "s001.png") == first);
  CHECK(std::filesystem::exists(folder / "s005.png"));
}

TEST_CASE("a picture that is finished is not rendered again") {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments = {kFirst, "+W16", "+H12", "-o", "p.png", "+C"};
  CHECK_THAT(celltrace_run(folder, arguments).err, StartsWith("p.png: 16x12"));
  CHECK_THAT(celltrace_run(folder, arguments).err, StartsWith("p.png: finished already"));
  write_bytes(folder / "p.png", "");
  CHECK_THAT(celltrace_run(folder, arguments).err, StartsWith("p.png: 16x12"));
}
