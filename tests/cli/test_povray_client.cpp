// What makes the program stand in for povray. What POV-Ray does was tried with 3.7.0.10 of Debian 12.
#include "cli/pov_report.hpp"
#include "cli/povray_client.hpp"
#include "cli/povray_conf.hpp"
#include "files.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <sstream>

using namespace celltrace;
using namespace celltrace::cli;
using Catch::Matchers::Contains;
using celltrace::test::TemporaryFolder;
using celltrace::test::write_bytes;
namespace fs = std::filesystem;

namespace {

/// Places in a folder of its own: `home`, `system` and `installation`, all there and empty.
struct Places {
  TemporaryFolder folder;
  PovrayPlaces places;

  Places() {
    places.home = folder / "home";
    places.system_folders = {folder / "none", folder / "system"};
    places.installation = folder / "installation";
    fs::create_directories(places.home / ".povray/3.7");
    fs::create_directories(folder / "system");
    fs::create_directories(places.installation / "include");
  }

  PovrayConf conf(const std::string& text, std::size_t count_of_warnings = 0) const {
    std::vector<std::string> warnings;
    const PovrayConf conf = parse_povray_conf(text, "c", places, warnings);
    CAPTURE(text, warnings);
    CHECK(warnings.size() == count_of_warnings);
    return conf;
  }
};

struct MovedInto {
  fs::path before = fs::current_path();
  explicit MovedInto(const fs::path& folder) { fs::current_path(folder); }
  ~MovedInto() { fs::current_path(before); }
};

bool reads(const PovrayConf& conf, const fs::path& file) {
  return conf.permits(file, FileUse::read);
}
bool writes(const PovrayConf& conf, const fs::path& file) {
  return conf.permits(file, FileUse::write);
}

} // namespace

TEST_CASE("the name decides whether the program stands in for povray") {
  CHECK(stands_in_for_povray("povray", {}));
  CHECK(stands_in_for_povray("/usr/bin/povray", {"s.pov"}));
  CHECK_FALSE(stands_in_for_povray("celltrace", {"povray"}));
  CHECK_FALSE(stands_in_for_povray("/povray/celltrace", {}));
  CHECK_FALSE(stands_in_for_povray("mypovray", {}));
  CHECK(stands_in_for_povray("celltrace", {"s.pov", "--povray", "on"}));
  CHECK(stands_in_for_povray("celltrace", {"--povray=on"}));
  CHECK_FALSE(stands_in_for_povray("povray", {"--povray", "on", "--povray=off"}));
  CHECK_FALSE(stands_in_for_povray("celltrace", {"--", "--povray", "on"}));
}

TEST_CASE("povray's version and help are asked for anywhere") {
  for (const char* word : {"--version", "-version", "--V"}) {
    const auto text = povray_information({"s.pov", word});
    REQUIRE(text);
    CHECK_THAT(*text, Catch::Matchers::StartsWith("celltrace 0.") && Contains("POV-Ray 3.7") &&
                          Contains("Version 3.7"));
  }
  for (const char* word : {"--help", "-help", "-h", "-?"})
    CHECK_THAT(povray_information({word}).value_or(""), Contains("POV-Ray 3.7") && Contains("+W640"));
  CHECK_FALSE(povray_information({"s.pov", "-H", "+h8", "-V"}));
  CHECK_FALSE(povray_information({"--", "-h"}));
}

TEST_CASE("one INI file is read, the first that there is") {
  const Places here;
  TemporaryFolder work;
  const MovedInto moved(work.path());
  PovrayPlaces places = here.places;
  std::vector<std::string> notes;
  const auto found = [&] { return find_povray_ini(places, notes).value_or("").string(); };
  CHECK(found().empty());
  const std::string home = places.home.string();
  // From the last to the first.
  for (const std::string& file :
       {home + "/.povrayrc", (here.folder / "system/povray.ini").string(), home + "/.povray/3.7/povray.ini",
        std::string("./povray.ini"), (work / "my.ini").string()}) {
    if (file == work / "my.ini") {
      places.ini = file;
      CHECK(found() == "./povray.ini");
      REQUIRE(notes.size() == 1);
      CHECK_THAT(notes[0], Contains("POVINI") && Contains("my.ini"));
    }
    write_bytes(file, "+W8");
    CHECK(found() == file);
  }
  CHECK(notes.size() == 1);
  places.ini = work.path(); // a folder is no file
  CHECK(found() == "./povray.ini");
  places.home.clear();
  places.ini.clear();
  fs::remove("povray.ini");
  CHECK(found() == (here.folder / "system/povray.ini").string());
}

