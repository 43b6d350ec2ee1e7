// The program with POV-Ray's switches, settings and INI files, as other programs start it.
#include "program_run.hpp"

#include <fstream>

using namespace celltrace::test;
using Catch::Matchers::Contains;

namespace {

const char kScene[] =
    "#debug concat(\"clock \", str(clock, 0, 2), \" frame \", str(frame_number, 0, 0), \"\\n\")\n"
    "camera { location -5*z look_at 0 } sphere { 0, 1 pigment { rgb 1 } }\n";

void write(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder / name) << text;
}

Outcome rendered(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"+W8", "+H6"});
  const Outcome outcome = celltrace_run(folder, arguments);
  CAPTURE(arguments, outcome.err);
  CHECK(outcome.exit_code == 0);
  return outcome;
}

} // namespace

TEST_CASE("names with blanks reach the program in quotes or in INI files") {
  const TemporaryFolder folder;
  write(folder, "my scene.pov", kScene);
  write(folder, "a.ini", "Input_File_Name=my scene.pov\nOutput_File_Name=my picture.png\nHeight=5.97\n");
  rendered(folder, {"Input_File_Name=\"my scene.pov\""});
  CHECK(std::filesystem::exists(folder / "my scene.png"));
  rendered(folder, {"+I\"my scene.pov\" +O\"one more.png\""});
  CHECK(std::filesystem::exists(folder / "one more.png"));
  CHECK_THAT(rendered(folder, {"a.ini"}).err, Contains("my picture.png: 8x5") && Contains("counts as 5"));
  write(folder, "b.ini", "Width=8\nDeclare=sphere=2\n");
  const Outcome wrong = celltrace_run(folder, {"my scene.pov", "b.ini"});
  CHECK(wrong.exit_code == 1);
  CHECK_THAT(wrong.err, Contains("celltrace: error: b.ini:2: 'Declare=sphere=2'"));
}

TEST_CASE("an animation of one frame has its number in the picture's name") {
  const TemporaryFolder folder;
  write(folder, "s.pov", kScene);
  CHECK_THAT(rendered(folder, {"s", "+KFI3", "+KFF3"}).err, Contains("clock 0.00 frame 3"));
  CHECK(std::filesystem::exists(folder / "s3.png"));
  rendered(folder, {"s", "+KFF1"});
  CHECK(std::filesystem::exists(folder / "s1.png"));
  rendered(folder, {"s", "+KFI1", "+KFF1"});
  CHECK(std::filesystem::exists(folder / "s.png"));
}

TEST_CASE("messages go into files beside the picture, and the scene has a header") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "out");
  write(folder, "h.inc", "#declare H = 3;");
  write(folder, "s.pov", std::string(kScene) + "#warning concat(\"H is \", str(H, 0, 0))\n");
  const Outcome outcome =
      rendered(folder, {"s.pov", "+HIh", "+Oout/", "All_File=on", "Warning_File=\"w w.txt\"", "-GD", "+D"});
  CHECK_THAT(outcome.err, Contains("H is 3") && !Contains("clock 0.00"));
  const std::string all = read_bytes(folder / "out" / "alltext.out");
  CHECK_THAT(all,
             Contains("clock 0.00") && Contains("H is 3") && Contains("rays/s") && Contains("note: '+D'"));
  const std::string warnings = read_bytes(folder / "out" / "w w.txt");
  CHECK_THAT(warnings, Contains("H is 3") && !Contains("clock 0.00"));
  write(folder, "wrong.pov", "oops");
  CHECK(celltrace_run(folder, {"wrong.pov", "+GFerrors.txt"}).exit_code == 1);
  CHECK_THAT(read_bytes(folder / "errors.txt"), Contains("wrong.pov:1:1: error:"));
  CHECK_THAT(celltrace_run(folder, {"s.pov", "+GAs.png"}).err,
             Contains("s.png: this file would be written twice"));
}

TEST_CASE("files that are not there are told of in one way") {
  const TemporaryFolder folder;
  write(folder, "s.pov", kScene);
  const std::string all = "celltrace: error: none.pov: there is no such file\n";
  std::filesystem::create_directory(folder / "d.pov");
  const std::vector<std::vector<std::string>> missing = {{"none.pov"},
                                                         {"render", "none.pov"},
                                                         {"+Inone"},
                                                         {"compare", "none.pov", "none.pov"},
                                                         {"replay", "none.pov"},
                                                         {"spu", "none.pov"},
                                                         {"s.pov", "none.ini"}};
  for (const auto& arguments : missing) {
    INFO(arguments.front() << ' ' << arguments.back());
    const Outcome outcome = celltrace_run(folder, arguments);
    CHECK(outcome.exit_code != 0);
    const bool is_ini = arguments.back() == "none.ini";
    CHECK_THAT(outcome.err, Contains(is_ini ? "celltrace: error: none.ini: there is no such file\n" : all));
    CHECK(outcome.err.find(":1:1:") == std::string::npos);
  }
  CHECK_THAT(celltrace_run(folder, {"s.pov", "--header", "none"}).err,
             Contains("header none: there is no such file"));
  CHECK_THAT(celltrace_run(folder, {"d.pov"}).err,
             Contains("celltrace: error: d.pov: this is a directory, not a file"));
}

TEST_CASE("numbers out of range are not printed in full") {
  const TemporaryFolder folder;
  write(folder, "s.pov", kScene);
  const std::vector<std::vector<std::string>> faults = {{"--start-frame", "-1"},
                                                        {"--start-column", "-3"},
                                                        {"--end-row", "1e400"},
                                                        {"+K1e400"},
                                                        {"--adc", "1e300"},
                                                        {"+W1e400x", "+W0"},
                                                        {"--clock", "1e400"},
                                                        {"--antialias", "-1e308"},
                                                        {"+EC1e300"},
                                                        {"Declare=X=1e400"},
                                                        {"--language-version", "1e308"}};
  for (std::vector<std::string> arguments : faults) {
    arguments.insert(arguments.begin(), "s.pov");
    const Outcome outcome = celltrace_run(folder, arguments);
    CAPTURE(arguments, outcome.err);
    CHECK(outcome.exit_code == 1);
    CHECK(outcome.err.size() < 200);
  }
  CHECK(celltrace_run(folder, {"s.pov", "--max", "memory=0"}).exit_code == 1);
}
