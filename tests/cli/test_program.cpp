// The program itself, run as its users run it.
#include "cli/program_run.hpp"
#include "image/picture_files.hpp"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::string kScene = CELLTRACE_SOURCE_DIR "/examples/scenes/first.pov";

} // namespace

TEST_CASE("the program explains itself") {
  const TemporaryFolder folder;
  const Outcome version = celltrace_run(folder, {"--version"});
  CHECK(version.exit_code == 0);
  CHECK_THAT(version.out, StartsWith("celltrace 0."));
  CHECK(celltrace_run(folder, {"--help"}).exit_code == 0);
  const Outcome nothing = celltrace_run(folder, {});
  CHECK(nothing.exit_code == 1);
  CHECK(lines(nothing.err) == 1);
}

TEST_CASE("what is no scene is said to be none") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "scenes");
  for (const char* name : {"scenes", "scenes/"})
    CHECK(celltrace_run(folder, {name}).err == "celltrace: error: scenes: this is a directory, not a file\n");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{}, {"render"}, {"+W320"}, {"view"}})
    CHECK_THAT(celltrace_run(folder, arguments).err, StartsWith("celltrace: error: no scene is named"));
  CHECK_THAT(celltrace_run(folder, {kScene, "--max", "seconds"}).err,
             Contains("'seconds' is not NAME=VALUE"));
}

TEST_CASE("a scene alone is rendered beside the caller") {
  const TemporaryFolder folder;
  const Outcome outcome = celltrace_run(folder, {kScene, "-W", "32", "-H", "18"});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.empty());
  CHECK_THAT(outcome.err, StartsWith("first.png: 32x18, native."));
  CHECK(lines(outcome.err) == 1);
  const Image picture = load_image(folder / "first.png");
  CHECK(picture.width == 32);
  CHECK(picture.height == 18);
}

TEST_CASE("POV-Ray's switches render the same picture, and every backend does") {
  const TemporaryFolder folder;
  REQUIRE(celltrace_run(folder, {kScene, "-W", "32", "-H", "18", "-o", "a.png"}).exit_code == 0);
  const Outcome pov = celltrace_run(folder, {"+I" + kScene, "+W32", "+H18", "+Ob", "-D", "-A", "+WT3"});
  CAPTURE(pov.err);
  CHECK(pov.exit_code == 0);
  CHECK_THAT(pov.err, StartsWith("note: '-D'") && Contains("3 SPEs"));
  CHECK(load_image(folder / "a.png") == load_image(folder / "b.png"));

  const Outcome emulated = celltrace_run(folder, {"render", kScene, "-W", "32", "-H", "18", "-o", "c.ppm",
                                                  "--backend", "cell_emu", "--spes", "2"});
  CAPTURE(emulated.err);
  CHECK(emulated.exit_code == 0);
  CHECK_THAT(emulated.err, Contains("cell_emu, 2 SPEs"));
  CHECK(load_image(folder / "a.png") == load_image(folder / "c.ppm"));
}

TEST_CASE("cell_sim renders what the others render, or says what the build lacks") {
  const TemporaryFolder folder;
  const Outcome simulated = celltrace_run(folder, {kScene, "-W", "32", "-H", "18", "-o", "s.png", "--backend",
                                                   "cell_sim", "--spes", "2", "--stats", "s.json"});
  CAPTURE(simulated.err);
#ifdef CELLTRACE_SIMULATOR_PROGRAMS
  CHECK(simulated.exit_code == 0);
  CHECK_THAT(simulated.err, Contains("cell_sim, 2 SPEs") && Contains("million virtual cycles"));
  const auto statistics = nlohmann::json::parse(read_bytes(folder / "s.json"));
  CHECK(statistics["backend"] == "cell_sim");
  CHECK(statistics["spes"][0]["cycles"]["hbr"] > 0);
  CHECK(statistics["diagnostics"].empty());
  REQUIRE(celltrace_run(folder, {kScene, "-W", "32", "-H", "18", "-o", "n.png"}).exit_code == 0);
  CHECK(celltrace_run(folder, {"compare", "n.png", "s.png", "--min-psnr", "45"}).exit_code == 0);
#else
  CHECK(simulated.exit_code == 1);
  CHECK(lines(simulated.err) == 1);
  CHECK_THAT(simulated.err, Contains("no machine code for cell_sim"));
#endif
}

