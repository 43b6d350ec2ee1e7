#include "cli/pov_switches.hpp"

#include "celltrace/error.hpp"

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;
using celltrace::InputError;
using celltrace::cli::translate_pov_switches;
using Arguments = std::vector<std::string>;

namespace {

/// Without the leading "render".
Arguments translated(const Arguments& arguments) {
  Arguments result = translate_pov_switches(arguments).arguments;
  REQUIRE(result.at(0) == "render");
  result.erase(result.begin());
  return result;
}

std::size_t notes(const Arguments& arguments) {
  return translate_pov_switches(arguments).notes.size();
}

} // namespace

TEST_CASE("a scene alone means render") {
  CHECK(translated({"a.pov"}) == Arguments{"a.pov"});
  CHECK(translated({"render", "a.pov"}) == Arguments{"a.pov"});
  CHECK(translated({"+Ia.pov"}) == Arguments{"a.pov"});
  CHECK(translated({"--quiet", "a.pov"}) == Arguments{"--quiet", "a.pov"});
}

TEST_CASE("other commands are left alone") {
  for (const Arguments& arguments :
       {Arguments{}, Arguments{"compare", "+a.png", "-D"}, Arguments{"spu", "p.elf", "+W640", "-D"},
        Arguments{"--version"}, Arguments{"--help"}, Arguments{"-h"}})
    CHECK(translate_pov_switches(arguments).arguments == arguments);
}

TEST_CASE("a command line as POV-Ray's users write it") {
  CHECK(translated({"+W800", "+H600", "+Iscenes/a.pov", "+Oout.png", "+L/usr/inc", "+WT4", "+Q9", "-A",
                    "+FN8"}) == Arguments{"-W", "800", "-H", "600", "scenes/a.pov", "-o", "out.png", "-L",
                                          "/usr/inc", "--spes", "4"});
  CHECK(translated({"Width=32", "height=16", "Input_File_Name=a.pov", "Output_File_Name=b.png",
                    "Library_Path=l", "Declare=x=1", "Work_Threads=2", "Antialias=off", "Quality=11",
                    "Output_File_Type=N"}) == Arguments{"-W", "32", "-H", "16", "a.pov", "-o", "b.png", "-L",
                                                        "l", "--declare", "x=1", "--spes", "2"});
}

TEST_CASE("switches are read in either case and with either sign") {
  CHECK(translated({"-w32", "+h16", "-ia.pov", "-ob.png"}) ==
        Arguments{"-W", "32", "-H", "16", "a.pov", "-o", "b.png"});
}

TEST_CASE("extensions are added as POV-Ray adds them") {
  CHECK(translated({"+Iscene", "+Opicture"}) == Arguments{"scene.pov", "-o", "picture.png"});
  CHECK(translated({"+Ia.b/scene", "+Oout/"}) == Arguments{"a.b/scene.pov", "-o", "out/"});
}

TEST_CASE("harmless switches are ignored with a note") {
  const Arguments harmless = {"+D",    "-D",    "+DGT",        "+P",        "-P",       "-J",
                              "+J0.5", "+V",    "+X10",        "+B64",      "+C",       "+R3",
                              "+MB10", "+WL5",  "+UV",         "-UL",       "+GFa.txt", "+BS16",
                              "+AM2",  "+SP64", "Display=off", "Verbose=on"};
  for (const std::string& text : harmless) {
    CAPTURE(text);
    CHECK(translated({text, "a.pov"}) == Arguments{"a.pov"});
    CHECK(notes({text, "a.pov"}) == 1);
  }
  CHECK_THAT(translate_pov_switches({"-D", "a.pov"}).notes.at(0), Contains("'-D' has no effect here"));
  CHECK(notes({"+W640", "-A", "-UA", "+Q9", "a.pov"}) == 0);
}

TEST_CASE("switches that would change the picture are refused by name") {
  const Arguments refused = {"+A",           "+A0.3",
                             "+UA",          "+SR10",
                             "+ER20",        "+SC0.5",
                             "+EC1",         "+Q4",
                             "+FN16",        "+FT",
                             "+FP",          "-F",
                             "+KFF10",       "+K0.5",
                             "+SF2",         "+HIa.inc",
                             "+UF",          "+MV3.5",
                             "Antialias=on", "Clock=1",
                             "Start_Row=5",  "Output_File_Type=T"};
  for (const std::string& text : refused) {
    CAPTURE(text);
    CHECK_THROWS_WITH(translate_pov_switches({text, "a.pov"}),
                      Contains("not supported yet") && Contains(text));
  }
  CHECK_THROWS_WITH(translate_pov_switches({"+A0.3", "a.pov"}), "'+A0.3': antialiasing is not supported yet");
}

TEST_CASE("unknown and unfinished switches are refused by name") {
  for (const std::string text : {"+Z", "+Y7", "+Pause", "+Jx", "+", "Depth=5", "=5", "+W", "+Wx", "+I", "+O",
                                 "+L", "+Q", "Width=", "+H12a"}) {
    if (text == "+" || text == "=5") { // no switch and no setting: files with odd names
      CHECK(translated({text}) == Arguments{text});
      continue;
    }
    CAPTURE(text);
    CHECK_THROWS_WITH(translate_pov_switches({text, "a.pov"}), Contains("'" + text + "'"));
  }
}

TEST_CASE("celltrace's own options and their values pass through") {
  const Arguments own = {"-o",  "+x.png", "-W", "8",           "--stats", "-",    "--declare",
                         "x=1", "--seed", "+5", "--cache=off", "--quiet", "a.pov"};
  CHECK(translated(own) == own);
  CHECK(translated({"--quiet", "+W8"}) == Arguments{"--quiet", "-W", "8"});
  CHECK(translated({"--faults", "+W8"}) == Arguments{"--faults", "-W", "8"});
  CHECK(translated({"--trace", "+t.json", "+W8"}) == Arguments{"--trace", "+t.json", "-W", "8"});
  CHECK(translated({"--cache=off", "+W8"}) == Arguments{"--cache=off", "-W", "8"});
  CHECK(translated({"+W8", "--", "+W8", "-o"}) == Arguments{"-W", "8", "--", "+W8", "-o"});
  CHECK(translated({"./a=b.pov"}) == Arguments{"./a=b.pov"});
  CHECK(translated({"a.pov", "-h"}) == Arguments{"a.pov", "-h"});
}
