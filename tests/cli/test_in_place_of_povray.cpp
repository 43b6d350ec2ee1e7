// The program as other programs start it in place of povray.
#include "cli/program_run.hpp"
#include "image/picture_files.hpp"

#include <filesystem>
#include <regex>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
namespace fs = std::filesystem;

namespace {

const std::string kScene =
    "camera { location -5*z look_at 0 } sphere { 0, 1 pigment { rgb 1 } finish { ambient 1 } }\n";

/// A user with a scene s.pov in the current folder, and a home without files.
struct User {
  TemporaryFolder folder;
  std::vector<std::string> variables = {"HOME=" + (folder / "home").string(),
                                        "POVINI=", "CELLTRACE_OPTIONS="};

  User() {
    fs::create_directories(folder / "home/.povray/3.7");
    write_bytes(folder / "s.pov", kScene);
  }
  Outcome povray(const std::vector<std::string>& arguments) const {
    return celltrace_run(folder, arguments, {"/some/folder/povray", variables});
  }
  Outcome celltrace(const std::vector<std::string>& arguments) const {
    return celltrace_run(folder, arguments, {"celltrace", variables});
  }
  std::string size_of(const std::string& name) const {
    const Image picture = load_image(folder / name);
    return std::to_string(picture.width) + 'x' + std::to_string(picture.height);
  }
};

std::string writing(const std::string& name) {
  return "#fopen F \"" + name + "\" write #write (F, \"1,\") #fclose F\n" + kScene;
}

} // namespace