TEST_CASE("statistics go where they are asked for, and quiet is quiet") {
  const TemporaryFolder folder;
  const Outcome to_stdout = celltrace_run(folder, {kScene, "-W", "8", "-H", "8", "--stats", "-", "--quiet"});
  CHECK(to_stdout.err.empty());
  CHECK(nlohmann::json::parse(to_stdout.out)["backend"] == "native");
  CHECK(celltrace_run(folder, {kScene, "-W", "8", "-H", "8", "--stats", "s.json"}).out.empty());
  CHECK(nlohmann::json::parse(read_bytes(folder / "s.json"))["width"] == 8);
}

TEST_CASE("rays that are dropped are told of, but not if quiet") {
  const TemporaryFolder folder;
  write_bytes(folder / "nested.pov",
              "#version 3.7; global_settings { max_trace_level 40 } camera { location -z*30 }\n"
              "#for (I, 1, 15) sphere { 0, I pigment { rgbt .97 } interior { ior 1.02 } } #end\n");
  const Outcome outcome = celltrace_run(folder, {"nested.pov", "-W", "8", "-H", "8"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("celltrace: warning: ") && Contains(" rays were dropped"));
  CHECK(celltrace_run(folder, {"nested.pov", "-W", "8", "-H", "8", "--quiet"}).err.empty());
  CHECK_THAT(celltrace_run(folder, {kScene, "-W", "8", "-H", "8"}).err, !Contains("dropped"));
}

TEST_CASE("every key of the statistics is documented") {
  const TemporaryFolder folder;
  const std::string document = read_bytes(CELLTRACE_SOURCE_DIR "/docs/statistics.md");
  const Outcome outcome = celltrace_run(folder, {kScene, "-W", "8", "-H", "8", "--stats", "-"});
  const auto statistics = nlohmann::json::parse(outcome.out).flatten();
  for (const auto& [pointer, value] : statistics.items()) {
    const nlohmann::json::json_pointer path(pointer);
    const std::string key = path.back(),
                      group = path.parent_pointer().empty() ? "" : path.parent_pointer().back();
    CAPTURE(pointer);
    if (key.find_first_not_of("0123456789") == std::string::npos) continue; // an element of an array
    const bool documented = document.find("`" + group + "." + key + "`") != std::string::npos ||
                            document.find("`" + key + "`") != std::string::npos;
    CHECK(documented);
  }
}

TEST_CASE("the program warns once of limits that a scene passes") {
  const TemporaryFolder folder;
  write_bytes(folder / "boxes.pov", "camera { location <0, 9, 0.1> look_at 0 }\n"
                                    "#declare I = 0;\n"
                                    "#while (I < 34)\n"
                                    "  box { <-1, -1, -1>, <1, 0, 1> pigment { rgb <1, I / 34, 0> } }\n"
                                    "  #declare I = I + 1;\n"
                                    "#end\n");
  const std::string warning = "celltrace: warning: more than 32 faces in one plane";
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"+KFF3"}}) {
    std::vector<std::string> arguments = {"boxes.pov", "-W", "16", "-H", "12", "--stats", "s.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = celltrace_run(folder, arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 0);
    const std::size_t found = outcome.err.find(warning);
    REQUIRE(found != std::string::npos);
    CHECK(outcome.err.find("warning", found + warning.size()) == std::string::npos);
    nlohmann::json statistics = nlohmann::json::parse(read_bytes(folder / "s.json"));
    if (statistics.is_array()) statistics = statistics[2];
    CHECK(statistics["limits"][0]["limit"] == "coplanar_layers");
  }
}

TEST_CASE("the page about keywords is what the program prints") {
  const TemporaryFolder folder;
  CHECK(celltrace_run(folder, {"--list-keywords"}).out ==
        read_bytes(CELLTRACE_SOURCE_DIR "/docs/keywords.md"));
}

