// Pictures that the program never has in memory whole.
#include "celltrace/image.hpp"
#include "cli/program_run.hpp"

#include <chrono>

#include <poll.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

using namespace celltrace;
using namespace celltrace::test;
using Catch::Matchers::Contains;

namespace {

void write_scene(const TemporaryFolder& folder) {
  write_bytes(folder / "s.pov", "camera { location -6*z look_at 0 angle 30 }\n"
                                "light_source { <5, 5, -9>, 1 }\n"
                                "background { rgb <0.2, 0.3, 0.5> }\n"
                                "sphere { 0, 1 pigment { checker rgb 1 rgb 0.2 scale 0.1 } }\n");
}

/// What takes a while: many rays through glass, wherever the camera looks.
void write_slow_scene(const TemporaryFolder& folder) {
  write_bytes(folder / "s.pov",
              "global_settings { max_trace_level 4 }\n"
              "camera { location -6*z look_at 0 angle 10 }\n"
              "light_source { <5, 5, -9>, 1 }\n"
              "background { rgb <0.2, 0.3, 0.5> }\n"
              "#declare R = seed(3);\n"
              "#for (I, 1, 12)\n"
              "  sphere { (<rand(R), rand(R), rand(R)> - 0.5) * 1.6, 0.4\n"
              "    pigment { rgbt <1, 1, 1, 0.9> } finish { reflection 0.3 } interior { ior 1.3 } }\n"
              "#end\n");
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSanitized = true;
#elif defined(__has_feature)
constexpr bool kIsSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool kIsSanitized = false;
#endif

using Arguments = std::vector<std::string>;

Arguments joined(Arguments first, const Arguments& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Waits half a minute at most.
template <class Condition> bool comes_true(Condition condition) {
  const auto start = std::chrono::steady_clock::now();
  while (!condition()) {
    if (std::chrono::steady_clock::now() - start > std::chrono::seconds(30)) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

} // namespace

TEST_CASE("a poster of A0 at 300 dpi is rendered, and so is the largest picture") {
  const TemporaryFolder folder;
  write_scene(folder);
  const Outcome outcome =
      celltrace_run(folder, {"s.pov", "+W14043", "+H9933", "+SR1", "+ER2", "-o", "a0.ppm"});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("14043x2"));
  CHECK(std::filesystem::file_size(folder / "a0.ppm") == 3ull * 14043 * 9933 + 18);
  const Outcome largest = celltrace_run(
      folder, {"s.pov", "+W65535", "+H65535", "+SR32768", "+ER32768", "--picture", "off", "--stats", "-"});
  CHECK(largest.exit_code == 0);
  CHECK(nlohmann::json::parse(largest.out)["rays"]["primary"] == 65535);
}

TEST_CASE("what has to be in memory whole says what is too large") {
  const TemporaryFolder folder;
  write_scene(folder);
  for (const char* output : {"p.dds", "p.y4m"}) {
    const Outcome outcome = celltrace_run(folder, {"s.pov", "+W14043", "+H9933", "-o", output});
    CHECK(outcome.exit_code == 1);
    CHECK(lines(outcome.err) == 1);
    CHECK_THAT(outcome.err, Contains("14043x9933") && Contains("134217728"));
  }
}

TEST_CASE("a poster takes memory for some rows only") {
  const TemporaryFolder folder;
  write_bytes(folder / "s.pov", "camera { location -6*z look_at 0 } background { rgb 1 }\n");
  Run run(folder, {"s.pov", "+W3000", "+H20000", "-o", "/dev/null", "--file-type", "ppm"});
  const Outcome outcome = run.finish();
  CHECK(outcome.exit_code == 0);
  CAPTURE(outcome.peak_kilobytes);
  // Its pixels take 240 MB, and what makes pictures of them as much again.
  CHECK(outcome.peak_kilobytes > 1000);
  if (!kIsSanitized) CHECK(outcome.peak_kilobytes < 150'000);
}

TEST_CASE("a part of a poster is in its place") {
  const TemporaryFolder folder;
  write_scene(folder);
  const Arguments all = {"s.pov", "+W4200", "+H4200", "+SC2001", "+EC2100", "-o"};
  REQUIRE(celltrace_run(folder, joined(all, {"a.ppm", "+SR2000", "+ER2199"})).exit_code == 0);
  REQUIRE(celltrace_run(folder, joined(all, {"b.ppm", "+SR2017", "+ER2100"})).exit_code == 0);
  const Image a = load_image(folder / "a.ppm"), b = load_image(folder / "b.ppm");
  REQUIRE(a.width == 4200);
  REQUIRE(a.height == 4200);
  bool same = true, blank = true;
  for (int y = 1990; y < 2210; ++y)
    for (int x = 1990; x < 2110; ++x) {
      const bool in_columns = x >= 2000 && x < 2100;
      if (in_columns && y >= 2016 && y < 2100)
        same = same && std::equal(a.pixel(x, y), a.pixel(x, y) + 4, b.pixel(x, y));
      if (!in_columns || y < 1999 || y >= 2199) blank = blank && a.pixel(x, y)[2] == 0;
    }
  CHECK(same);
  CHECK(blank);
  CHECK(a.pixel(2000, 1999)[2] != 0);
  CHECK(a.pixel(2099, 2198)[2] != 0);
  CHECK(b.pixel(2050, 2015)[2] == 0);
  // With alpha, what is not rendered is clear.
  REQUIRE(celltrace_run(folder, joined(all, {"c.png", "+SR2000", "+ER2020", "+UA"})).exit_code == 0);
  const Image c = load_image(folder / "c.png");
  CHECK(c.pixel(2050, 2010)[3] == 255);
  CHECK(c.pixel(1999, 2010)[3] == 0);
  CHECK(c.pixel(2050, 1998)[3] == 0);
  CHECK(c.pixel(2050, 4199)[3] == 0);
}

TEST_CASE("what flows to a reader is what a file gets") {
  const Arguments more = GENERATE(
      Arguments{"--file-type", "png"}, Arguments{"--file-type", "png", "--bits", "16", "+UA", "+A0.1", "+J"},
      Arguments{"--file-type", "ppm", "+SR20", "+ER70", "+SC7", "+EC90", "+A0.1", "+AM2"},
      Arguments{"--file-type", "hdr"}, Arguments{"--file-type", "exr", "--first-hits", "on", "+UA"});
  const TemporaryFolder folder;
  write_scene(folder);
  const Arguments all = joined({"s.pov", "+W160", "+H120"}, more);
  const Outcome to_file = celltrace_run(folder, joined(all, {"-o", "p." + more[1]}));
  if (to_file.exit_code != 0 && to_file.err.find("this build cannot write") != std::string::npos) return;
  CAPTURE(to_file.err);
  REQUIRE(to_file.exit_code == 0);
  const Outcome outcome = celltrace_run(folder, joined(all, {"-o", "-"}));
  CAPTURE(more, outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == read_bytes(folder / ("p." + more[1])));
}

TEST_CASE("a reader sees the first rows before the last ones are rendered") {
  const TemporaryFolder folder;
  write_slow_scene(folder);
  const std::filesystem::path pipe_path = folder / "pipe.ppm";
  REQUIRE(mkfifo(pipe_path.c_str(), 0600) == 0);
  // Does not wait for somebody who writes.
  const int reader = open(pipe_path.c_str(), O_RDONLY | O_NONBLOCK);
  // Rows come in bands, of which the first one has an eighth of the picture.
  Run run(folder, {"s.pov", "+W400", "+H3200", "-o", "pipe.ppm", "--file-type", "ppm", "--quiet"});
  REQUIRE(comes_true([&] {
    pollfd wanted = {reader, POLLIN, 0};
    return poll(&wanted, 1, 0) == 1 && (wanted.revents & POLLIN) != 0;
  }));
  REQUIRE(fcntl(reader, F_SETFL, 0) == 0);
  std::FILE* const pipe = fdopen(reader, "rb");
  std::string bytes(15 + 3 * 400, '\0');
  CHECK(std::fread(bytes.data(), 1, bytes.size(), pipe) == bytes.size());
  CHECK(bytes.substr(0, 15) == "P6\n400 3200\n255");
  CHECK(bytes.substr(100, 100) != std::string(100, '\0'));
  run.send(SIGINT);
  std::size_t count = bytes.size();
  std::vector<char> rest(1 << 16);
  bool is_last_black = false;
  for (std::size_t part; (part = std::fread(rest.data(), 1, rest.size(), pipe)) != 0; count += part)
    is_last_black = std::all_of(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(part),
                                [](char byte) { return byte == 0; });
  std::fclose(pipe);
  CHECK(run.finish().exit_code == 2);
  CHECK(count == 3ull * 400 * 3200 + 16);
  CHECK(is_last_black);
}

TEST_CASE("a poster that is killed goes on with the rows that are missing") {
  const Arguments more = GENERATE(Arguments{"-o", "p.png"}, Arguments{"-o", "p.png", "+FN16", "+UA"},
                                  Arguments{"-o", "p.png", "+A0.3", "+J0.5", "+R2"});
  const bool is_asked_for = more.size() > 2; // else rows are kept as they take long
  const TemporaryFolder folder;
  write_slow_scene(folder);
  const Arguments all =
      joined({"s.pov", "+W4200", "+H4200", "+SC2001", "+EC2040", "+SR2001", "+ER3300"}, more);
  REQUIRE(celltrace_run(folder, joined(all, {"--stats", "whole.json"})).exit_code == 0);
  const std::string whole = read_bytes(folder / more[1]);
  std::filesystem::remove(folder / more[1]);

  const std::filesystem::path rows = folder / (more[1] + ".rows");
  Outcome stopped, resumed;
  // A signal may come while the first part is written, of which nothing is kept then: the next one comes
  // later.
  for (std::uintmax_t least = 10'000; least < 200'000; least *= 2) {
    std::filesystem::remove(folder / more[1]);
    Run run(folder, is_asked_for ? joined(all, {"+C"}) : all);
    std::error_code error;
    CHECK(comes_true([&] { return std::filesystem::file_size(rows, error) > least && !error; }));
    if (is_asked_for)
      run.send(SIGKILL);
    else
      run.interrupt();
    stopped = run.finish();
    CAPTURE(more, is_asked_for, stopped.err);
    CHECK(stopped.exit_code == (is_asked_for ? 128 + SIGKILL : 2));
    CHECK(std::filesystem::exists(folder / more[1]) == !is_asked_for);
    if (!is_asked_for) CHECK_THAT(stopped.err, Contains("missing rows: "));
    resumed = celltrace_run(folder, joined(all, {"+C", "--stats", "resumed.json"}));
    if (resumed.err.find(" rows to go") != resumed.err.npos) break;
  }
  CAPTURE(resumed.err);
  CHECK(resumed.exit_code == 0);
  CHECK_THAT(resumed.err, Contains(" of 1300 rows to go"));
  const auto rays = [&](const char* file) {
    return nlohmann::json::parse(read_bytes(folder / file))["rays"]["primary"].get<std::uint64_t>();
  };
  CHECK(rays("resumed.json") < rays("whole.json"));
  CHECK((read_bytes(folder / more[1]) == whole)); // too long to be shown
  CHECK_FALSE(std::filesystem::exists(rows));
}

TEST_CASE("frames of an animation may be posters") {
  const TemporaryFolder folder;
  write_scene(folder);
  const Outcome outcome = celltrace_run(
      folder, {"s.pov", "+W4200", "+H4200", "+SR2100", "+ER2101", "+KFF2", "-o", "f.png", "--quiet"});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(load_image(folder / "f1.png").pixel(2000, 2100)[1] != 0);
  CHECK((read_bytes(folder / "f1.png") == read_bytes(folder / "f2.png")));
}