TEST_CASE("under the name povray the INI files of POV-Ray count") {
  User user;
  write_bytes(user.folder / "home/.povray/3.7/povray.ini", "Width=20\nHeight=10\nDisplay=on\nVerbose=off\n");
  const Outcome outcome = user.povray({"+Is.pov"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(user.size_of("s.png") == "20x10");
  CHECK(outcome.err.find("note:") == outcome.err.npos); // a user's defaults are no news
  CHECK_THAT(user.povray({"+Is.pov", "Display=off"}).err, Contains("note: 'Display=off'"));

  write_bytes(user.folder / "povray.ini", "Width=30\n");
  REQUIRE(user.povray({"+Is.pov", "+H5"}).exit_code == 0);
  CHECK(user.size_of("s.png") == "30x5");
  REQUIRE(user.povray({"+Is.pov"}).exit_code == 0);
  CHECK(user.size_of("s.png") == "30x120"); // POV-Ray's default
  write_bytes(user.folder / "my.ini", "Width=40\nHeight=8\n");
  user.variables[1] = "POVINI=my.ini";
  REQUIRE(user.povray({"+Is.pov"}).exit_code == 0);
  CHECK(user.size_of("s.png") == "40x8");
  REQUIRE(user.celltrace({"+Is.pov", "--povray", "on"}).exit_code == 0);
  CHECK(user.size_of("s.png") == "40x8");
  // By its own name, and where that is switched off, the program has its own defaults.
  REQUIRE(user.celltrace({"+Is.pov", "-W", "16"}).exit_code == 0);
  CHECK(user.size_of("s.png") == "16x480");
  REQUIRE(user.povray({"+Is.pov", "+H16", "--povray", "off"}).exit_code == 0);
  CHECK(user.size_of("s.png") == "640x16");

  write_bytes(user.folder / "my.ini", "\nWidth=x\n");
  const Outcome broken = user.povray({"+Is.pov"});
  CHECK(broken.exit_code == 1);
  CHECK_THAT(broken.err, Contains("my.ini:2: "));
  user.variables[1] = "POVINI=none.ini";
  const Outcome without = user.povray({"+Is.pov"});
  CHECK(without.exit_code == 0);
  CHECK_THAT(without.err, Contains("note: POVINI: none.ini cannot be read"));
}

TEST_CASE("a symbolic link called povray is enough") {
  const User user;
  write_bytes(user.folder / "povray.ini", "+W20 +H10");
  fs::create_symlink(CELLTRACE_PROGRAM, user.folder / "povray");
  const std::string command =
      "cd '" + user.folder.path().string() + "' && PATH=.:$PATH povray +Is.pov +Oa.png 2>/dev/null";
  REQUIRE(std::system(command.c_str()) == 0);
  CHECK(user.size_of("a.png") == "20x10");
}

TEST_CASE("in place of povray scenes and INI files are found in the library paths") {
  const User user;
  fs::create_directory(user.folder / "lib");
  write_bytes(user.folder / "povray.ini", "Library_Path=lib\n");
  write_bytes(user.folder / "lib/small.ini", "+W20 +H10\n");
  write_bytes(user.folder / "lib/t.pov", kScene);
  REQUIRE(user.povray({"+It.pov", "small.ini"}).exit_code == 0);
  CHECK(user.size_of("t.png") == "20x10"); // in the current folder
  write_bytes(user.folder / "small.ini", "+W30 +H10\n");
  REQUIRE(user.povray({"+It.pov", "small.ini"}).exit_code == 0);
  CHECK(user.size_of("t.png") == "30x10");
  CHECK(user.celltrace({"+It.pov", "+Llib", "+W8", "+H6"}).exit_code == 0);
  CHECK_THAT(user.povray({"+It.pov", "none.ini"}).err, Contains("none.ini: there is no such file"));
}

TEST_CASE("a picture without a name stands beside its scene, as POV-Ray's does") {
  const User user;
  fs::create_directory(user.folder / "sub");
  write_bytes(user.folder / "sub/t.pov", kScene);
  REQUIRE(user.povray({"sub/t.pov", "+W8", "+H6"}).exit_code == 0);
  CHECK(fs::exists(user.folder / "sub/t.png"));
  REQUIRE(user.povray({"sub/t.pov", "+W8", "+H6", "+Oa"}).exit_code == 0);
  CHECK(fs::exists(user.folder / "a.png"));
  REQUIRE(user.povray({"sub/t.pov", "+W8", "+H6", "+O./"}).exit_code == 0);
  CHECK(fs::exists(user.folder / "t.png"));
  fs::remove(user.folder / "sub/t.png");
  REQUIRE(user.celltrace({"sub/t.pov", "+W8", "+H6"}).exit_code == 0);
  CHECK_FALSE(fs::exists(user.folder / "sub/t.png"));
}

TEST_CASE("povray's version and help go to stderr") {
  const User user;
  for (const char* word : {"--version", "-version", "--help", "-h", "-?"}) {
    const Outcome outcome = user.povray({word});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, StartsWith("celltrace 0.") && Contains("POV-Ray 3.7"));
  }
  CHECK_THAT(user.celltrace({"--version"}).out, StartsWith("celltrace 0."));
  const Outcome nothing = user.povray({});
  CHECK(nothing.exit_code == 1);
  CHECK_THAT(nothing.err, Contains("scene"));
  // The names of commands are names of files.
  CHECK_THAT(user.povray({"compare"}).err, Contains("there is no such file"));
}

TEST_CASE("programs read POV-Ray's progress from stderr") {
  const User user;
  const Outcome outcome = user.povray({"+Is.pov", "+W64", "+H48"});
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("==== [Parsing...] ====\n") && Contains("==== [Rendering...] ====\n") &&
                              Contains("Rendered 3072 of 3072 pixels (100%)\r\n"));
  const std::regex time(R"(\n  Trace Time:       0 hours  0 minutes  \d seconds \(\d\.\d{3} seconds\)\n)");
  CHECK(std::regex_search(outcome.err, time));
  const Outcome terse = user.povray({"+Is.pov", "+W64", "+H48", "-V"});
  CHECK_THAT(terse.err, !Contains("Rendered ") && Contains("Trace Time"));
  CHECK_THAT(user.celltrace({"+Is.pov", "+W64", "+H48"}).err, !Contains("Rendered ") && !Contains("Trace"));
  CHECK_THAT(user.celltrace({"+Is.pov", "+W64", "+H48", "+V"}).err,
             Contains("Rendered 3072 of 3072 pixels (100%)\r\n") && Contains("Trace Time"));
  CHECK(user.povray({"+Is.pov", "+W64", "+H48", "--quiet"}).err.empty());

  const Outcome frames = user.povray({"+Is.pov", "+W64", "+H48", "+KFF3", "+SF2"});
  CHECK_THAT(frames.err, Contains("Rendering frame 1 of 2\n") && Contains("Rendering frame 2 of 2\n") &&
                             !Contains("frame 3"));
  const std::string last = "Rendered 3072 of 3072 pixels (100%)\r\n";
  const std::size_t first = frames.err.find(last);
  REQUIRE(first != frames.err.npos);
  CHECK(frames.err.find(last, first + 1) != frames.err.npos);
}

TEST_CASE("in place of povray exit codes are POV-Ray's") {
  const User user;
  write_bytes(user.folder / "bad.pov", "sphere {");
  CHECK(user.povray({"+Is.pov", "+W8", "+H6"}).exit_code == 0);
  CHECK(user.povray({"+Ibad.pov", "+W8", "+H6"}).exit_code == 1);
  CHECK(user.povray({"+Inone.pov"}).exit_code == 1);
  CHECK(user.povray({"none.ini"}).exit_code == 1);
  CHECK(user.povray({"+Is.pov", "+foo"}).exit_code == 1);
  CHECK(user.povray({"+Is.pov", "+W8", "+H6", "+Onone/a.png"}).exit_code == 1);
  write_bytes(user.folder / "long.pov",
              kScene + "#declare I = 0; #while (I < 4000) sphere { <I, I, I> / 500, 1 pigment { rgbt 0.9 } } "
                       "#declare I = I + 1; #end");
  Run run(user.folder, {"+Ilong.pov", "+W2000", "+H2000", "+A0.0", "+R9"}, {"povray", user.variables});
  run.interrupt();
  CHECK(run.finish().exit_code == 2);
}

