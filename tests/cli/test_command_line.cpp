#include "cli/command_line.hpp"
#include "cli/machine_options.hpp"
#include "cli/output_options.hpp"

#include "celltrace/error.hpp"

#include <catch2/catch.hpp>

#include <sstream>

using namespace celltrace;
using namespace celltrace::cli;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

RenderRequest render_request(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "render");
  return std::get<RenderRequest>(parse_command_line(arguments));
}

std::string shape(const CacheConfig& cache) {
  return std::to_string(cache.ways) + "x" + std::to_string(cache.sets) + ":" +
         std::to_string(static_cast<unsigned>(cache.replacement));
}

std::string error_of(std::vector<std::string> arguments) {
  try {
    parse_command_line(std::move(arguments));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string render_error(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"render", "a.pov"});
  return error_of(std::move(arguments));
}

} // namespace

TEST_CASE("render has the documented defaults") {
  const RenderRequest r = render_request({"scenes/bunny.pov"});
  CHECK(r.scene == "scenes/bunny.pov");
  CHECK(r.output == "bunny.png");
  CHECK(r.options.width == 640);
  CHECK(r.options.height == 480);
  CHECK(r.options.backend == Backend::native);
  CHECK(r.options.spes == 0);
  CHECK(r.options.simd == SimdLevel::automatic);
  CHECK(r.options.cache.enabled);
  CHECK(shape(r.options.cache) == "4x128:1");
  CHECK(r.options.balance == Balance::gde);
  CHECK_FALSE(r.options.max_trace_level);
  CHECK_FALSE(r.options.adc_bailout);
  CHECK(r.options.emulation.schedule == Schedule::free);
  CHECK(r.options.emulation.transfers == TransferTime::at_wait);
  CHECK(r.options.emulation.faults.slowest_spe == 1);
  CHECK(r.options.emulation.timing.spes == 8);
  CHECK_FALSE(r.options.emulation.explore);
  CHECK(r.trace.empty());
  CHECK(r.stats.empty());
  CHECK_FALSE(r.quiet);
}

TEST_CASE("every option of render arrives") {
  const RenderRequest r =
      render_request({"-o",        "out.ppm", "-W",      "32",     "-H",          "16",        "--backend",
                      "cell_emu",  "--spes",  "6",       "--simd", "avx2",        "--cache",   "2x64:lru",
                      "--balance", "static",  "--model", "shared", "--max-level", "9",         "--adc",
                      "0.01",      "-L",      "one",     "-L",     "two",         "--declare", "x=1",
                      "--declare", "s=a=b",   "--stats", "-",      "--quiet",     "a.pov"});
  CHECK(r.scene == "a.pov");
  CHECK(r.output == "out.ppm");
  CHECK(r.options.width == 32);
  CHECK(r.options.height == 16);
  CHECK(r.options.backend == Backend::cell_emu);
  CHECK(r.options.spes == 6);
  CHECK(r.options.simd == SimdLevel::avx2);
  CHECK(shape(r.options.cache) == "2x64:2");
  CHECK(r.options.balance == Balance::fixed);
  CHECK(r.options.max_trace_level == 9);
  CHECK(r.options.adc_bailout == 0.01);
  CHECK(r.library_paths == std::vector<std::filesystem::path>{"one", "two"});
  CHECK(r.declares == std::vector<std::pair<std::string, std::string>>{{"x", "1"}, {"s", "a=b"}});
  CHECK(r.stats == "-");
  CHECK(r.quiet);
}

