// Where pictures and reports go: streams, files that are there, names that are the same; and pictures as
// POV-Ray writes them.
#include "cli/program_run.hpp"
#include "image/other_programs.hpp"

#include <sys/stat.h>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::string kScene = "#version 3.7; global_settings { assumed_gamma 1 }\n"
                           "camera { location -5*z look_at 0 }\n"
                           "light_source { <5, 5, -9>, 1 }\n"
                           "sphere { <-0.7, 0.5, 0>, 1 pigment { rgbt <1, 0.3, 0.1, 0.4> } }\n"
                           "sphere { <1, -0.3, 0>, 0.7 pigment { rgb <0.1, 0.5, 0.9> } }\n";

/// A folder with the scene s.pov.
struct SceneFolder : TemporaryFolder {
  SceneFolder() { write_bytes(*this / "s.pov", kScene); }

  Outcome render(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"s.pov", "-W", "40", "-H", "30", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return celltrace_run(*this, arguments);
  }
  /// Runs a command of the shell here, in which $CT renders; returns its exit code.
  int shell(const std::string& command) const {
    return WEXITSTATUS(
        std::system(("CT=\"" CELLTRACE_PROGRAM " s.pov -W 40 -H 30 --quiet\"; export CT; cd '" +
                     path().string() + "' && bash -c '" + command + "' 2>errors")
                        .c_str()));
  }
};

} // namespace

TEST_CASE("what is there and is no regular file gets no extension and is written to") {
  const SceneFolder folder;
  REQUIRE(folder.render({"-o", "a.png", "--stats", "a.json"}).exit_code == 0);
  REQUIRE(folder.render({"-o", "a.tga"}).exit_code == 0);
  const std::string png = read_bytes(folder / "a.png"), tga = read_bytes(folder / "a.tga");

  CHECK(folder.render({"-o", "/dev/null"}).exit_code == 0);
  CHECK(folder.shell(
            "$CT -o /dev/stdout > out; $CT -o /dev/stdout | cat > piped; $CT -o /dev/fd/3 3> fd; "
            "$CT --pov-output /dev/fd/3 --file-type tga 3> tga; $CT -o >(cat > substituted); sleep 0.1") ==
        0);
  CHECK((read_bytes(folder / "out") == png));
  CHECK((read_bytes(folder / "piped") == png));
  CHECK((read_bytes(folder / "fd") == png));
  CHECK((read_bytes(folder / "tga") == tga));
  CHECK((read_bytes(folder / "substituted") == png));
  CHECK(folder.shell("mkfifo pipe && (cat pipe > got & $CT -o pipe; wait)") == 0);
  CHECK((read_bytes(folder / "got") == png));
  CHECK(folder.shell("{ printf front; $CT -o /dev/stdout; } > out; { head -c 5; $CT -o /dev/null; } < out") ==
        0);
  CHECK((read_bytes(folder / "out") == "front" + png));
  // Reports likewise.
  CHECK(folder.shell(
            "$CT -o b.png --stats /dev/fd/3 3> fd; $CT -o b.png --stats pipe & cat pipe > got; wait") == 0);
  CHECK_THAT(read_bytes(folder / "fd"), StartsWith("{"));
  CHECK_THAT(read_bytes(folder / "got"), StartsWith("{"));
  CHECK(folder.shell("$CT -o b.png --backend cell_emu --spes 1 --trace /dev/fd/3 3> fd") == 0);
  CHECK_THAT(read_bytes(folder / "fd"), StartsWith("{"));
  for (const char* name : {"/dev/null.png", "/dev/stdout.png", "/dev/fd/3.png"})
    CHECK_FALSE(std::filesystem::exists(name));
  CHECK_FALSE(std::filesystem::exists(folder / "pipe.png"));
}

TEST_CASE("a stream without a reader, or that is not open, is an error") {
  const SceneFolder folder;
  CHECK(folder.shell("$CT -o /dev/fd/9") == 1);
  CHECK_THAT(read_bytes(folder / "errors"), Contains("/dev/fd/9") && Contains("not open for writing"));
  CHECK(folder.shell("$CT -o b.png --stats /dev/fd/9") == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "b.png"));
  CHECK(folder.shell("mkfifo pipe; exec 3<>pipe 4>pipe 3>&-; $CT -o /dev/fd/4") == 1);
  CHECK_THAT(read_bytes(folder / "errors"), Contains("cannot be written"));
}

