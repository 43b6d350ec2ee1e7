#include "cli/pov_switches.hpp"

#include "celltrace/error.hpp"

#include <catch2/catch.hpp>

#include <map>

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
                                          "/usr/inc", "--spes", "4", "--quality", "9", "--picture", "on",
                                          "--file-type", "png", "--bits", "8"});
  CHECK(translated({"Width=32", "height=16", "Input_File_Name=a.pov", "Output_File_Name=b.png",
                    "Library_Path=l", "Declare=x=1", "Work_Threads=2", "Antialias=off", "Quality=11",
                    "Output_File_Type=N"}) == Arguments{"-W", "32", "-H", "16", "a.pov", "-o", "b.png", "-L",
                                                        "l", "--declare", "x=1", "--spes", "2", "--quality",
                                                        "11", "--file-type", "png"});
}

TEST_CASE("switches are read in either case and with either sign") {
  CHECK(translated({"-w32", "+h16", "-ia.pov", "-ob.png"}) ==
        Arguments{"-W", "32", "-H", "16", "a.pov", "-o", "b.png"});
}

TEST_CASE("extensions are added as POV-Ray adds them") {
  // The picture's depends on its type.
  CHECK(translated({"+Iscene", "+Opicture"}) == Arguments{"scene.pov", "-o", "picture"});
  CHECK(translated({"+Ia.b/scene", "+Oout/"}) == Arguments{"a.b/scene.pov", "-o", "out/"});
}

TEST_CASE("harmless switches are ignored with a note") {
  const Arguments harmless = {"+D",    "-D",    "+DGT",   "+P",          "-P",
                              "+BM1",  "+X10",  "+B64",   "+BP",         "Bounding_Threshold=3",
                              "+MB10", "+WL5",  "+UV",    "-UL",         "+GFa.txt",
                              "+BS16", "+SP64", "+HR",    "Display=off", "Test_Abort=on",
                              "+GIa",  "+RP2",  "+MI128", "+BM2",        "Warning_Console=off"};
  for (const std::string& text : harmless) {
    CAPTURE(text);
    CHECK(translated({text, "a.pov"}) == Arguments{"a.pov"});
    CHECK(notes({text, "a.pov"}) == 1);
  }
  CHECK_THAT(translate_pov_switches({"-D", "a.pov"}).notes.at(0), Contains("'-D' has no effect here"));
  CHECK(notes({"+W640", "-A", "+A0.3", "+R3", "-J", "-UA", "+Q9", "a.pov"}) == 0);
}

TEST_CASE("switches that would change the picture are refused by name") {
  const Arguments refused = {"+FT", "+FJ", "+UF", "+HIa.inc", "Output_File_Type=T"};
  for (const std::string& text : refused) {
    CAPTURE(text);
    CHECK_THROWS_WITH(translate_pov_switches({text, "a.pov"}),
                      Contains("not supported yet") && Contains(text));
  }
  CHECK_THROWS_WITH(translate_pov_switches({"+UF", "a.pov"}),
                    Contains("'+UF'") && Contains("is not supported yet"));
}

TEST_CASE("unknown and unfinished switches are refused by name") {
  for (const std::string text :
       {"+Z",  "+Y7", "+Pause", "+Jx", "+",    "Depth=5", "=5",      "+W",
        "+Wx", "+I",  "+O",     "+L",  "+Q",   "Width=",  "+H12a",   "+S6",
        "+Ax", "+R",  "+AM",    "+SC", "+ECx", "+K",      "+K1.2.3", "Antialias_Gamma=no"}) {
    if (text == "+" || text == "=5") { // no switch and no setting: files with odd names
      CHECK(translated({text}) == Arguments{text});
      continue;
    }
    CAPTURE(text);
    CHECK_THROWS_WITH(translate_pov_switches({text, "a.pov"}), Contains("'" + text + "'"));
  }
}