TEST_CASE("two runs in lockstep are the same to the bit") {
  const TemporaryFolder folder;
  struct Products {
    std::string picture, trace;
    nlohmann::json statistics;
  };
  const auto products = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     {kScene, "-W", "32", "-H", "18", "-o", "p.ppm", "--backend", "cell_emu", "--spes", "3",
                      "--stats", "s.json", "--trace", "t.json"});
    const Outcome outcome = celltrace_run(folder, arguments);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK_THAT(outcome.err, Contains("million virtual cycles"));
    Products p{read_bytes(folder / "p.ppm"), read_bytes(folder / "t.json"),
               nlohmann::json::parse(read_bytes(folder / "s.json"))};
    p.statistics.erase("seconds");
    return p;
  };
  REQUIRE(celltrace_run(folder, {kScene, "-W", "32", "-H", "18", "-o", "native.ppm"}).exit_code == 0);
  const std::string expected = read_bytes(folder / "native.ppm");
  std::set<std::string> traces;
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{}, {"--seed", "1"}, {"--seed", "2", "--transfers", "random", "--faults"}}) {
    const Products first = products(arguments);
    const Products second = products(arguments);
    CHECK(first.picture == expected);
    CHECK(second.picture == expected);
    CHECK(first.statistics == second.statistics);
    CHECK(first.trace == second.trace);
    CHECK(first.statistics["schedule"] == "lockstep");
    CHECK(first.statistics["cycles"]["render"] > 0);
    CHECK(first.statistics["diagnostics"].empty());
    traces.insert(first.trace);

    std::map<std::string, int> phases;
    const auto trace = nlohmann::json::parse(first.trace);
    for (const auto& event : trace["traceEvents"])
      ++phases[event["ph"]];
    CHECK(phases["X"] > 0); // computing, waits, messages
    CHECK(phases["b"] > 0); // DMA
    CHECK(phases["b"] == phases["e"]);
    CHECK(phases["f"] > 0); // arrows
    CHECK(phases["f"] <= phases["s"]);
  }
  CHECK(traces.size() == 3);
}

