// Files that command lines name: scenes and INI files.
#include "translated.hpp"

#include "celltrace/error.hpp"

#include <map>

using Catch::Matchers::Contains;
using celltrace::InputError;
using celltrace::cli::translate_pov_switches;
using celltrace::cli::Translation;
using celltrace::test::Arguments;
using celltrace::test::translated;

namespace {

using Files = std::map<std::string, std::string>;

Translation translation_with(const Arguments& arguments, const Files& files) {
  return translate_pov_switches(arguments, {[&](const std::string& name) { return files.count(name) != 0; },
                                            [&](const std::string& name) {
                                              const auto found = files.find(name);
                                              if (found == files.end())
                                                throw InputError(name + ": cannot be read");
                                              return found->second;
                                            }});
}

Arguments with_files(const Arguments& arguments, const Files& files) {
  Arguments result = translation_with(arguments, files).arguments;
  result.erase(result.begin());
  return result;
}

} // namespace

TEST_CASE("INI files") {
  const Files files = {{"a.ini", "; a comment\n"
                                 "Input_File_Name = a.pov ; another\r\n"
                                 "  Width=40\n# and this\n"
                                 "+H20 -J Declare=A=2\n"
                                 "Library_Path=my files\n"
                                 "[Large]\nWidth=400\n[Small]\nWidth=4 ; tiny\nAntialias=on\n"},
                       {"b.INI", "a.ini[large]\nInclude_INI=c.ini\n"},
                       {"c.ini", "Output_File_Name='b.png'"},
                       {"empty.ini", ""},
                       {"itself.ini", "+W4\nitself.ini\n"}};
  const Arguments a = {"a.pov", "-W", "40", "-H", "20", "--declare", "A=2", "-L", "my files"};
  CHECK(with_files({"a.ini"}, files) == a);
  CHECK(with_files({"a"}, files) == a);
  CHECK(with_files({"Include_INI=a"}, files) == a);
  CHECK(with_files({"a.ini", "+W7"}, files) ==
        Arguments{"a.pov", "-W", "7", "-H", "20", "--declare", "A=2", "-L", "my files"});
  for (const char* small : {"a.ini[small]", "a[Small]", "\"a.ini[small]\"", "Include_INI=\"a.ini[SMALL]\""})
    CHECK(with_files({small}, files) == Arguments{"a.pov", "-W", "4", "-H", "20", "--declare", "A=2", "-L",
                                                  "my files", "--antialias", "0.3"});
  CHECK(with_files({"b.INI"}, files) == Arguments{"a.pov", "-W", "400", "-H", "20", "--declare", "A=2", "-L",
                                                  "my files", "--pov-output", "b.png"});
  CHECK(with_files({"empty.ini", "x.pov"}, files) == Arguments{"x.pov"});
  CHECK(with_files({"-o", "x.ini"}, files) == Arguments{"-o", "x.ini"});
  CHECK(with_files({"a.ini[medium]"}, files) == a);
  CHECK_THAT(translation_with({"a.ini[medium]"}, files).notes.at(0),
             Contains("a.ini has no section [medium]"));

  CHECK_THROWS_WITH(with_files({"none.ini"}, files), "none.ini: cannot be read");
  CHECK_THROWS_WITH(with_files({"a.ini[small"}, files), "'a.ini[small': a section's name has to end with ]");
  CHECK_THROWS_WITH(with_files({"itself.ini"}, files), Contains("include each other"));
}

namespace {

Arguments of_ini(const std::string& text) {
  return with_files({"a.ini"}, {{"a.ini", text}});
}

} // namespace

TEST_CASE("values reach to the end of a line of an INI file") {
  CHECK(of_ini("Input_File_Name=my scene.pov\nOutput_File_Name=my picture.png  \n") ==
        Arguments{"my scene.pov", "--pov-output", "my picture.png"});
  CHECK(of_ini("Output_File_Name=foo;bar.png\n") == Arguments{"--pov-output", "foo"});
  CHECK(of_ini("Output_File_Name=\"a;b#c.png\" ; comment\n") == Arguments{"--pov-output", "a;b#c.png"});
  CHECK(of_ini("Output_File_Name=a.png Width=30\n") == Arguments{"--pov-output", "a.png Width=30"});
  CHECK(of_ini("Output_File_Name=\"a.png\" Width=30\n") == Arguments{"--pov-output", "a.png"});
  CHECK(of_ini("Quality=9 // comment\nWidth=8 foo\n") == Arguments{"--quality", "9", "-W", "8"});
  CHECK(of_ini("+Imy scene.pov +W30 ; comment\n+I\"a b\"\n") == Arguments{"a b.pov", "-W", "30"});
  CHECK(of_ini("my scene.pov\n") == Arguments{"my scene.pov"});
  CHECK(of_ini("Width = 30 Height=20\n") == Arguments{"-W", "30"});
  CHECK(of_ini("+Is.pov +W20 Height=30 +W50\n+K1") ==
        Arguments{"s.pov", "-W", "20", "-H", "30", "--clock", "1"});
  CHECK(of_ini("\xEF\xBB\xBFWidth=8\r\nHeight=9\r+K1") == Arguments{"-W", "8", "-H", "9", "--clock", "1"});
  CHECK(of_ini("Declare=X=\"te # xt\" ; c\nDeclare=Y=5 # c\n") ==
        Arguments{"--declare", "X=\"te # xt\"", "--declare", "Y=5"});
  CHECK(translation_with({"a.ini"}, {{"a.ini", "Output_File_Name=\"a.png\" Width=30\nWidth=30 Height=20"}})
            .notes.size() == 2);
  CHECK(translation_with({"a.ini"}, {{"a.ini", "Quality=9 // comment\n"}}).notes.empty());
}