TEST_CASE("in place of povray scenes do what povray.conf permits") {
  User user;
  fs::create_directory(user.folder / "deep");
  write_bytes(user.folder / "home/.povray/3.7/povray.conf",
              "[File I/O Security]\nrestricted\n[Permitted Paths]\nread+write = .\nbogus\n");
  const auto render = [&](const std::string& text, bool as_povray = true) {
    write_bytes(user.folder / "w.pov", text);
    const std::vector<std::string> arguments = {"+Iw.pov", "+W8", "+H6"};
    return as_povray ? user.povray(arguments) : user.celltrace(arguments);
  };
  const Outcome written = render(writing("out.txt"));
  CAPTURE(written.err);
  CHECK(written.exit_code == 0);
  CHECK_THAT(written.err, Contains("warning: ") && Contains("povray.conf:5: 'bogus' is no"));
  CHECK(read_bytes(user.folder / "out.txt") == "1,");
  fs::remove(user.folder / "out.txt");
  CHECK(render(writing("out.txt"), false).exit_code == 1);
  for (const std::string& name :
       {std::string("deep/out.txt"), (user.folder / "home/out.txt").string(), std::string("../out.txt")}) {
    const Outcome refused = render(writing(name));
    CHECK(refused.exit_code == 1);
    CHECK_THAT(refused.err, Contains("povray.conf"));
  }
  CHECK_FALSE(fs::exists(user.folder / "deep/out.txt"));

  // Files of the current folder are found wherever the scene is; others are read where povray.conf says so.
  fs::create_directories(user.folder / "elsewhere/scenes");
  write_bytes(user.folder / "elsewhere/scenes/i.pov", "#include \"a.inc\"\n" + kScene);
  write_bytes(user.folder / "a.inc", "");
  CHECK(user.povray({"+Ielsewhere/scenes/i.pov", "+W8", "+H6"}).exit_code == 0);
  write_bytes(user.folder / "elsewhere/b.inc", "");
  write_bytes(user.folder / "elsewhere/scenes/j.pov", "#include \"../b.inc\"\n" + kScene);
  CHECK(user.povray({"+Ielsewhere/scenes/j.pov", "+W8", "+H6"}).exit_code == 1);
  fs::remove(user.folder / "home/.povray/3.7/povray.conf");
  CHECK(user.povray({"+Ielsewhere/scenes/j.pov", "+W8", "+H6"}).exit_code == 0); // /tmp is for all
}

TEST_CASE("CELLTRACE_OPTIONS stand before the arguments") {
  User user;
  const auto options = [&](const std::string& text) { user.variables[2] = "CELLTRACE_OPTIONS=" + text; };
  options("-W 20 -H 10 --file-type 'ppm'");
  REQUIRE(user.celltrace({"s.pov"}).exit_code == 0);
  CHECK(user.size_of("s.ppm") == "20x10");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"s.pov", "-W", "8"}, {"+Is.pov", "+W8"}, {"render", "s.pov", "--width=8"}}) {
    REQUIRE(user.celltrace(arguments).exit_code == 0);
    CHECK(user.size_of("s.ppm") == "8x10");
  }
  // They win over an INI file that nobody named.
  write_bytes(user.folder / "povray.ini", "+W30 +H30");
  REQUIRE(user.povray({"+Is.pov", "+H5"}).exit_code == 0);
  CHECK(user.size_of("s.ppm") == "20x5");
  options("+FP +W12 --povray on");
  REQUIRE(user.celltrace({"s.pov"}).exit_code == 0);
  CHECK(user.size_of("s.ppm") == "12x30");

  options("--allow-write . --quiet");
  write_bytes(user.folder / "w.pov", writing("out.txt"));
  const Outcome written = user.celltrace({"w.pov", "+W8", "+H6"});
  CHECK(written.exit_code == 0);
  CHECK(written.err.empty());

  options("--nonsense 1");
  const Outcome unknown = user.celltrace({"s.pov", "+W8", "+H6"});
  CHECK(unknown.exit_code == 1);
  CHECK_THAT(unknown.err, StartsWith("celltrace: error: CELLTRACE_OPTIONS: ") && Contains("--nonsense"));
  CHECK_THAT(user.celltrace({"s.pov", "+foo"}).err, !Contains("CELLTRACE_OPTIONS"));
  options("--allow");
  CHECK_THAT(user.povray({"s.pov"}).err, Contains("CELLTRACE_OPTIONS: --allow: its value is missing"));
  // Other commands do not ask for them.
  CHECK(user.celltrace({"--version"}).exit_code == 0);
  CHECK(user.celltrace({"compare", "s.ppm", "s.ppm"}).exit_code == 0);
}
