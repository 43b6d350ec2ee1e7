// Many scenes into a folder.
#include "celltrace/image.hpp"
#include "cli/program_run.hpp"

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;

namespace {

void write_scene(const std::filesystem::path& path, const char* colour) {
  std::filesystem::create_directories(path.parent_path());
  write_bytes(
      path,
      std::string("#version 3.7; global_settings { assumed_gamma 1 } camera { location -5*z look_at 0 } "
                  "background { ") +
          colour + " }");
}

std::vector<std::uint8_t> first_pixel(const std::filesystem::path& path) {
  const Image image = load_image(path);
  return {image.pixel(0, 0), image.pixel(0, 0) + 3};
}

} // namespace

TEST_CASE("many scenes are rendered into a folder, with a page of all") {
  const TemporaryFolder folder;
  write_scene(folder / "in/red.pov", "rgb <1, 0, 0>");
  write_scene(folder / "in/green.pov", "rgb <0, 1, 0>");
  write_bytes(folder / "in/wrong.pov", "sphere {\n}");
  write_scene(folder / "more/red.pov", "rgb <0, 0, 1>");
  const Outcome outcome = celltrace_run(folder, {"in/green.pov", "in/red.pov", "in/wrong.pov", "more/red.pov",
                                                 "-W", "8", "-H", "6", "-o", "new/folder/"});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("in/wrong.pov:2:1: error:") &&
                              Contains("new/folder/contact-sheet.html: 3 of 4 scenes rendered"));
  const std::filesystem::path out = folder / "new/folder";
  CHECK(first_pixel(out / "green.png") == std::vector<std::uint8_t>{0, 255, 0});
  CHECK(first_pixel(out / "red.png") == std::vector<std::uint8_t>{255, 0, 0});
  // No picture takes the place of another.
  CHECK(first_pixel(out / "more-red.png") == std::vector<std::uint8_t>{0, 0, 255});
  CHECK_FALSE(std::filesystem::exists(out / "wrong.png"));
  const std::string page = read_bytes(out / "contact-sheet.html");
  CHECK_THAT(page, Contains("src=\"./red.png\"") && Contains("src=\"./more-red.png\"") &&
                       Contains("<pre>in/wrong.pov:2:1: error:") && Contains("in/green.pov"));
}

TEST_CASE("whoever renders many scenes hears of --lenient once") {
  const TemporaryFolder folder;
  write_scene(folder / "red.pov", "rgb <1, 0, 0>");
  write_bytes(folder / "a.pov", "ovus { 1, 2 }");
  write_bytes(folder / "b.pov", "ovus { 2, 3 }");
  const Outcome outcome =
      celltrace_run(folder, {"a.pov", "red.pov", "b.pov", "-W", "8", "-H", "6", "-o", "out/"});
  CAPTURE(outcome.err);
  const std::size_t first = outcome.err.find("note: --lenient renders");
  REQUIRE(first != outcome.err.npos);
  CHECK(outcome.err.find("note: --lenient", first + 1) == outcome.err.npos);
  CHECK_THAT(read_bytes(folder / "out/contact-sheet.html"),
             Contains("1 of 3 scenes rendered; 2 use what is not supported yet: <code>--lenient</code>"));
}

TEST_CASE("one scene, too, goes into a folder that is there or is made") {
  const TemporaryFolder folder;
  write_scene(folder / "in/red.pov", "rgb <1, 0, 0>");
  CHECK(celltrace_run(folder, {"in/red.pov", "-W", "8", "-H", "6", "-o", "new/folder/"}).exit_code == 0);
  CHECK(std::filesystem::exists(folder / "new/folder/red.png"));
  CHECK(celltrace_run(folder, {"in/red.pov", "-W", "8", "-H", "6", "-o", "in"}).exit_code == 0);
  CHECK(std::filesystem::exists(folder / "in/red.png"));
  // A file's folder is nobody's wish.
  CHECK(celltrace_run(folder, {"in/red.pov", "-W", "8", "-H", "6", "-o", "none/a.png"}).exit_code == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "none"));
}

TEST_CASE("each scene has its own time") {
  const TemporaryFolder folder;
  write_bytes(folder / "slow.pov",
              "#version 3.7; global_settings { max_trace_level 256 adc_bailout 0 }\n"
              "camera { location -3*z look_at 0 } light_source { <5, 5, -9>, 1 }\n"
              "#declare R = seed(3);\n#for (I, 1, 40) sphere { (<rand(R), rand(R), rand(R)> - 0.5), 0.5 "
              "pigment { rgbt 0.9 } finish { reflection 0.3 } interior { ior 1.3 } } #end");
  write_scene(folder / "red.pov", "rgb <1, 0, 0>");
  const Outcome outcome = celltrace_run(
      folder, {"slow.pov", "red.pov", "-W", "400", "-H", "300", "--max", "render-seconds=0.5", "-o", "out/"});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("slow.png: out of time") && Contains("1 of 2 scenes rendered"));
  CHECK(first_pixel(folder / "out/red.png") == std::vector<std::uint8_t>{255, 0, 0});
}

TEST_CASE("without a folder the last scene counts, as in POV-Ray") {
  const TemporaryFolder folder;
  write_scene(folder / "red.pov", "rgb <1, 0, 0>");
  write_scene(folder / "green.pov", "rgb <0, 1, 0>");
  const Outcome outcome =
      celltrace_run(folder, {"red.pov", "green.pov", "-W", "8", "-H", "6", "-o", "p.png"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err,
             Contains("of 2 scenes the last one is rendered, 'green.pov'; -o DIR/ renders each"));
  CHECK(first_pixel(folder / "p.png") == std::vector<std::uint8_t>{0, 255, 0});
  CHECK(celltrace_run(folder, {"red.pov", "green.pov", "+W8", "+H6", "+Oq.png"}).exit_code == 0);
  CHECK(first_pixel(folder / "q.png") == std::vector<std::uint8_t>{0, 255, 0});
}

TEST_CASE("what makes no sense for many scenes is refused") {
  const TemporaryFolder folder;
  write_scene(folder / "a.pov", "rgb 1");
  write_scene(folder / "b.pov", "rgb 1");
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--stats", "s.json"}, {"--final-frame", "3"}, {"--trace", "t.json"}}) {
    std::vector<std::string> arguments = {"a.pov", "b.pov", "-o", "out/"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = celltrace_run(folder, arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.err, Contains("one scene at a time"));
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
  }
}