TEST_CASE("errors in INI files have their place") {
  const std::pair<const char*, const char*> faults[] = {
      {"\nWidth=40\nWidth=x\n", "a.ini:3: 'Width=x' needs a number"},
      {"Foo=1\n", "a.ini:1: 'Foo=1' is no setting of POV-Ray that is known here"},
      {"+W4\r\n\r\n+Zfoo", "a.ini:3: '+Zfoo' is no switch of POV-Ray that is known here"},
      {"Output_File_Name=\"x\n", "a.ini:1: a quote is not closed"},
      {"\nInclude_INI=none.ini\n", "a.ini:2: none.ini: cannot be read"},
      {"\nb.ini\n", "b.ini:2: 'Width=0' needs a number from 1 to"},
      {"Declare=X\n", "a.ini:1: 'Declare=X' declares no value"},
      {"Declare=1X=2\n", "a.ini:1: 'Declare=1X=2' does not declare anything"},
      {"+FS", "a.ini:1: '+FS' is no file type"}};
  for (const auto& [text, message] : faults) {
    CAPTURE(text);
    CHECK_THROWS_WITH(with_files({"a.ini"}, {{"a.ini", text}, {"b.ini", "\nWidth=0"}}),
                      Catch::StartsWith(message));
  }
}

TEST_CASE("a name alone is an INI file or a scene, whatever is there") {
  const Files files = {{"s.pov", "sphere {}"},
                       {"t.ini", "Width=8"},
                       {"t.pov", ""},
                       {"u", "camera {}"},
                       {"v.txt", "; x\n\nWidth=9"},
                       {"w.txt", "#declare A = 1;"},
                       {"inc/q.pov", "sphere {}"},
                       {"inc/r.ini", "+W5"},
                       {"x.y.pov", ""},
                       {"a b.pov", ""},
                       {"a +W7.pov", ""}};
  CHECK(with_files({"s"}, files) == Arguments{"s.pov"});
  CHECK(with_files({"t"}, files) == Arguments{"-W", "8"});
  CHECK(with_files({"+It"}, files) == Arguments{"t.pov"});
  CHECK(with_files({"u"}, files) == Arguments{"u"});
  CHECK(with_files({"v.txt"}, files) == Arguments{"-W", "9"});
  CHECK(with_files({"w.txt"}, files) == Arguments{"w.txt"});
  CHECK(with_files({"+Ix.y"}, files) == Arguments{"x.y.pov"});
  CHECK(with_files({"a +W7.pov"}, files) == Arguments{"a +W7.pov"});
  CHECK(with_files({"none"}, files) == Arguments{"none.pov"});
  // Library folders are searched, too; the picture does not go there.
  CHECK(with_files({"+Linc", "q"}, files) == Arguments{"-L", "inc", "inc/q.pov", "--pov-output", "./"});
  CHECK(with_files({"+Iq.pov", "-L", "inc", "-o", "x"}, files) ==
        Arguments{"inc/q.pov", "-L", "inc", "-o", "x"});
  CHECK(with_files({"+Linc", "r.ini"}, files) == Arguments{"-L", "inc", "-W", "5"});
  CHECK(with_files({"+HIh", "s.pov"}, {{"h.inc", ""}}) == Arguments{"--header", "h.inc", "s.pov"});
}

TEST_CASE("command lines of programs that start povray") {
  CHECK(translated({"+W240", "+H180", "-Iin.pov", "-Oout.tga", "+D", "+X", "+A", "+FT"}) == // VMD
        Arguments{"-W", "240", "-H", "180", "in.pov", "--pov-output", "out.tga", "--antialias", "0.3",
                  "--antialias-jitter", "1", "--picture", "on", "--file-type", "tga"});
  CHECK(translated({"+I\"/tmp/a b.pov\"", "+O\"/tmp/a b.png\"", "+W640", "+H480", "+A"}) == // LeoCAD
        Arguments{"/tmp/a b.pov", "--pov-output", "/tmp/a b.png", "-W", "640", "-H", "480", "--antialias",
                  "0.3", "--antialias-jitter", "1"});
  CHECK(translated({"in.pov", "+O-", "+W16", "+H12", "+FP", "-D"}) == // Vapory
        Arguments{"in.pov", "--pov-output", "-", "-W", "16", "-H", "12", "--picture", "on", "--file-type",
                  "ppm"});
  CHECK(
      of_ini("Input_File_Name=a.pov\nOutput_to_File=True\nOutput_File_Type=N\nOutput_Alpha=off\n; a\n" // ASE
             "Height=385.97\nWidth=500\nAntialias=True\nAntialias_Threshold=0.1\nDisplay=False\n"
             "Pause_When_Done=True\nVerbose=False\n") ==
      Arguments{"a.pov", "--picture", "on", "--file-type", "png", "--alpha", "off", "-H", "385", "-W", "500",
                "--antialias", "0.1", "--antialias-jitter", "1", "--verbose", "off"});
}