TEST_CASE("every option of cell_emu arrives") {
  const auto request = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--backend", "cell_emu", "a.pov"});
    return render_request(std::move(arguments));
  };
  const RenderRequest all =
      request({"--schedule", "lockstep", "--seed", "18446744073709551615", "--transfers", "random",
               "--faults", "--timing", "ps3", "--trace", "t.json"});
  const EmulationConfig& emulation = all.options.emulation;
  CHECK(emulation.schedule == Schedule::lockstep);
  CHECK(emulation.explore);
  CHECK(emulation.seed == 18446744073709551615u);
  CHECK(emulation.transfers == TransferTime::random);
  CHECK(emulation.faults.slowest_spe == Faults::mixed().slowest_spe);
  CHECK(emulation.timing.spes == 6);
  CHECK(emulation.timing.clock_hz == 3.192e9);
  CHECK(all.trace == "t.json");

  const auto config = [&](std::vector<std::string> arguments) {
    return request(std::move(arguments)).options.emulation;
  };
  CHECK_FALSE(config({"--schedule", "lockstep"}).explore);
  CHECK(config({"--trace", "t.json"}).schedule == Schedule::lockstep);
  CHECK_FALSE(config({"--trace", "t.json"}).explore);
  CHECK(config({"--trace", "t.json", "--seed", "3"}).explore);
  CHECK(config({"--schedule", "free"}).schedule == Schedule::free);
  CHECK(config({"--transfers", "issue"}).transfers == TransferTime::at_issue);
  CHECK(config({"--transfers", "wait"}).transfers == TransferTime::at_wait);
  CHECK(config({"--timing", "cell"}).timing.spes == 8);
  CHECK(config({}).cycle_limit == 0);
  CHECK(config({}).seconds_limit == 0);
  CHECK(config({}).actions.empty());
  CHECK(config({"--limit", "3200000000"}).cycle_limit == 3200000000u);
  CHECK(config({"--seconds-limit", "1.5"}).seconds_limit == 1.5);
  CHECK(config({"--lenient"}).actions == lenient_actions());
  for (const std::vector<std::string>& drawn : {std::vector<std::string>{"--faults"},
                                                {"--transfers", "random"},
                                                {"--schedule", "free", "--faults"}}) {
    std::vector<std::string> arguments = drawn;
    arguments.insert(arguments.end(), {"--seed", "9"});
    CHECK(config(arguments).seed == 9);
    CHECK_FALSE(config(arguments).explore);
  }
}

TEST_CASE("options of cell_emu that make no sense are refused") {
  const std::vector<std::vector<std::string>> emulated = {{"--schedule", "free"},
                                                          {"--schedule", "lockstep"},
                                                          {"--seed", "7"},
                                                          {"--transfers", "wait"},
                                                          {"--faults"},
                                                          {"--timing", "cell"},
                                                          {"--trace", "t.json"},
                                                          {"--limit", "5"},
                                                          {"--seconds-limit", "1"}};
  for (const auto& arguments : emulated)
    CHECK_THAT(render_error(arguments), StartsWith(arguments[0] + " needs --backend cell_emu"));

  const auto error = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--backend", "cell_emu"});
    return render_error(std::move(arguments));
  };
  CHECK_THAT(error({"--schedule", "free", "--trace", "t.json"}),
             StartsWith("--trace needs --schedule lockstep"));
  CHECK_THAT(error({"--seed", "7"}), StartsWith("--seed needs --schedule lockstep"));
  CHECK_THAT(error({"--seed", "7", "--schedule", "free"}), StartsWith("--seed needs --schedule lockstep"));
  CHECK_THAT(error({"--schedule", "fair"}), Contains("'fair' is none of free, lockstep"));
  CHECK_THAT(error({"--transfers", "late"}), Contains("'late' is none of issue, wait, random"));
  CHECK_THAT(error({"--timing", "ps2"}), Contains("'ps2' is none of cell, ps3"));
  for (const std::string bad : {"-1", "x", "1.5", "18446744073709551616"})
    CHECK_THAT(error({"--schedule", "lockstep", "--seed", bad}), Contains("--seed"));
  for (const std::string bad : {"-1", "x", "1.5"})
    CHECK_THAT(error({"--limit", bad}), StartsWith("--limit: '" + bad + "' is not a whole"));
  for (const std::string bad : {"-1", "x", "nan", "inf", "1e10"})
    CHECK_THAT(error({"--seconds-limit", bad}), StartsWith("--seconds-limit: '" + bad + "' is not a number"));
}

