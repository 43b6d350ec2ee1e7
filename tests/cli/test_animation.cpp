// Animations, rendered as users render them.
#include "celltrace/image.hpp"
#include "cli/program_run.hpp"

#include <nlohmann/json.hpp>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

namespace {

const std::string kScene =
    "camera { location -4*z look_at 0 } light_source { <3, 4, -5>, 1 }\n"
    "sphere { <clock, 0, 0>, 1 pigment { rgb <1, frame_number / final_frame, 0.2> } }\n";

/// Names of files, in order.
std::vector<std::string> files(const TemporaryFolder& folder, const std::string& extension) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    if (entry.path().extension() == extension) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

} // namespace

TEST_CASE("an animation's frames are pictures by number") {
  const TemporaryFolder folder;
  write_bytes(folder / "s.pov", kScene);
  const Outcome outcome = celltrace_run(folder, {"s.pov", "+W24", "+H18", "+KFF10", "+KI-1", "+SF8"});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.empty());
  CHECK(lines(outcome.err) == 1);
  CHECK_THAT(outcome.err, StartsWith("s01.png...: 3 frames, 24x18, native"));
  CHECK(files(folder, ".png") == std::vector<std::string>{"s08.png", "s09.png", "s10.png"});
  CHECK(files(folder, ".resume").empty());

  // A frame is the picture that its clock gives.
  write_bytes(folder / "t.pov", "#declare frame_number = 10; #declare final_frame = 10;\n" + kScene);
  REQUIRE(celltrace_run(folder, {"t.pov", "+W24", "+H18", "+K1", "-o", "t.png"}).exit_code == 0);
  CHECK(load_image(folder / "s10.png") == load_image(folder / "t.png"));
  CHECK_FALSE(load_image(folder / "s09.png") == load_image(folder / "t.png"));
}

TEST_CASE("an animation goes where it is told, on every machine") {
  const TemporaryFolder folder;
  write_bytes(folder / "s.pov", kScene);
  write_bytes(folder / "s.ini", "Input_File_Name=s.pov\n+W16 +H12\nFinal_Frame=3\nCyclic_Animation=on\n");
  std::filesystem::create_directory(folder / "out");
  REQUIRE(celltrace_run(folder, {"s.ini", "+Oout/"}).exit_code == 0);
  REQUIRE(celltrace_run(folder,
                        {"s.ini", "-o", "e.ppm", "--backend", "cell_emu", "--spes", "2", "--stats", "e.json"})
              .exit_code == 0);
  for (const char number : {'1', '2', '3'}) {
    const auto picture = [&](const std::string& name, const char* extension) {
      return load_image(folder / (name + number + extension));
    };
    CHECK(picture("out/s", ".png") == picture("e", ".ppm"));
  }
  const auto statistics = nlohmann::json::parse(read_bytes(folder / "e.json"));
  REQUIRE(statistics.size() == 3);
  CHECK(statistics[1]["frame"] == 2);
  CHECK(statistics[1]["clock"].get<double>() == Approx(1.0 / 3));
  CHECK(statistics[1]["backend"] == "cell_emu");
  CHECK(statistics[1]["cycles"]["render"] > 0);
}

TEST_CASE("an error says in which frame") {
  const TemporaryFolder folder;
  write_bytes(folder / "s.pov", kScene + "#if (frame_number > 2) nonsense #end\n");
  const Outcome outcome = celltrace_run(folder, {"s.pov", "+W8", "+H8", "+KFF5"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, StartsWith("s.pov:3:24: error: ") && EndsWith("\n  in frame 3\n"));
  CHECK(files(folder, ".png") == std::vector<std::string>{"s1.png", "s2.png"});
  // What is finished stays finished.
  write_bytes(folder / "a.pov", kScene + "#warning \"careful\"\n");
  const Outcome warned = celltrace_run(folder, {"a.pov", "+W8", "+H8", "+KFF4"});
  CHECK(warned.exit_code == 0);
  CHECK(lines(warned.err) == 2); // not for each frame
  CHECK(celltrace_run(folder, {"a.pov", "+W8", "+H8", "+KFF4", "-o", "no/a.png"}).exit_code == 1);
}
