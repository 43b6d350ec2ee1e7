// Pictures of each format from the program, to files and to stdout, as other programs read them.
#include "cli/program_run.hpp"
#include "image/other_programs.hpp"

#include <nlohmann/json.hpp>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::string kScene = CELLTRACE_SOURCE_DIR "/examples/scenes/first.pov";
const std::vector<std::string> kSmall = {kScene, "-W", "100", "-H", "60"};

Outcome run_with(const TemporaryFolder& folder, const std::vector<std::string>& more) {
  std::vector<std::string> arguments = kSmall;
  arguments.insert(arguments.end(), more.begin(), more.end());
  return celltrace_run(folder, arguments);
}

bool has_openexr(const TemporaryFolder& folder) {
  const Outcome outcome = celltrace_run(folder, {kScene, "-W", "8", "-H", "8", "-o", "a.exr"});
  if (outcome.exit_code == 0) return true;
  CHECK_THAT(outcome.err, Contains("a.exr: this build cannot write OpenEXR"));
  WARN("skipped: a build without OpenEXR");
  return false;
}

} // namespace

TEST_CASE("a picture goes to stdout as it goes to a file") {
  const TemporaryFolder folder;
  std::vector<std::string> formats = {"png", "ppm", "hdr", "dds", "tga", "bmp", "jpg"};
  if (has_openexr(folder)) formats.push_back("exr");
  for (const std::string& format : formats) {
    CAPTURE(format);
    REQUIRE(run_with(folder, {"-o", "a." + format}).exit_code == 0);
    const Outcome outcome = run_with(folder, {"-o", "-", "--format", format});
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK((outcome.out == read_bytes(folder / ("a." + format))));
    CHECK_THAT(outcome.err, StartsWith("standard output: 100x60"));
  }
  const Outcome by_switches = run_with(folder, {"+O-", "+FP"});
  CHECK((by_switches.out == read_bytes(folder / "a.ppm")));
  CHECK((run_with(folder, {"-o", "-"}).out == read_bytes(folder / "a.png")));
}

TEST_CASE("a stdout that is full, closed or has no reader any more is an error") {
  const TemporaryFolder folder;
  // Descriptor 4 is a pipe whose reader is gone.
  const std::string begin =
      "cd '" + folder.path().string() +
      "' && rm -f pipe && mkfifo pipe && exec 3<>pipe && exec 4>pipe && exec 3>&- && '" +
      CELLTRACE_PROGRAM "' '" + kScene + "' -W 100 -H 60 --quiet -o - 2>err.txt --format ";
  for (const std::string format : {"png", "ppm", "hdr", "dds", "tga", "bmp", "jpg"})
    for (const std::string where : {" >/dev/full", " >&-", " >&4"}) {
      const std::string command = begin + format + where;
      CAPTURE(command);
      CHECK(WEXITSTATUS(std::system(command.c_str())) == 1);
      const std::string error = read_bytes(folder / "err.txt");
      CHECK_THAT(error, StartsWith("celltrace: error: standard output cannot be written"));
      CHECK(lines(error) == 1);
    }
}

TEST_CASE("a DirectDraw surface is what ImageMagick takes it for, on every backend") {
  const TemporaryFolder folder;
  REQUIRE(run_with(folder, {"-o", "a.png"}).exit_code == 0);
  const Image picture = load_image(folder / "a.png");
  const bool can_read = imagemagick_reads("DDS");
  std::vector<std::string> backends = {"native", "cell_emu"};
#ifdef CELLTRACE_SIMULATOR_PROGRAMS
  backends.push_back("cell_sim");
#endif
  for (const std::string& backend : backends) {
    const Outcome outcome =
        run_with(folder, {"-o", "a.dds", "--backend", backend, "--spes", "2", "--stats", "a.json"});
    CAPTURE(backend, outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const auto statistics = nlohmann::json::parse(read_bytes(folder / "a.json"));
    // So few pixels are edges mostly; the best encoder there is gets 30.7 dB.
    CHECK(statistics["blocks"]["psnr"] > 30);
    CHECK(statistics["dma"]["pixel_bytes"] == 26 * 15 * 8);
    if (can_read) CHECK(compare_images(by_imagemagick(folder, "a.dds"), picture).psnr > 30);
  }
  if (can_read) {
    for (const char* name : {"c.png", "c.dds"})
      REQUIRE(celltrace_run(folder, {kScene, "-W", "320", "-H", "240", "-o", name}).exit_code == 0);
    CHECK(compare_images(by_imagemagick(folder, "c.dds"), load_image(folder / "c.png")).psnr > 35);
  }
  REQUIRE(run_with(folder, {"-o", "b.png", "--stats", "b.json"}).exit_code == 0);
  const auto statistics = nlohmann::json::parse(read_bytes(folder / "b.json"));
  CHECK(statistics["blocks"]["psnr"].is_null());
  CHECK(statistics["dma"]["pixel_bytes"] >= 100 * 60 * 4);
}

TEST_CASE("alpha comes with a PNG of either depth and with OpenEXR") {
  const TemporaryFolder folder;
  write_bytes(folder / "ball.pov", "camera { location -4*z look_at 0 }\n"
                                   "light_source { <5, 5, -5> 1 }\n"
                                   "sphere { 0, 1 pigment { rgb <1, 0.5, 0> } }\n");
  for (const std::string bits : {"8", "16"}) {
    const Outcome outcome = celltrace_run(
        folder, {"ball.pov", "-W", "40", "-H", "30", "+UA", "--bits", bits, "-A", "-o", "a.png"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const Image picture = load_image(folder / "a.png");
    CHECK(picture.pixel(0, 0)[3] == 0);
    CHECK(picture.pixel(20, 15)[3] == 255);
    CHECK(picture.pixel(20, 15)[0] > 50);
  }
  if (!has_openexr(folder)) return;
  const Outcome outcome = celltrace_run(folder, {"ball.pov", "-W", "40", "-H", "30", "+UA", "--first-hits",
                                                 "on", "--bits", "32", "-o", "a.exr"});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
}