TEST_CASE("cell_sim takes the options of cell_emu, but for what machine code cannot tell") {
  const auto simulated = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--backend", "cell_sim", "a.pov"});
    return render_request(std::move(arguments));
  };
  const RenderRequest all = simulated({"--schedule", "lockstep", "--seed", "7", "--transfers", "random",
                                       "--faults", "--timing", "ps3", "--trace", "t.json", "--limit", "5"});
  CHECK(all.options.backend == Backend::cell_sim);
  CHECK(all.options.emulation.explore);
  CHECK(all.options.emulation.timing.spes == 6);
  CHECK(all.options.emulation.cycle_limit == 5);
  CHECK(all.trace == "t.json");
  CHECK(simulated({}).options.emulation.schedule == Schedule::free);
  CHECK_THAT(render_error({"--backend", "cell_sim", "--cache-trace", "t"}),
             StartsWith("--cache-trace needs --backend cell_emu"));
}

TEST_CASE("spu takes a program, its arguments and what it may use") {
  const auto spu = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "spu");
    return std::get<SpuRequest>(parse_command_line(std::move(arguments)));
  };
  const SpuRequest plain = spu({"a/b.elf"});
  CHECK(plain.program == "a/b.elf");
  CHECK(plain.machine.backend == Backend::cell_sim);
  CHECK(plain.machine.spes == 1);
  CHECK(plain.machine.emulation.schedule == Schedule::lockstep);
  CHECK_FALSE(plain.machine.emulation.explore);
  CHECK(plain.machine.emulation.cycle_limit == 0);
  CHECK(plain.machine.simulation.arguments == std::vector<std::string>{"a/b.elf"});
  CHECK(plain.machine.simulation.allowed_folders.empty());
  CHECK(plain.input.empty());
  CHECK(plain.stats.empty());
  CHECK(plain.profile.empty());
  CHECK(plain.trace.empty());
  CHECK_FALSE(plain.summary);
  CHECK_FALSE(plain.quiet);

  const SpuRequest all =
      spu({"--spes",  "3",       "p.elf",     "one",      "--limit",       "9",       "two",
           "--allow", "x",       "--allow",   "y",        "--stdin",       "in.txt",  "--summary",
           "--stats", "-",       "--profile", "p.json",   "--profile-all", "--quiet", "--seed",
           "4",       "--trace", "t.json",    "--timing", "ps3",           "--",      "--three"});
  CHECK(all.program == "p.elf");
  CHECK(all.machine.spes == 3);
  CHECK(all.machine.emulation.cycle_limit == 9);
  CHECK(all.machine.emulation.seed == 4);
  CHECK(all.machine.emulation.explore);
  CHECK(all.machine.emulation.timing.spes == 6);
  CHECK(all.machine.simulation.arguments == std::vector<std::string>{"p.elf", "one", "two", "--three"});
  CHECK(all.machine.simulation.allowed_folders == std::vector<std::filesystem::path>{"x", "y"});
  CHECK(all.input == "in.txt");
  CHECK(all.stats == "-");
  CHECK(all.profile == "p.json");
  CHECK(all.profile_all);
  CHECK(all.trace == "t.json");
  CHECK(all.summary);
  CHECK(all.quiet);
  CHECK(spu({"p.elf", "--schedule", "free"}).machine.emulation.schedule == Schedule::free);

  CHECK_THAT(error_of({"spu"}), Contains("program"));
  CHECK_THAT(error_of({"spu", "p.elf", "--cache-trace", "t"}), Contains("--cache-trace"));
  CHECK_THAT(error_of({"spu", "p.elf", "--profile-all"}), Contains("--profile-all needs --profile"));
  CHECK_THAT(error_of({"spu", "p.elf", "--spes", "257"}), Contains("--spes"));
  CHECK_THAT(error_of({"spu", "p.elf", "--schedule", "free", "--trace", "t"}), Contains("--trace needs"));
}

