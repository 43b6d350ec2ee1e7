// Scenes made to exhaust, confuse or break out of the program. Each begins with the first line of the error
// that it is to end with, and perhaps with arguments:
//
//   // expect: NAME.pov:3:1: error: ...
//   // arguments: --max loop-steps=1000
//
// A * in the expected line is a number that differs between builds, like where memory runs out.
// What cannot begin so has the lines in NAME.expect.
#include "files.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace celltrace::test;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMemory = 200u << 20;
/// Each takes less than one, on a machine that has nothing else to do.
constexpr unsigned kSeconds = 10;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSanitized = true;
#elif defined(__has_feature)
constexpr bool kIsSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool kIsSanitized = false;
#endif

/// What follows "// KEY: " in the first lines; a line ends with CR or LF.
std::string header(const std::string& text, const std::string& key) {
  const std::string start = "// " + key + ": ";
  const std::size_t at = text.substr(0, 1000).find(start);
  if (at == text.npos) return {};
  return text.substr(at + start.size(), text.find_first_of("\r\n", at) - at - start.size());
}

/// Whether the line is the expected one, where a * stands for one or more digits.
bool matches(const std::string& line, const std::string& expected) {
  const std::size_t star = expected.find('*');
  if (star == expected.npos) return line == expected;
  if (line.compare(0, star, expected, 0, star) != 0) return false;
  const std::size_t after = std::min(line.find_first_not_of("0123456789", star), line.size());
  return after > star && line.substr(after) == expected.substr(star + 1);
}

struct Ending {
  int status = 0;
  rusage use{};
  std::string error;
};

Ending run(const fs::path& scene, const std::string& more, const TemporaryFolder& out) {
  std::vector<std::string> arguments = {"celltrace", scene.filename().string(),     "-W", "8", "-H", "8",
                                        "-o",        (out / "picture.ppm").string()};
  std::istringstream words(more);
  for (std::string word; words >> word;)
    arguments.push_back(word == "OUT" ? out.path().string() : word);
  std::vector<char*> argv;
  for (std::string& argument : arguments)
    argv.push_back(argument.data());
  argv.push_back(nullptr);
  const std::string folder = scene.parent_path().string(), errors = (out / "stderr.txt").string();
  const pid_t child = fork();
  if (child == 0) {
    const rlimit memory{kMemory, kMemory}, time{kSeconds, kSeconds};
    const int file = open(errors.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    if (chdir(folder.c_str()) == 0 && dup2(file, STDERR_FILENO) >= 0 &&
        (kIsSanitized || setrlimit(RLIMIT_DATA, &memory) == 0) &&
        (kIsSanitized || setrlimit(RLIMIT_CPU, &time) == 0))
      execv(CELLTRACE_PROGRAM, argv.data());
    _exit(127);
  }
  Ending ending;
  wait4(child, &ending.status, 0, &ending.use);
  ending.error = read_bytes(out / "stderr.txt");
  return ending;
}

std::vector<fs::path> scenes() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(CELLTRACE_SOURCE_DIR "/tests/hostile/scenes"))
    if (entry.path().extension() == ".pov") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

} // namespace

TEST_CASE("hostile scenes each end in one message, soon and in little memory") {
  const std::vector<fs::path> all = scenes();
  REQUIRE(all.size() >= 40);
  for (const fs::path& scene : all) {
    const TemporaryFolder out;
    fs::path sidecar = scene;
    sidecar.replace_extension(".expect");
    const std::string head = read_bytes(fs::exists(sidecar) ? sidecar : scene);
    const std::string expected = header(head, "expect");
    const Ending ending = run(scene, header(head, "arguments"), out);
    CAPTURE(scene.filename().string(), ending.error.substr(0, 1000), ending.status);
    REQUIRE_FALSE(expected.empty());
    CHECK(WIFEXITED(ending.status));
    CHECK(WEXITSTATUS(ending.status) == 1);
    // The error's line; warnings may come before it.
    const std::size_t first = ending.error.find("error: ");
    const std::size_t begin = first == ending.error.npos ? 0 : ending.error.rfind('\n', first) + 1;
    const std::string line = ending.error.substr(begin, ending.error.find('\n', begin) - begin);
    CAPTURE(line, expected);
    CHECK(matches(line, expected));
    CHECK((first == ending.error.npos || ending.error.find("error: ", first + 1) == ending.error.npos));
    CHECK(ending.error.size() < 2000);
    CHECK_FALSE(fs::exists(out / "picture.ppm"));
    if (!kIsSanitized) CHECK(static_cast<std::size_t>(ending.use.ru_maxrss) * 1024 < kMemory);
  }
}
