// Values of switches and settings: numbers, words and quotes.
#include "translated.hpp"

#include "celltrace/error.hpp"

using Catch::Matchers::Contains;
using celltrace::InputError;
using celltrace::cli::translate_pov_switches;
using celltrace::test::Arguments;
using celltrace::test::notes;
using celltrace::test::translated;

TEST_CASE("numbers are read as POV-Ray reads them") {
  const std::pair<const char*, const char*> sizes[] = {{"+W385.97", "385"}, {"+W0100", "100"}, {"+W08", "8"},
                                                       {"+W+12", "12"},     {"+W12x", "12"},   {"+W1e1", "1"},
                                                       {"Width=12,5", "12"}};
  for (const auto& [text, size] : sizes) {
    CAPTURE(text);
    CHECK(translated({text}) == Arguments{"-W", size});
  }
  const std::pair<const char*, const char*> clocks[] = {
      {"+K1e-05", "1e-05"}, {"+K-0.5", "-0.5"}, {"+K+0.5", "0.5"}, {"Clock=+1", "1"},
      {"+K.5", "0.5"},      {"+K5.", "5"},      {"+K1E2", "100"},  {"+K1x", "1"},
      {"+K1e", "1"},        {"+K1.2.3", "1.2"}, {"+K00.5", "0.5"}};
  for (const auto& [text, clock] : clocks) {
    CAPTURE(text);
    CHECK(translated({text}) == Arguments{"--clock", clock});
  }
  CHECK(translated({"+KFF010", "+SF0.5", "+STP0"}) ==
        Arguments{"--final-frame", "10", "--start-frame", "0.5", "--frame-step", "1"});
  CHECK_THAT(translate_pov_switches({"+W385.97"}).notes.at(0), Contains("'+W385.97' counts as 385"));
  CHECK(notes({"+W0100", "+K1e-05"}) == 0);
  CHECK_THROWS_WITH(translate_pov_switches({"+K1e400"}),
                    Contains("'+K1e400' needs a number that is not as large"));
  const std::string digits(400, '9');
  try {
    translate_pov_switches({"+W" + digits});
    FAIL("accepted");
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).size() < 200);
  }
}

TEST_CASE("on and off as POV-Ray reads them") {
  for (const char* on : {"on", "On", "ON", "yes", "y", "true", "t", "1", "1.0", "\"on\""}) {
    CAPTURE(on);
    CHECK(translated({std::string("Cyclic_Animation=") + on}) == Arguments{"--cyclic", "on"});
  }
  for (const char* off : {"off", "no", "false", "0", "2", "01", "foo"}) {
    CAPTURE(off);
    CHECK(translated({std::string("Cyclic_Animation=") + off}) == Arguments{"--cyclic", "off"});
  }
  CHECK(notes({"Cyclic_Animation=off"}) == 0);
  CHECK_THAT(translate_pov_switches({"Cyclic_Animation=foo"}).notes.at(0), Contains("counts as off"));
}

TEST_CASE("quotes and blanks in arguments") {
  CHECK(translated({"Input_File_Name=\"my scene.pov\""}) == Arguments{"my scene.pov"});
  CHECK(translated({"Input_File_Name='my scene.pov'"}) == Arguments{"my scene.pov"});
  CHECK(translated({"+I\"my scene.pov\""}) == Arguments{"my scene.pov"});
  CHECK(translated({"+Imy scene.pov"}) == Arguments{"my scene.pov"});
  CHECK(translated({"my scene.pov"}) == Arguments{"my scene.pov"});
  CHECK(translated({"\"my scene.pov\""}) == Arguments{"my scene.pov"});
  CHECK(translated({"+I\"s\" +O\"foo bar.png\" +W20"}) ==
        Arguments{"s.pov", "--pov-output", "foo bar.png", "-W", "20"});
  CHECK(translated({"+Ofoo bar.png +W20"}) == Arguments{"--pov-output", "foo bar.png", "-W", "20"});
  CHECK(translated({"+Ofoo s.pov"}) == Arguments{"--pov-output", "foo", "s.pov"});
  CHECK(translated({"+W20 s.pov +H10"}) == Arguments{"-W", "20", "s.pov", "-H", "10"});
  CHECK(translated({"s.pov t.pov"}) == Arguments{"t.pov"});
  CHECK(translated({"Width=20 Height=10 -A"}) == Arguments{"-W", "20", "-H", "10"});
  CHECK(translated({"Width=\"20\"Height='10'"}) == Arguments{"-W", "20", "-H", "10"});
  CHECK(translated({"Library_Path=\"my inc\"", "+L\"b\"", "+Lc d"}) ==
        Arguments{"-L", "my inc", "-L", "b", "-L", "c d"});
  CHECK(translated({"+O\"foo"}) == Arguments{"--pov-output", "foo"});
  CHECK(translated({"+O\"fo'o\""}) == Arguments{"--pov-output", "fo'o"});
  CHECK(translated({"+O\"foo\\bar\""}) == Arguments{"--pov-output", "foo\\bar"}); // no escapes
  CHECK(translated({"+Oit's.png"}) == Arguments{"--pov-output", "it's.png"});
  CHECK(translated({" +W20 "}) == Arguments{"-W", "20"});
  CHECK(translated({"+Ostdout"}) == Arguments{"--pov-output", "-"});
  CHECK(translated({"Output_File_Name=\"\"", "Pre_Scene_Command=", "Input_File_Name="}).empty());
  CHECK(notes({"Output_File_Name=", "Library_Path="}) == 2);
  CHECK_THROWS_WITH(translate_pov_switches({"+O\"foo\"bar"}), Contains("'bar' stands right behind a quote"));
}
