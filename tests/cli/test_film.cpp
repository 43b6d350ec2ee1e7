// Films, rendered as users render them.
#include "cli/program_run.hpp"

#include <cstdlib>

using namespace celltrace::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::vector<std::string> kFilm = {"s.pov", "+W10", "+H6", "+KFF3"};
constexpr std::size_t kFrameBytes = 6 + 3 * 10 * 6;

void write_scene(const TemporaryFolder& folder) {
  write_bytes(folder / "s.pov", "camera { location -4*z look_at 0 } light_source { <3, 4, -5>, 1 }\n"
                                "sphere { <clock, 0, 0>, 1 pigment { rgb <1, 0.5, 0.2> } }\n");
}

Outcome film(const TemporaryFolder& folder, std::vector<std::string> more) {
  more.insert(more.begin(), kFilm.begin(), kFilm.end());
  return celltrace_run(folder, more);
}

/// Programs are looked for here only, while it is there.
class SearchPath {
public:
  explicit SearchPath(const std::string& path) : old_(std::getenv("PATH")) {
    setenv("PATH", path.c_str(), 1);
  }
  ~SearchPath() { setenv("PATH", old_.c_str(), 1); }

private:
  std::string old_;
};

} // namespace

TEST_CASE("a film in Y4M is the same in a file and on stdout") {
  const TemporaryFolder folder;
  write_scene(folder);
  const Outcome file = film(folder, {"-o", "a.y4m", "--frame-rate", "30"});
  CAPTURE(file.err);
  CHECK(file.exit_code == 0);
  CHECK_THAT(file.err, StartsWith("a.y4m: 3 frames, 10x6"));
  const std::string bytes = read_bytes(folder / "a.y4m");
  const std::string header = "YUV4MPEG2 W10 H6 F30:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n";
  CHECK_THAT(bytes, StartsWith(header + "FRAME\n"));
  CHECK(bytes.size() == header.size() + 3 * kFrameBytes);
  const Outcome piped = film(folder, {"-o", "-", "--file-type", "y4m", "--frame-rate", "30"});
  CHECK(piped.exit_code == 0);
  CHECK(piped.out == bytes);
  CHECK(lines(piped.err) == 1);
  // One frame is a short film.
  CHECK(celltrace_run(folder, {"s.pov", "+W10", "+H6", "-o", "still.y4m", "--quiet"}).exit_code == 0);
  CHECK(read_bytes(folder / "still.y4m").size() > kFrameBytes);
}

TEST_CASE("a film that breaks off is as long as it came") {
  const TemporaryFolder folder;
  write_scene(folder);
  write_bytes(folder / "s.pov", read_bytes(folder / "s.pov") + "#if (frame_number = 3) nonsense #end\n");
  CHECK(film(folder, {"-o", "a.y4m"}).exit_code == 1);
  const std::string bytes = read_bytes(folder / "a.y4m");
  CHECK(bytes.size() == bytes.find('\n') + 1 + 2 * kFrameBytes);
}

TEST_CASE("a film that cannot be written is an error") {
  const TemporaryFolder folder;
  write_scene(folder);
  CHECK_THAT(film(folder, {"-o", "no/a.y4m"}).err,
             StartsWith("celltrace: error: no/a.y4m: cannot be written"));
  if (!std::filesystem::exists("/dev/full")) return;
  const std::string command = "cd '" + folder.path().string() +
                              "' && '" CELLTRACE_PROGRAM
                              "' s.pov +W10 +H6 +KFF3 --quiet -o - --file-type y4m 2>err.txt >/dev/full";
  CHECK(WEXITSTATUS(std::system(command.c_str())) == 1);
  CHECK_THAT(read_bytes(folder / "err.txt"),
             Contains("error: standard output") && Contains("cannot be written"));
}

TEST_CASE("other films are made by ffmpeg") {
  const TemporaryFolder folder;
  write_scene(folder);
  std::filesystem::create_directory(folder / "bin");
  const auto with_ffmpeg = [&](const std::string& script, const std::string& output) {
    write_bytes(folder / "bin/ffmpeg", "#!/bin/sh\n" + script);
    std::filesystem::permissions(folder / "bin/ffmpeg", std::filesystem::perms::owner_all);
    const SearchPath path((folder / "bin").string() + ":/usr/bin:/bin");
    return film(folder, {"-o", output});
  };
  REQUIRE(film(folder, {"-o", "a.y4m"}).exit_code == 0);
  // One that keeps what it reads.
  const Outcome made = with_ffmpeg("for last; do :; done\nexec cat >\"${last#file:}\"\n", "-a.mp4");
  CAPTURE(made.err);
  CHECK(made.exit_code == 0);
  CHECK(read_bytes(folder / "-a.mp4") == read_bytes(folder / "a.y4m"));

  const Outcome failed = with_ffmpeg("echo 'no such codec' >&2\nexit 3\n", "b.webm");
  CHECK(failed.exit_code == 1);
  CHECK_THAT(failed.err,
             Contains("no such codec") && Contains("b.webm: ffmpeg could not make the film (exit code 3)"));
  CHECK_FALSE(std::filesystem::exists(folder / "b.webm"));

  std::filesystem::remove(folder / "bin/ffmpeg");
  const SearchPath path((folder / "bin").string());
  const Outcome missing = film(folder, {"-o", "c.mkv"});
  CHECK(missing.exit_code == 1);
  CHECK(lines(missing.err) == 1);
  CHECK_THAT(missing.err, Contains("c.mkv: films of this kind are made by ffmpeg, which is not installed"));
}

TEST_CASE("the real ffmpeg makes films, where it is installed") {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) {
    WARN("there is no ffmpeg: skipped");
    return;
  }
  const TemporaryFolder folder;
  write_scene(folder);
  const Outcome outcome = film(folder, {"-o", "a.mkv"});
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(std::filesystem::file_size(folder / "a.mkv") > 100);
}