TEST_CASE("defaults are POV-Ray's") {
  const Places here;
  TemporaryFolder work;
  const MovedInto moved(work.path());
  std::vector<std::string> notes;
  using Words = std::vector<std::string>;
  CHECK(povray_defaults(here.places, notes) == Words{"--povray", "on", "-W", "160", "-H", "120"});
  write_bytes("povray.ini", "+W8");
  CHECK(povray_defaults(here.places, notes).back() == "Include_INI=./povray.ini");
  CHECK(notes.empty());
}

TEST_CASE("povray.conf permits folders, alone or with those below") {
  const Places here;
  const fs::path home = here.places.home, include = here.places.installation / "include";
  fs::create_directories(home / "a b/deep");
  const PovrayConf conf = here.conf("; a comment\n"
                                    "[File I/O Security]\n"
                                    "restricted ; so\n"
                                    "\n"
                                    "[Shellout Security]\r\n"
                                    "allowed\r\n"
                                    "[Permitted Paths]\r\n"
                                    "read = %HOME%\r\n"
                                    "read* = %INSTALLDIR%/include ; all\n"
                                    "read * = /none/of/these\n"
                                    "  read+write=\"%HOME%/a b\"  \n");
  CHECK(conf.security == FileSecurity::restricted);
  CHECK(conf.folders.size() == 3);
  CHECK(reads(conf, home / "x"));
  CHECK_FALSE(reads(conf, home / ".povray/x"));
  CHECK_FALSE(writes(conf, home / "x"));
  CHECK(reads(conf, include / "x"));
  CHECK(reads(conf, include / "y/x"));
  CHECK_FALSE(reads(conf, include.string() + "2/x"));
  CHECK(writes(conf, home / "a b/x"));
  CHECK(reads(conf, home / "a b/x"));
  CHECK_FALSE(writes(conf, home / "a b/deep/x"));
  CHECK_FALSE(reads(conf, "/etc/passwd"));
}

TEST_CASE("povray.conf may permit all, or reading all") {
  const Places here;
  const PovrayConf none = here.conf("[File I/O Security]\nnone\n");
  CHECK((reads(none, "/etc/x") && writes(none, "/etc/x")));
  const PovrayConf read_only =
      here.conf("[file i/o security]\nRead-Only\n[permitted paths]\nread+write*=%HOME%");
  CHECK((reads(read_only, "/etc/x") && !writes(read_only, "/etc/x")));
  CHECK(writes(read_only, here.places.home / "a/x"));
}

TEST_CASE("a povray.conf that is not understood permits nothing") {
  const Places here;
  // Without its section, with an unknown word, and with two, the stricter one counts.
  for (const auto& [text, warnings] : std::vector<std::pair<std::string, std::size_t>>{
           {"", 0},
           {"none\n", 0},
           {"[File I/O Security\nnone\n", 1},
           {"[Files]\nnone\n", 1},
           {"[File I/O Security]\nnone of these\n", 1},
           {"[File I/O Security]\nnone\nbogus\n", 1},
           {"[File I/O Security]\nrestricted\n[File I/O Security]\nnone\n", 0},
           {"[Permitted Paths]\nread* /\nwrite = /\nREAD* = /\nread** = /\n= /\nread* =\nread* = \"\"\n", 7},
           {"[Permitted Paths]\nread* = \"/\nread* = '/' x\nread* = / tmp\n", 3},
           {"[Permitted Paths]\nread+write* = %FOO%\nread* = /dev/null\nread* = ;/\n", 1},
           {"[\n]\n[]\n", 2}}) {
    const PovrayConf conf = here.conf(text, warnings);
    CHECK(conf.security == FileSecurity::restricted);
    CHECK(conf.folders.empty());
  }
  std::vector<std::string> warnings;
  PovrayPlaces places = here.places;
  places.home.clear();
  CHECK(parse_povray_conf("[Permitted Paths]\nread* = %HOME%\nread* = %HOME%/..\n", "c", places, warnings)
            .folders.empty());
  parse_povray_conf("\n[Permitted Paths]\nfoo\n", "c.conf", places, warnings);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::Matchers::StartsWith("c.conf:3: 'foo' is no"));
}