TEST_CASE("cache settings") {
  CHECK(parse_cache("off").enabled == false);
  CHECK(shape(parse_cache("4x128")) == "4x128:1");
  CHECK(shape(parse_cache("64x1:fifo")) == "64x1:1");
  CHECK(shape(parse_cache("1x512:random")) == "1x512:0");
  for (const std::string bad : {"", "4", "4x", "x4", "4x4x4", "-4x4", "4x4 ", "4x99999999999", "on"}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH(parse_cache(bad), Contains("neither WAYSxSETS"));
  }
  CHECK_THROWS_WITH(parse_cache("4x4:plru"), Contains("none of random, fifo, lru"));
  CHECK_THROWS_AS(parse_cache("4x4:"), InputError);
  for (const std::string impossible : {"0x0", "3x4", "4x3", "12x2", "4x65536"})
    CHECK_THROWS_WITH(parse_cache(impossible), Contains("'" + impossible + "' is no cache"));
}

TEST_CASE("study takes a folder, and what to make") {
  const auto study = std::get<StudyRequest>(
      parse_command_line({"study", "--quick", "--out", "a", "--only", "simd", "--threads", "3", "--quiet"}));
  CHECK(study.options.quick);
  CHECK(study.options.only == "simd");
  CHECK(study.options.threads == 3);
  CHECK(study.out == "a");
  CHECK(study.quiet);
  CHECK_THROWS_AS(parse_command_line({"study", "--only", "nothing"}), InputError);
}

TEST_CASE("replay takes a trace and shapes of caches") {
  const auto replay = std::get<ReplayRequest>(parse_command_line(
      {"replay", "a.trace", "--cache", "8x4:lru", "--cache", "off", "--no-prefetch", "--json"}));
  CHECK(replay.trace == "a.trace");
  REQUIRE(replay.shapes.size() == 2);
  CHECK(shape(replay.shapes[0]) == "8x4:2");
  CHECK_FALSE(replay.shapes[1].enabled);
  CHECK_FALSE(replay.prefetches);
  CHECK(replay.json);
  const auto plain = std::get<ReplayRequest>(parse_command_line({"replay", "a.trace"}));
  CHECK(plain.shapes.empty());
  CHECK(plain.prefetches);
  CHECK_FALSE(plain.json);
  CHECK_THAT(error_of({"replay"}), Contains("trace"));
  CHECK_THAT(error_of({"replay", "a", "--cache", "3x3"}), Contains("no cache"));
  CHECK_THAT(render_error({"--cache-trace", "t"}), Contains("--cache-trace needs --backend cell_emu"));
  CHECK(render_request({"a.pov", "--backend", "cell_emu", "--cache-trace", "t"}).cache_trace == "t");
}

TEST_CASE("the programming model is one of four") {
  const auto model = [](const char* name) {
    return render_request({"--model", name, "a.pov"}).options.model;
  };
  CHECK(model("shared") == Model::shared);
  CHECK(model("pipeline") == Model::pipeline);
  CHECK(model("pipeline-split") == Model::pipeline_split);
  CHECK(model("offload") == Model::offload);
  CHECK_THAT(render_error({"--model", "stream"}), Contains("'stream' is none of shared, pipeline"));
}

TEST_CASE("the ways to share a frame are five") {
  const auto balance = [](const char* name) {
    return render_request({"--balance", name, "a.pov"}).options.balance;
  };
  CHECK(balance("gde") == Balance::gde);
  CHECK(balance("diffusion") == Balance::diffusion);
  CHECK(balance("static") == Balance::fixed);
  CHECK(balance("scatter") == Balance::scatter);
  CHECK(balance("tiles") == Balance::tiles);
  CHECK_THAT(render_error({"--balance", "fair"}), Contains("'fair' is none of gde, diffusion"));
}