TEST_CASE("replay of a recorded trace counts what the statistics of the run count") {
  const TemporaryFolder folder;
  REQUIRE(celltrace_run(folder, {kScene, "-W", "32", "-H", "18", "--backend", "cell_emu", "--spes", "3",
                                 "--cache", "2x4:lru", "--cache-trace", "caches", "--stats", "s.json"})
              .exit_code == 0);
  const auto stats = nlohmann::json::parse(read_bytes(folder / "s.json"))["cache"];
  const Outcome outcome = celltrace_run(folder, {"replay", "caches", "--json"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const auto replayed = nlohmann::json::parse(outcome.out);
  REQUIRE(replayed.size() == 1);
  CHECK(replayed[0]["cache"] == "2x4:lru");
  const auto& kinds = replayed[0]["replayed"]["kinds"];
  const char* const names[] = {"list", "object", "material", "light"};
  for (std::size_t kind = 0; kind < 4; ++kind)
    for (const char* what : {"hits", "misses"})
      CHECK(kinds[kind][what] == stats[names[kind]][what]);
  const Outcome table =
      celltrace_run(folder, {"replay", "caches", "--cache", "4x128", "--cache", "off", "--no-prefetch"});
  CHECK(table.exit_code == 0);
  CHECK(lines(table.out) == 3);
}

TEST_CASE("an INI file says what to render and how") {
  const TemporaryFolder folder;
  write_bytes(folder / "a.ini", "Input_File_Name=" + kScene +
                                    "\n+W32 +H24 +A0.3 -J ; small\n"
                                    "[Part]\nStart_Row=13\nOutput_File_Name=part\n");
  CHECK(celltrace_run(folder, {"a.ini", "+Owhole", "--quiet"}).exit_code == 0);
  CHECK(celltrace_run(folder, {"a.ini[part]", "--quiet"}).exit_code == 0);
  CHECK(celltrace_run(folder, {"a.ini", "-A", "+Oplain", "--quiet"}).exit_code == 0);
  const Image whole = load_image(folder / "whole.png"), part = load_image(folder / "part.png");
  CHECK(whole.width == 32);
  CHECK(whole.height == 24);
  CHECK(part.height == 24);
  CHECK(std::all_of(part.pixel(0, 0), part.pixel(31, 11), [](int byte) { return byte == 0 || byte == 255; }));
  CHECK_FALSE(load_image(folder / "plain.png") == whole);

  CHECK(celltrace_run(folder, {"a.ini", "-F", "+Onone"}).exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(folder / "none.png"));
}

TEST_CASE("errors are one line and exit code 1") {
  const TemporaryFolder folder;
  write_bytes(folder / "bad.pov", "sphere { <0, 0, 0>, 1 }\ncylinder_ { }\n");
  const std::vector<std::vector<std::string>> wrong = {
      {"missing.pov"},
      {"bad.pov"},
      {kScene, "-o", "a.gif"},
      {kScene, "-o", "no/a.png"},
      {kScene, "+UA", "-o", "a.dds"},
      {kScene, "+A4"},
      {kScene, "+SC641"},
      {"missing.ini"},
      {"+Z", kScene},
      {kScene, "--cache", "3x3"},
      {"compare", "a.png", "b.png"},
      {kScene, "--schedule", "lockstep"},
      {kScene, "--trace", "t.json"},
      {kScene, "--backend", "cell_emu", "--trace", "no/t.json"},
      {kScene, "--backend", "cell_emu", "--cache-trace", "no/t"},
      {"replay", "missing"},
      {"replay", "bad.pov"},
      {kScene, "--balance", "fair"}};
  for (const auto& arguments : wrong) {
    const Outcome outcome = celltrace_run(folder, arguments);
    CAPTURE(arguments, outcome.err);
    CHECK(outcome.exit_code == 1);
    CHECK(outcome.out.empty());
    CHECK(lines(outcome.err) == 1);
    CHECK_THAT(outcome.err, Contains("error: "));
  }
  CHECK_THAT(celltrace_run(folder, {"bad.pov"}).err, StartsWith("bad.pov:2:1: error: "));
}

TEST_CASE("what cannot be written is an error, and what fails leaves nothing empty behind") {
  const TemporaryFolder folder;
  if (!std::filesystem::exists("/dev/full")) {
    WARN("there is no /dev/full: skipped");
    return;
  }
  const std::vector<std::string> small = {kScene, "-W", "8", "-H", "8", "--quiet"};
  const auto fails = [&](std::vector<std::string> more) {
    more.insert(more.begin(), small.begin(), small.end());
    const Outcome outcome = celltrace_run(folder, more);
    CAPTURE(more, outcome.err);
    CHECK(outcome.exit_code == 1);
    CHECK(lines(outcome.err) == 1);
    CHECK_THAT(outcome.err, Contains("error: ") && Contains("full") && Contains("cannot be written"));
  };
  std::filesystem::create_symlink("/dev/full", folder / "full.ppm");
  fails({"-o", "full.ppm"});
  fails({"--stats", "/dev/full"});
  fails({"--backend", "cell_emu", "--trace", "/dev/full"});
  fails({"--backend", "cell_emu", "--cache-trace", "/dev/full"});

  // A render that cannot start has traced nothing.
  write_bytes(folder / "old.json", "old");
  std::vector<std::string> too_small = small;
  too_small.insert(too_small.end(), {"--backend", "cell_emu", "--cache", "64x32", "--trace", "new.json",
                                     "--cache-trace", "old.json"});
  CHECK(celltrace_run(folder, too_small).exit_code == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "new.json"));
  CHECK(read_bytes(folder / "old.json") == "old");
}

TEST_CASE("standard output that is full or closed is an error, and no file takes its place") {
  const TemporaryFolder folder;
  for (const char* where : {">/dev/full", ">&-"})
    for (const char* arguments : {"--help", "--version", "compare a.ppm a.ppm", "SCENE --stats - -o b.ppm"}) {
      REQUIRE(celltrace_run(folder, {kScene, "-W", "8", "-H", "8", "-o", "a.ppm"}).exit_code == 0);
      std::string command = arguments;
      if (const auto at = command.find("SCENE"); at != std::string::npos)
        command.replace(at, 5, "'" + kScene + "' -W 8 -H 8 --quiet");
      command =
          "cd '" + folder.path().string() + "' && '" CELLTRACE_PROGRAM "' " + command + " 2>err.txt " + where;
      CAPTURE(command);
      CHECK(WEXITSTATUS(std::system(command.c_str())) == 1);
      const std::string error = read_bytes(folder / "err.txt");
      CHECK_THAT(error, StartsWith("celltrace: error: standard output cannot be written"));
      CHECK(lines(error) == 1);
    }
  CHECK(read_bytes(folder / "b.ppm") == read_bytes(folder / "a.ppm"));
}

TEST_CASE("links are written through") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "other");
  std::filesystem::create_symlink("other/picture.ppm", folder / "link.ppm");
  std::filesystem::create_symlink("other/s.json", folder / "s.json");
  for (int i = 0; i < 2; ++i) { // what the links lead to is not there at first
    REQUIRE(celltrace_run(folder, {kScene, "-W", "8", "-H", "8", "-o", "link.ppm", "--stats", "s.json"})
                .exit_code == 0);
    CHECK(std::filesystem::is_symlink(folder / "link.ppm"));
    CHECK(std::filesystem::is_symlink(folder / "s.json"));
    CHECK(load_image(folder / "other/picture.ppm").width == 8);
    CHECK(std::filesystem::file_size(folder / "other/s.json") > 100);
  }
}