TEST_CASE("a user's povray.conf can only be stricter than the system's") {
  const Places here;
  TemporaryFolder work;
  const MovedInto moved(work.path());
  fs::create_directory("deep");
  const auto permits = [&](const fs::path& file, FileUse use, std::size_t count_of_warnings = 0) {
    ParseOptions options;
    std::vector<std::string> warnings;
    permit_as_povray(options, here.places, warnings);
    CAPTURE(warnings);
    CHECK(warnings.size() == count_of_warnings);
    CHECK(options.working_folder == ".");
    return options.permits(file, use);
  };
  // None: Debian's.
  CHECK(permits(work / "x", FileUse::write));
  CHECK(permits(here.places.home / "a/x", FileUse::read));
  CHECK_FALSE(permits("/var/x", FileUse::read));
  CHECK_FALSE(permits("/etc/x", FileUse::write));
  const fs::path system = here.folder / "system/povray.conf",
                 own = here.places.home / ".povray/3.7/povray.conf";
  write_bytes(system, "[File I/O Security]\nnone\n");
  CHECK(permits("/etc/x", FileUse::write));
  write_bytes(own, "[Permitted Paths]\nread+write = .\n");
  CHECK(permits(work / "x", FileUse::write));
  CHECK_FALSE(permits(work / "deep/x", FileUse::read));
  CHECK_FALSE(permits("/etc/x", FileUse::write));
  write_bytes(system, "[Permitted Paths]\nread* = .\n");
  write_bytes(own, "[File I/O Security]\nnone\n");
  CHECK(permits(work / "deep/x", FileUse::read));
  CHECK_FALSE(permits(work / "x", FileUse::write));
  // A file that is there but cannot be read.
  fs::remove(system);
  fs::create_directory(system);
  CHECK_FALSE(permits(work / "x", FileUse::read, 1));
}

TEST_CASE("POV-Ray's progress is for programs that read stderr") {
  RenderRequest request;
  const auto parts = [&](bool is_terminal = false) {
    const PovReportParts found = report_parts(request, is_terminal);
    return std::string(found.progress ? "p" : "") + (found.steps ? "s" : "");
  };
  CHECK(parts().empty());
  request.verbose = true;
  CHECK(parts() == "ps");
  CHECK(parts(true).empty());
  request.stands_in_for_povray = true;
  request.verbose.reset();
  CHECK(parts() == "ps");
  request.verbose = false;
  CHECK(parts() == "s");
  CHECK(parts(true).empty());
  request.quiet = true;
  CHECK(parts().empty());
}

TEST_CASE("POV-Ray's progress counts the pixels of the region") {
  std::ostringstream out;
  PovReport report(out, {true, true});
  RenderOptions options;
  options.width = 64;
  options.height = 48;
  options.region = PictureRegion{0, 64, 10, 20};
  report.begin_frame(1, 3);
  report.begin_parsing();
  report.begin_rendering(options);
  report.update(0);
  report.update(0.25);
  report.update(0.5); // within a tenth of a second
  report.update(1);
  report.finish(3723.5);
  CHECK(out.str() == "Rendering frame 2 of 3\n"
                     "==== [Parsing...] ====\n"
                     "==== [Rendering...] ====\n"
                     "Rendered 160 of 640 pixels (25%)\rRendered 640 of 640 pixels (100%)\r\n"
                     "  Trace Time:       1 hours  2 minutes  3 seconds (3723.500 seconds)\n");
  out.str("");
  PovReport silent(out, {});
  silent.begin_frame(0, 1);
  silent.begin_parsing();
  silent.begin_rendering(options);
  silent.update(1);
  silent.finish(1);
  CHECK(out.str().empty());
}