TEST_CASE("what is to come is refused as such") {
  CHECK_THAT(render_error({"--backend", "spu"}), Contains("'spu' is not supported yet"));
}

TEST_CASE("errors of the command line are one line that names the option") {
  const std::vector<std::vector<std::string>> wrong = {
      {"--width", "0"},     {"--width", "70000"},  {"--height", "x"},  {"--spes", "0"},
      {"--spes", "257"},    {"--backend", "cuda"}, {"--simd", "mmx"},  {"--adc", "2"},
      {"--max-level", "0"}, {"--max-level", "x"},  {"--cache", "big"}, {"--declare", "x"},
      {"--declare", "=1"},  {"--seed", "-1"}};
  for (const auto& arguments : wrong) {
    const std::string error = render_error(arguments);
    CAPTURE(error);
    CHECK_THAT(error, Contains(arguments[0]));
    CHECK(error.find('\n') == std::string::npos);
  }
  CHECK_THAT(render_error({"--nonsense"}), Contains("--nonsense"));
  CHECK_THAT(render_error({"second.pov"}), Contains("second.pov"));
  CHECK_THAT(error_of({"render"}), Contains("scene"));
  CHECK_FALSE(error_of({}).empty());
  CHECK_FALSE(error_of({"compare", "a.png"}).empty());
}

TEST_CASE("antialiasing is off unless asked for") {
  CHECK_FALSE(render_request({"a.pov"}).options.antialiasing);
  CHECK_FALSE(render_request({"a.pov", "--antialias-depth", "2"}).options.antialiasing);
  const auto fixed = render_request({"a.pov", "--antialias", "0.3"}).options.antialiasing.value();
  CHECK(fixed.method == Antialiasing::Method::fixed);
  CHECK(fixed.threshold == 0.3);
  CHECK(fixed.depth == 3);
  CHECK(fixed.jitter == 0);
  CHECK(fixed.gamma == 2.5);
  const auto adaptive =
      render_request({"a.pov", "--antialias", "0", "--antialias-method", "2", "--antialias-depth", "5",
                      "--antialias-jitter", "0.5", "--antialias-gamma", "1"})
          .options.antialiasing.value();
  CHECK(adaptive.method == Antialiasing::Method::adaptive);
  CHECK(adaptive.threshold == 0);
  CHECK(adaptive.depth == 5);
  CHECK(adaptive.jitter == 0.5);
  CHECK(adaptive.gamma == 1);
  CHECK_THAT(render_error({"--antialias", "4"}), Contains("--antialias"));
  CHECK_THAT(render_error({"--antialias-method", "3"}), Contains("--antialias-method"));
  CHECK_THAT(render_error({"--antialias-depth", "10"}), Contains("--antialias-depth"));
}

TEST_CASE("regions count as POV-Ray does") {
  const auto columns = [](const std::string& start, const std::string& end) {
    const auto region = render_request({"a.pov", "-W", "40", "-H", "20", "--start-column", start,
                                        "--end-column", end, "--end-row", "9"})
                            .options.region.value();
    CHECK(region.top == 0);
    CHECK(region.bottom == 9);
    return std::make_pair(region.left, region.right);
  };
  // As found with POV-Ray 3.7.
  CHECK(columns("11", "20") == std::make_pair(10, 20));
  CHECK(columns("0.25", "0.5") == std::make_pair(10, 20));
  CHECK(columns("0.3", "0.52") == std::make_pair(12, 20));
  CHECK(columns("0", "1") == std::make_pair(0, 40));
  CHECK(columns("1", "1") == std::make_pair(0, 40));
  CHECK(columns("1.5", "5.7") == std::make_pair(0, 5));
  CHECK(columns("0.999", "40") == std::make_pair(39, 40));
  CHECK(columns("0.1", "0.9") == std::make_pair(4, 35)); // 0.9 is less in single precision
  CHECK_FALSE(render_request({"a.pov", "--start-row", "1", "--end-row", "480"}).options.region);
  CHECK_THAT(render_error({"--end-column", "641"}), Contains("columns") && Contains("640"));
  CHECK_THAT(render_error({"--start-row", "481"}), Contains("rows") && Contains("480"));
  CHECK_THAT(render_error({"--start-row", "20", "--end-row", "10"}), Contains("no rows"));
  CHECK_THAT(render_error({"--end-row", "0"}), Contains("no rows"));
  CHECK_THAT(render_error({"--end-row", "1e300"}), Contains("rows"));
  CHECK_THAT(render_error({"--start-row", "-1"}), Contains("--start-row"));
  CHECK_THAT(render_error({"--end-row", "nan"}), Contains("--end-row"));
  CHECK_THAT(render_error({"--clock", "inf"}), Contains("--clock"));
}