TEST_CASE("an overwritten picture keeps its mode and names; a protected one is an error") {
  const SceneFolder folder;
  write_bytes(folder / "a.png", "old");
  std::filesystem::create_hard_link(folder / "a.png", folder / "other.png");
  chmod((folder / "a.png").c_str(), 0640);
  REQUIRE(folder.render({"-o", "a.png"}).exit_code == 0);
  CHECK(load_image(folder / "other.png").width == 40);
  struct stat status = {};
  stat((folder / "a.png").c_str(), &status);
  CHECK((status.st_mode & 07777) == 0640);

  chmod((folder / "a.png").c_str(), 0444);
  const std::string before = read_bytes(folder / "a.png");
  const Outcome outcome = folder.render({"-o", "a.png", "--grey", "on"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("a.png: is write-protected"));
  CHECK((read_bytes(folder / "a.png") == before));
  write_bytes(folder / "s.json", "old");
  chmod((folder / "s.json").c_str(), 0444);
  CHECK_THAT(folder.render({"-o", "b.png", "--stats", "s.json"}).err, Contains("s.json: is write-protected"));
  CHECK_FALSE(std::filesystem::exists(folder / "b.png"));
}

TEST_CASE("a report does not take the place of the picture, the scene or another report") {
  const SceneFolder folder;
  std::filesystem::create_symlink("b.png", folder / "link");
  write_bytes(folder / "c.png", "old");
  std::filesystem::create_hard_link(folder / "c.png", folder / "hard");
  for (const auto& [picture, report] : {std::pair("a.png", "a.png"),
                                        {"a.png", "./a.png"},
                                        {"b.png", "link"},
                                        {"c.png", "hard"},
                                        {"a.png", "../NAME/a.png"}}) {
    std::string path = report;
    if (const auto at = path.find("NAME"); at != std::string::npos)
      path.replace(at, 4, folder.path().filename().string());
    CAPTURE(picture, path);
    const Outcome outcome = folder.render({"-o", picture, "--stats", path});
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.err, Contains("the picture and the statistics cannot be the same file"));
    CHECK(load_image(folder / picture).width == 40);
  }
  const Outcome frames = folder.render({"--final-frame", "2", "--stats", "s2.png"});
  CHECK(frames.exit_code == 1);
  CHECK(load_image(folder / "s2.png").width == 40);

  CHECK_THAT(folder.render({"--stats", "s.pov"}).err, Contains("the scene and the statistics"));
  CHECK((read_bytes(folder / "s.pov") == kScene));
  const Outcome traces = folder.render(
      {"--backend", "cell_emu", "--spes", "1", "-o", "d.png", "--trace", "t", "--stats", "./t"});
  CHECK(traces.exit_code == 1);
  CHECK_THAT(traces.err, Contains("the statistics and the trace"));
  CHECK_FALSE(std::filesystem::exists(folder / "d.png"));
  CHECK(folder.render({"-o", "/dev/null", "--stats", "/dev/null"}).exit_code == 0);
  CHECK(folder.shell("$CT -o /dev/stdout --stats - | cat > both") == 0); // cat's exit code
  CHECK_THAT(read_bytes(folder / "errors"), Contains("the picture and the statistics"));
}

TEST_CASE("every frame has alpha if it is asked for") {
  const SceneFolder folder;
  write_bytes(folder / "s.pov",
              "#version 3.7; global_settings { assumed_gamma 1 } camera { location -5*z look_at 0 }\n"
              "plane { z, 0 pigment { rgbt <1, 0, 0, clock> } finish { emission 1 } }\n");
  for (const std::string bits : {"8", "16"}) {
    REQUIRE(folder.render({"--alpha", "on", "--final-frame", "2", "--bits", bits}).exit_code == 0);
    for (const char* name : {"s1.png", "s2.png"})
      CHECK(read_bytes(folder / name)[25] == 6);
  }
}

TEST_CASE("pictures of each format are POV-Ray's") {
  if (!is_able("command -v povray") || !imagemagick_reads("TGA")) return;
  const SceneFolder folder;
  struct Case {
    std::string switches, extension;
    std::vector<std::string> options;
  };
  const std::vector<Case> cases = {
      {"+FN", "png", {}},
      {"+FN +UA", "png", {"--alpha", "on"}},
      {"+FT", "tga", {}},
      {"+FT +UA", "tga", {"--alpha", "on"}},
      {"+FC +UA", "tga", {"--alpha", "on", "--compression", "rle"}},
      {"+FB", "bmp", {}},
      {"+FB +UA", "bmp", {"--alpha", "on"}},
      {"+FJ", "jpg", {}},
      {"+FJ +UA", "jpg", {"--alpha", "on"}},
      {"+FJ Compression=40", "jpg", {"--jpeg-quality", "40"}},
      {"+FP +UA", "ppm", {"--alpha", "on"}},
      {"+FNg", "png", {"--grey", "on"}},
      {"+FNg +UA", "png", {"--grey", "on", "--alpha", "on"}},
      {"+FN File_Gamma=1.0", "png", {"--file-gamma", "1.0"}},
      {"+FN +UA File_Gamma=2.2", "png", {"--alpha", "on", "--file-gamma", "2.2"}},
      {"+FT File_Gamma=1.0", "tga", {"--file-gamma", "1.0"}},
  };
  for (const auto& [switches, extension, options] : cases) {
    const std::string ours = "ours." + extension, theirs = "theirs." + extension;
    CAPTURE(switches);
    std::vector<std::string> arguments = options;
    arguments.insert(arguments.end(), {"-o", ours});
    REQUIRE(folder.render(arguments).exit_code == 0);
    printed_by(folder, "povray -D -P -A -J +WT1 +W40 +H30 +Is.pov +Otheirs " + switches);
    const Image a = by_imagemagick(folder, ours), b = by_imagemagick(folder, theirs);
    CHECK(compare_images(a, b).max_difference <= 1);
    const std::string what = "identify -format '%[channels] %z %[colorspace]' ";
    CHECK(printed_by(folder, what + ours) == printed_by(folder, what + theirs));
    CHECK(compare_images(load_image(folder / theirs), load_image(folder / ours)).max_difference <= 1);
  }
}
