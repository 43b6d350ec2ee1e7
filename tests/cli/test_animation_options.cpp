#include "cli/command_line.hpp"
#include "cli/pov_switches.hpp"

#include "celltrace/error.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::cli;
using Catch::Matchers::Contains;
using Arguments = std::vector<std::string>;

namespace {

/// As the program does.
RenderRequest request(Arguments arguments) {
  arguments.insert(arguments.begin(), "scenes/a.pov");
  return std::get<RenderRequest>(parse_command_line(translate_pov_switches(arguments).arguments));
}

std::string error_of(const Arguments& arguments) {
  try {
    request(arguments);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("by default a scene is a still picture") {
  const RenderRequest r = request({});
  CHECK_FALSE(r.animation.is_on());
  CHECK_FALSE(r.clock);
  CHECK_FALSE(r.resume);
  CHECK(r.film == FilmFormat::none);
  CHECK(request({"+K0.25"}).clock == 0.25);
  CHECK(request({"Declare=clock=0.25"}).clock == 0.25);
  CHECK(request({"Declare=clock=0.25"}).declares.empty());
}

TEST_CASE("an animation as POV-Ray's switches and settings say it") {
  const Arguments commands[] = {
      {"+KFI2", "+KFF20", "+KI-1", "+KF3.5", "+KC", "+SF0.5", "+EF15", "+C", "Frame_Step=3"},
      {"Initial_Frame=2", "Final_Frame=20", "Initial_Clock=-1", "Final_Clock=3.5", "Cyclic_Animation=on",
       "Subset_Start_Frame=0.5", "Subset_End_Frame=15", "Continue_Trace=on", "+STP3"},
      {"--initial-frame", "2", "--final-frame", "20", "--initial-clock", "-1", "--final-clock", "3.5",
       "--cyclic", "on", "--start-frame", "0.5", "--end-frame", "15", "--resume", "--frame-step", "3"}};
  for (const Arguments& arguments : commands) {
    CAPTURE(arguments);
    const RenderRequest r = request(arguments);
    CHECK(r.animation.is_on());
    CHECK(r.animation.initial_frame == 2);
    CHECK(r.animation.final_frame == 20);
    CHECK(r.animation.initial_clock == -1);
    CHECK(r.animation.final_clock == 3.5);
    CHECK(r.animation.cyclic);
    CHECK(r.animation.start_frame == 0.5);
    CHECK(r.animation.end_frame == 15.0);
    CHECK(r.animation.step == 3);
    CHECK(r.resume);
  }
  CHECK_FALSE(request({"+KC", "-KC", "+C", "-C"}).animation.cyclic);
  CHECK_FALSE(request({"+C", "-C"}).resume);
  CHECK_FALSE(request({"+C", "Continue_Trace=off"}).resume);
}

TEST_CASE("animations of one frame and still pictures") {
  // Checked with POV-Ray 3.7: arguments, first and last frame, both 0 for a still picture.
  const struct {
    Arguments arguments;
    int initial, final;
  } cases[] = {{{"+KFI1", "+KFF1"}, 0, 0},  {{"+KFI0", "+KFF0"}, 0, 0}, {{"+KFI0"}, 0, 0},
               {{"+KFF0"}, 0, 0},           {{"+KFI5"}, 5, 5},          {{"+KFF1"}, 1, 1},
               {{"+KFI1"}, 1, 1},           {{"+KFI3", "+KFF3"}, 3, 3}, {{"+KFI5", "+KFF3"}, 5, 5},
               {{"+KFI1", "+KFF0"}, 1, 1},  {{"+KFI2", "+KFF0"}, 2, 2}, {{"+KFF4.7"}, 1, 4},
               {{"+KFI-1", "+KFF1"}, 0, 1}, {{"+KFF1e1"}, 1, 1},        {{"--final-frame", "010"}, 1, 10}};
  for (const auto& [arguments, initial, final] : cases) {
    CAPTURE(arguments);
    const Animation animation = request(arguments).animation;
    CHECK(animation.is_on() == (final != 0));
    if (final == 0) continue;
    CHECK(animation.initial_frame == initial);
    CHECK(animation.final_frame == final);
  }
}

TEST_CASE("where pictures and films go") {
  CHECK(request({}).output == "a.png");
  CHECK(request({"+Oout/"}).output == "out/a.png");
  CHECK(request({"+Oout/", "+FP"}).output == "out/a.ppm");
  CHECK(request({"-o", "x.Y4M"}).film == FilmFormat::y4m);
  CHECK(request({"-o", "x", "--file-type", "y4m"}).output == "x.y4m");
  CHECK(request({"--file-type", "y4m"}).film == FilmFormat::y4m);
  for (const char* name : {"x.mp4", "x.mkv", "x.mov", "x.WEBM"})
    CHECK(request({"-o", name}).film == FilmFormat::ffmpeg);
  const RenderRequest piped = request({"-o", "-", "--file-type", "y4m", "--frame-rate", "30000/1001"});
  CHECK(piped.output == "-");
  CHECK(piped.film == FilmFormat::y4m);
  CHECK(piped.frame_rate.frames == 30000);
  CHECK(piped.frame_rate.seconds == 1001);
  CHECK(request({}).frame_rate.frames == 25);
}

TEST_CASE("animations that make no sense are refused") {
  CHECK_THAT(error_of({"--initial-frame", "-3"}), Contains("--initial-frame"));
  CHECK_THAT(error_of({"--final-frame", "2.5"}), Contains("--final-frame"));
  CHECK_THAT(error_of({"+KFF99999999999"}), Contains("'+KFF99999999999' needs a number from 0 to"));
  CHECK_THAT(error_of({"+KFFx"}), Contains("'+KFFx' must be followed, without a space, by a number"));
  CHECK_THAT(error_of({"+KFF5", "+KC7"}), Contains("'+KC7' is no switch"));
  CHECK_THAT(error_of({"--frame-step", "0"}), Contains("--frame-step"));
  CHECK_THAT(error_of({"--start-frame", "-1"}), Contains("'-1' is not a number from 0 on"));
  CHECK(error_of({"--clock", "nan"}) == "--clock has to be a number");
  CHECK_THAT(error_of({"--clock", "noon"}), Contains("--clock"));
  CHECK(error_of({"+KFF5", "--final-clock", "inf"}) == "--final-clock has to be a number");
  CHECK(error_of({"Declare=clock=noon"}) == "--declare: the clock has to be a number, not 'noon'");
  for (const char* rate : {"0", "25.5", "1/0", "/2", "3/", "x", "-1", "9999999"})
    CHECK_THAT(error_of({"--frame-rate", rate}), Contains("--frame-rate"));
  CHECK_THAT(error_of({"-o", "-", "+KFF5"}), Contains("as a film"));
  CHECK(error_of({"-o", "a.y4m", "--bits", "16"}) == "a film has 8 bits a channel");
  CHECK_THAT(error_of({"-o", "a.mp4", "+C"}), Contains("a film cannot be resumed"));
}