TEST_CASE("the picture's name by POV-Ray's rule") {
  // As povray 3.7 names its pictures; the scene is b/q.pov.
  const auto name = [](const std::string& given, const std::string& type) {
    return pov_output(given, "b/q.pov", "." + type).string();
  };
  CHECK(name("out", "png") == "out.png");
  CHECK(name("out.png", "png") == "out.png");
  CHECK(name("out.foo", "png") == "out.foo.png");
  CHECK(name("out.jpg", "png") == "out.jpg.png");
  CHECK(name("out.jpeg", "jpg") == "out.jpeg.jpg");
  CHECK(name("out.PNG", "png") == "out.PNG.png");
  CHECK(name("out.", "png") == "out.png");
  CHECK(name("out..", "png") == "out..png");
  CHECK(name("out.png.", "png") == "out.png.png");
  CHECK(name("dir/", "tga") == "dir/q.tga");
  CHECK(name("dir.d/x", "png") == "dir.d/x.png");
  CHECK(name("dir.png/x", "png") == "dir.png/x.png");
  CHECK(name(".hidden", "png") == ".hidden.png");
  CHECK(name(".", "png") == ".png");
  CHECK(name(".png", "png") == "q.png");
  CHECK(name("dir/.png", "png") == "dir/q.png");
  CHECK(name("", "png") == "q.png");

  const auto output = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "b/a.pov");
    return render_request(std::move(arguments)).output;
  };
  CHECK(output({"--pov-output", "x.jpg"}) == "x.jpg.png");
  CHECK(output({"--pov-output", "x.jpg", "--file-type", "jpg"}) == "x.jpg");
  CHECK(output({"--pov-output", "x", "--file-type", "jpeg"}) == "x.jpg");
  CHECK(output({"--pov-output", "x.mp4"}) == "x.mp4"); // no file of POV-Ray's
  CHECK(output({"--pov-output", "x", "-o", "y.ppm"}) == "y.ppm");
  CHECK(output({"--pov-output", "-"}) == "-");
  CHECK(output({"--pov-output", "/dev/null"}) == "/dev/null");
}

TEST_CASE("how a picture is stored") {
  CHECK_FALSE(render_request({"a.pov"}).file.alpha);
  CHECK(render_request({"a.pov"}).file.jpeg_quality == 85);
  CHECK(render_request({"a.pov", "--jpeg-quality", "0"}).file.jpeg_quality == 0);
  CHECK_THAT(render_error({"--jpeg-quality", "101"}), Contains("--jpeg-quality"));
  CHECK(render_request({"a.pov", "-o", "a.tga", "--compression", "rle"}).file.run_lengths);
  CHECK_THAT(render_error({"--compression", "rle"}), Contains("TGA"));
  CHECK_THAT(render_error({"--grey", "on", "-o", "a.bmp"}), Contains("no grey"));
  CHECK_THAT(render_error({"--grey", "on", "-o", "a.y4m"}), Contains("films"));
  for (const std::string gamma : {"sRGB", "srgb", "SRGB"}) {
    const RenderRequest request = render_request({"a.pov", "--file-gamma", gamma});
    CHECK(request.file.gamma == FileGamma());
    CHECK_FALSE(request.options.colours);
  }
  const RenderRequest linear = render_request({"a.pov", "--file-gamma", "1.0"});
  CHECK(linear.file.gamma.power == 1.0);
  CHECK(linear.options.colours);
  for (const std::string gamma : {"0", "-1", "abc", "1x", "inf", "nan", ""})
    CHECK_THAT(render_error({"--file-gamma", gamma}), Contains("--file-gamma"));
}