TEST_CASE("antialiasing as POV-Ray's switches say it") {
  CHECK(translated({"+A"}) == Arguments{"--antialias", "0.3", "--antialias-jitter", "1"});
  CHECK(translated({"+A0.1", "-J"}) == Arguments{"--antialias", "0.1"});
  CHECK(translated({"-J", "+R4", "+AM2", "+A"}) ==
        Arguments{"--antialias", "0.3", "--antialias-method", "2", "--antialias-depth", "4"});
  CHECK(translated({"+A", "+J0.5"}) == Arguments{"--antialias", "0.3", "--antialias-jitter", "0.5"});
  CHECK(translated({"Antialias=on", "Antialias_Threshold=0.2", "Jitter=off", "Antialias_Depth=2",
                    "Sampling_Method=2", "Antialias_Gamma=2.2"}) ==
        Arguments{"--antialias", "0.2", "--antialias-method", "2", "--antialias-depth", "2",
                  "--antialias-gamma", "2.2"});
  CHECK(translated({"Antialias=on", "Jitter_Amount=0.7"}) ==
        Arguments{"--antialias", "0.3", "--antialias-jitter", "0.7"});
  // The last one counts, and nothing without +A.
  CHECK(translated({"+A0.3", "-A"}).empty());
  CHECK(translated({"+J", "+R3", "+AM1"}).empty());
  CHECK(translated({"+A", "+AM0"}).empty());
  // POV-Ray takes the nearest that there is.
  CHECK(translated({"+A", "+R0", "+AM3", "+J2"}) == Arguments{"--antialias", "0.3", "--antialias-method", "2",
                                                              "--antialias-depth", "1", "--antialias-jitter",
                                                              "1"});
  CHECK(translated({"+A", "+R12", "+J-1"}) == Arguments{"--antialias", "0.3", "--antialias-depth", "9"});
}

TEST_CASE("regions, quality, clock, file types") {
  CHECK(translated({"+SC0.25", "+EC20", "Start_Row=3", "End_Row=0.5"}) ==
        Arguments{"--start-column", "0.25", "--end-column", "20", "--start-row", "3", "--end-row", "0.5"});
  CHECK(translated({"+Q4", "+K0.5"}) == Arguments{"--quality", "4", "--clock", "0.5"});
  CHECK(translated({"+Q12"}) == Arguments{"--quality", "11"});
  CHECK(translated({"-F"}) == Arguments{"--picture", "off"});
  CHECK(translated({"+FP", "Output_to_File=off"}) == Arguments{"--picture", "off", "--file-type", "ppm"});
  CHECK(translated({"+FE", "+O-"}) == Arguments{"--picture", "on", "--file-type", "exr", "-o", "-"});
  CHECK(translated({"Output_File_Type=H"}) == Arguments{"--file-type", "hdr"});
  CHECK(translated({"+V"}) == Arguments{"--verbose", "on"});
  CHECK(translated({"Verbose=false"}) == Arguments{"--verbose", "off"});
  CHECK(translated({"+UA"}) == Arguments{"--alpha", "on"});
  CHECK(translated({"Output_Alpha=on", "-UA"}) == Arguments{"--alpha", "off"});
  CHECK_THROWS_WITH(translate_pov_switches({"+UA1", "a.pov"}), Contains("'+UA1'"));
  CHECK(translated({"+FN16"}) == Arguments{"--picture", "on", "--file-type", "png", "--bits", "16"});
  CHECK(translated({"+FN16", "+FP8"}) == Arguments{"--picture", "on", "--file-type", "ppm", "--bits", "8"});
  CHECK(translated({"Output_File_Type=P", "Bits_Per_Color=16"}) ==
        Arguments{"--file-type", "ppm", "--bits", "16"});
  CHECK(translated({"+MV3.1"}) == Arguments{"--language-version", "3.1"});
  CHECK(translated({"Version=3.7"}) == Arguments{"--language-version", "3.7"});
}