TEST_CASE("a ray tree that takes minutes is broken off") {
  const TemporaryFolder folder;
  write_bytes(folder / "glass.pov",
              "global_settings { max_trace_level 20 adc_bailout 0 }\n"
              "camera { location -6*z look_at 0 angle 30 }\n"
              "light_source { <5, 5, -9>, 1 }\n"
              "#declare R = seed(3);\n"
              "#for (I, 1, 40)\n"
              "  sphere { (<rand(R), rand(R), rand(R)> - 0.5) * 1.6, 0.5\n"
              "    pigment { rgbt <1, 1, 1, 0.9> } finish { reflection 0.3 } interior { ior 1.3 } }\n"
              "#end\n");
  for (const std::vector<std::string>& machine : {std::vector<std::string>{"--backend", "native"},
                                                  {"--backend", "cell_emu"},
                                                  {"--backend", "cell_emu", "--model", "pipeline"},
                                                  {"--backend", "cell_emu", "--model", "offload"}}) {
    std::vector<std::string> arguments = {"glass.pov", "--quiet", "-W", "160", "-H",
                                          "120",       "--spes",  "4",  "-o",  "glass.ppm"};
    arguments.insert(arguments.end(), machine.begin(), machine.end());
    Run run(folder, arguments);
    std::this_thread::sleep_for(std::chrono::milliseconds(700)); // until it is deep in trees
    const auto start = std::chrono::steady_clock::now();
    run.interrupt();
    const Outcome outcome = run.finish();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    CAPTURE(machine, outcome.err);
    CHECK(outcome.exit_code == 2);
    CHECK(seconds.count() < 5); // a tenth of a second, where nothing else runs
  }
}

TEST_CASE("signals that come together are one") {
  const TemporaryFolder folder;
  Run run(folder, {kScene, "-W", "3000", "-H", "2000", "--spes", "1", "-o", "partial.ppm", "--quiet"});
  run.interrupt(SIGTERM, 2);
  CHECK(run.finish().exit_code == 2);
  CHECK(load_image(folder / "partial.ppm").width == 3000);
}

TEST_CASE("an interrupted render keeps what it has and exits with 2") {
  const TemporaryFolder folder;
  Run run(folder, {kScene, "-W", "3000", "-H", "2000", "--spes", "1", "-o", "partial.png"});
  run.interrupt();
  const Outcome outcome = run.finish();
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, StartsWith("partial.png: interrupted, partial, 3000x2000"));
  const Image picture = load_image(folder / "partial.png");
  CHECK(picture.width == 3000);
  CHECK(picture.pixel(2999, 1999)[3] == 0); // not reached
}