TEST_CASE("the picture's name and type") {
  const auto output = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "b/a.pov");
    return render_request(std::move(arguments)).output;
  };
  CHECK(output({"--file-type", "ppm"}) == "a.ppm");
  CHECK(output({"-o", "x"}) == "x.png");
  CHECK(output({"-o", "x", "--file-type", "ppm"}) == "x.ppm");
  CHECK(output({"-o", "x.PPM", "--file-type", "ppm"}) == "x.PPM");
  CHECK(output({"-o", "x.jpeg", "--file-type", "jpg"}) == "x.jpeg");
  CHECK(output({"-o", "/dev/null"}) == "/dev/null");
  CHECK(output({"-o", "/dev/null", "--final-frame", "2"}).empty());
  CHECK_THAT(render_error({"-o", "/dev/fd/1", "--final-frame", "2"}), Contains("as a film"));
  CHECK(render_request({"a.pov", "-o", "/dev/fd/1", "--file-type", "y4m"}).film == FilmFormat::y4m);
  CHECK(output({"-o", "x/"}) == "x/a.png");
  CHECK(output({"--picture", "off"}).empty());
  CHECK_THAT(render_error({"-o", "x.png", "--file-type", "ppm"}), Contains("x.png") && Contains("ppm"));
  CHECK(output({"-o", "-"}) == "-");
  CHECK(output({"-o", "-", "--format", "hdr"}) == "-");
  CHECK(output({"--format", "dds"}) == "a.dds");
  CHECK_FALSE(render_request({"a.pov"}).options.colours);
  CHECK(render_request({"a.pov", "--bits", "16"}).options.colours);
  CHECK_THAT(render_error({"--bits", "33"}), Contains("--bits"));
  CHECK_THAT(render_error({"--bits", "32"}), Contains("--bits 32"));
  // POV-Ray takes any number for any format.
  const auto bits = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "a.pov");
    const RenderRequest request = render_request(std::move(arguments));
    return std::make_pair(request.bits, request.notes.size());
  };
  CHECK(bits({"--bits", "12"}) == std::make_pair(16, std::size_t{1}));
  CHECK(bits({"--bits", "5"}) == std::make_pair(8, std::size_t{1}));
  CHECK(bits({"--format", "hdr", "--bits", "16"}) == std::make_pair(8, std::size_t{1}));
  CHECK(bits({"--format", "exr", "--bits", "8"}) == std::make_pair(16, std::size_t{1}));
  CHECK(bits({"--format", "jpg", "--bits", "8"}) == std::make_pair(8, std::size_t{0}));
  CHECK(bits({"--grey", "on"}) == std::make_pair(16, std::size_t{0}));
  CHECK(bits({"--grey", "on", "--bits", "8"}) == std::make_pair(8, std::size_t{0}));
  CHECK(bits({"--grey", "on", "--format", "tga"}) == std::make_pair(8, std::size_t{0}));
  CHECK(render_request({"a.pov", "-o", "a.hdr"}).options.colours);
  CHECK(render_request({"a.pov", "-o", "a.dds"}).options.blocks);
  CHECK(render_request({"a.pov", "--alpha", "on"}).options.alpha);
  CHECK_THAT(render_error({"--alpha", "on", "-o", "a.dds"}), Contains("alpha"));
  CHECK(render_request({"a.pov", "--alpha", "on"}).file.alpha == true);
  CHECK(render_request({"a.pov", "--alpha", "on", "-o", "a.tga"}).notes.empty());
  const RenderRequest opaque = render_request({"a.pov", "--alpha", "on", "-o", "a.ppm"});
  CHECK(opaque.options.alpha);
  CHECK(opaque.options.colours);
  CHECK(opaque.notes.size() == 1);
  CHECK_THAT(render_error({"--alpha", "on", "-o", "a.y4m"}), Contains("alpha"));
  CHECK_THAT(render_error({"--first-hits", "on"}), Contains("--first-hits"));
  CHECK_THAT(render_error({"-o", "-", "--stats", "-"}), Contains("standard output"));
  CHECK(render_request({"a.pov", "--clock", "0.5"}).clock == 0.5);
  CHECK(render_request({"a.pov", "--quality", "4"}).options.quality == 4);
  CHECK_THAT(render_error({"--quality", "12"}), Contains("--quality"));
}