TEST_CASE("of what is repeated the last counts") {
  CHECK(translated({"+W10", "+H20", "+W30"}) == Arguments{"-W", "30", "-H", "20"});
  CHECK(translated({"+Ia.pov", "+W10", "+Ib"}) == Arguments{"b.pov", "-W", "10"});
  CHECK(translated({"+Ia.pov", "c.pov"}) == Arguments{"c.pov"});
  CHECK(translated({"+Ia.pov", "--quiet", "-W", "8"}) == Arguments{"a.pov", "--quiet", "-W", "8"});
  // Among celltrace's own options the order stays.
  CHECK(translated({"+W10", "-W", "20", "+W30"}) == Arguments{"-W", "10", "-W", "20", "-W", "30"});
  CHECK(translated({"+La", "+Lb", "Declare=x=1", "Declare=y=2"}) ==
        Arguments{"-L", "a", "-L", "b", "--declare", "x=1", "--declare", "y=2"});
}

namespace {

Arguments with_files(const Arguments& arguments, const std::map<std::string, std::string>& files) {
  const auto read = [&](const std::string& name) {
    const auto found = files.find(name);
    if (found == files.end()) throw InputError(name + ": cannot be read");
    return found->second;
  };
  Arguments result = translate_pov_switches(arguments, read).arguments;
  result.erase(result.begin());
  return result;
}

} // namespace

TEST_CASE("INI files") {
  const std::map<std::string, std::string> files = {
      {"a.ini", "; a comment\n"
                "Input_File_Name = a.pov ; another\r\n"
                "  Width=40\n# and this\n"
                "+H20 Declare=A=2 -J\n"
                "Library_Path=\"my files\"\n"
                "[Large]\nWidth=400\n[Small]\nWidth=4 ; tiny\nAntialias=on\n"},
      {"b.INI", "a.ini[large]\nInclude_INI=c.ini\n"},
      {"c.ini", "Output_File_Name='b.png'"},
      {"empty.ini", ""},
      {"wrong.ini", "\nWidth=40\nWidth=4x\n"},
      {"unknown.ini", "Foo=1\n"},
      {"open.ini", "+W4 '+H20\n"},
      {"bracket.ini", "[One\n"},
      {"itself.ini", "+W4 itself.ini\n"}};
  CHECK(with_files({"a.ini"}, files) ==
        Arguments{"a.pov", "-W", "40", "-H", "20", "--declare", "A=2", "-L", "my files"});
  CHECK(with_files({"a.ini", "+W7"}, files) ==
        Arguments{"a.pov", "-W", "7", "-H", "20", "--declare", "A=2", "-L", "my files"});
  CHECK(with_files({"a.ini[small]"}, files) == Arguments{"a.pov", "-W", "4", "-H", "20", "--declare", "A=2",
                                                         "-L", "my files", "--antialias", "0.3"});
  CHECK(with_files({"b.INI"}, files) ==
        Arguments{"a.pov", "-W", "400", "-H", "20", "--declare", "A=2", "-L", "my files", "-o", "b.png"});
  CHECK(with_files({"empty.ini", "x.pov"}, files) == Arguments{"x.pov"});
  CHECK(with_files({"-o", "x.ini"}, files) == Arguments{"-o", "x.ini"});

  CHECK_THROWS_WITH(with_files({"none.ini"}, files), "none.ini: cannot be read");
  CHECK_THROWS_WITH(with_files({"a.ini[medium]"}, files), "a.ini: has no section [medium]");
  CHECK_THROWS_WITH(with_files({"a.ini[small"}, files), "'a.ini[small': a section's name has to end with ]");
  CHECK_THROWS_WITH(with_files({"wrong.ini"}, files),
                    "wrong.ini:3: 'Width=4x' must be followed by a number, without a space");
  CHECK_THROWS_WITH(with_files({"unknown.ini"}, files),
                    "unknown.ini:1: 'Foo=1' is no setting of POV-Ray that is known here");
  CHECK_THROWS_WITH(with_files({"open.ini"}, files), "open.ini:1: a quote is not closed");
  CHECK_THROWS_WITH(with_files({"bracket.ini"}, files), "bracket.ini:1: a section's name has to end with ]");
  CHECK_THROWS_WITH(with_files({"itself.ini"}, files), Contains("include each other"));
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