TEST_CASE("compare") {
  const auto c = std::get<CompareRequest>(parse_command_line(
      {"compare", "a.png", "b.png", "--min-psnr", "40", "--min-ssim", "0.9", "--diff", "d.png", "--json"}));
  CHECK(c.a == "a.png");
  CHECK(c.b == "b.png");
  CHECK(c.min_psnr == 40.0);
  CHECK(c.min_ssim == 0.9);
  CHECK(c.difference == "d.png");
  CHECK(c.json);
}

TEST_CASE("help and version are information") {
  CHECK_THAT(std::get<InformationRequest>(parse_command_line({"--version"})).text, StartsWith("celltrace "));
  const std::string help = std::get<InformationRequest>(parse_command_line({"--help"})).text;
  CHECK_THAT(help, Contains("render") && Contains("compare"));
  const std::string render_help = std::get<InformationRequest>(parse_command_line({"render", "--help"})).text;
  CHECK_THAT(render_help, Contains("--backend") && Contains("WAYSxSETS"));
}

TEST_CASE("help fits a terminal of 80 columns") {
  for (const std::string command : {"", "render", "view", "compare", "spu", "replay", "study"}) {
    std::vector<std::string> arguments = {"--help"};
    if (!command.empty()) arguments.insert(arguments.begin(), command);
    const std::string help = std::get<InformationRequest>(parse_command_line(arguments)).text;
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) {
      INFO(command << ": " << line);
      CHECK(line.size() <= 80);
      CHECK((line.empty() || line.back() != ' '));
    }
    CHECK_THAT(help, Contains("Usage: celltrace"));
    // Types of the parser's library are no words for people.
    CHECK_THAT(help, !Contains("INT") && !Contains("FLOAT") && !Contains("NONNEGATIVE"));
  }
  const std::string render_help = std::get<InformationRequest>(parse_command_line({"render", "--help"})).text;
  CHECK_THAT(render_help, Contains("  -W, --width N           Pixels a row (1 to 65535; default: 640)\n"));
  // What works on every backend stands before what is for the emulated Cell.
  CHECK(render_help.find("--lenient") < render_help.find("--schedule"));
}

TEST_CASE("a misspelt option suggests the nearest") {
  CHECK_THAT(render_error({"--qualty", "9"}),
             Contains("there is no option '--qualty': '--quality' perhaps?") &&
                 Contains("celltrace render --help"));
  CHECK_THAT(render_error({"--antilias=0.3"}), Contains("'--antialias' perhaps?"));
  CHECK_THAT(render_error({"--colour-of-the-sky"}), Contains("there is no option '--colour-of-the-sky' ("));
  CHECK_THAT(error_of({"compare", "a.png", "b.png", "c.png"}), Contains("'c.png' is one argument too many"));
  CHECK_THAT(render_error({"--antialias"}), Contains("--antialias needs a value: THRESHOLD, 0 to 3"));
  try {
    parse_command_line({});
    FAIL("took no arguments");
  } catch (const InputError& error) {
    CHECK_THAT(error.what(), Contains("celltrace SCENE.pov") && Contains("(celltrace --help"));
  }
}
