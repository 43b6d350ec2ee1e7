// --sandbox: what a process cannot do any more.
#include "celltrace/error.hpp"
#include "cli/sandbox.hpp"
#include "files.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace celltrace;
using namespace celltrace::cli;
using namespace celltrace::test;

namespace {

constexpr int kFailed = 1, kNoSandbox = 77;

/// Runs a check in a process of its own, in the sandbox. None: this system has none.
bool holds(const SandboxFiles& files, const std::function<bool()>& check) {
  const pid_t child = fork();
  if (child == 0) {
    try {
      enter_sandbox(files);
    } catch (const Error&) {
      _exit(kNoSandbox);
    }
    _exit(check() ? 0 : kFailed);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNoSandbox) {
    WARN("skipped: this build or kernel has no sandbox");
    return true;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool opens(const std::filesystem::path& path, int flags) {
  const int file = open(path.c_str(), flags, 0600);
  if (file >= 0) close(file);
  return file >= 0;
}

} // namespace

TEST_CASE("in the sandbox only files are opened that are named") {
  const TemporaryFolder in, out, other;
  for (const TemporaryFolder* folder : {&in, &out, &other})
    std::ofstream(*folder / "a.txt") << "text";
  const SandboxFiles files = {{in.path()}, {out.path()}};
  CHECK(holds(files, [&] { return opens(in / "a.txt", O_RDONLY); }));
  CHECK(holds(files, [&] { return !opens(in / "a.txt", O_WRONLY); }));
  CHECK(holds(files, [&] { return !opens(in / "new.txt", O_WRONLY | O_CREAT); }));
  CHECK(holds(files, [&] { return opens(out / "new.txt", O_WRONLY | O_CREAT); }));
  CHECK(holds(files, [&] {
    return rename((out / "new.txt").c_str(), (out / "a.txt").c_str()) == 0 &&
           unlink((out / "a.txt").c_str()) == 0;
  }));
  CHECK(holds(files, [&] { return !opens(other / "a.txt", O_RDONLY); }));
  CHECK(holds(files, [&] { return !opens("/etc/passwd", O_RDONLY); }));
  CHECK(holds(files, [&] { return unlink((in / "a.txt").c_str()) != 0; }));
}

TEST_CASE("in the sandbox there are threads, but no processes and no network") {
  const SandboxFiles none;
  CHECK(holds(none, [] {
    bool ran = false;
    std::thread([&] { ran = true; }).join();
    return ran;
  }));
  CHECK(holds(none, [] {
    const pid_t child = fork();
    if (child == 0) _exit(0);
    return child < 0;
  }));
  CHECK(holds(none, [] {
    execl("/bin/false", "false", nullptr);
    return true; // it has come back
  }));
  CHECK(holds(none, [] { return socket(AF_INET, SOCK_STREAM, 0) < 0; }));
  CHECK(holds(none, [] { return socket(AF_UNIX, SOCK_STREAM, 0) < 0; }));
}

TEST_CASE("a render names what it needs") {
  const TemporaryFolder scenes, pictures, reports, library;
  RenderRequest request;
  request.scene = scenes / "s.pov";
  request.output = pictures / "s.png";
  request.stats = (reports / "s.json").string();
  request.library_paths = {library.path(), "nowhere"};
  const SandboxFiles files = sandbox_files(request);
  const auto has = [](const std::vector<std::filesystem::path>& all, const std::filesystem::path& path) {
    return std::find(all.begin(), all.end(), path) != all.end();
  };
  CHECK(has(files.readable, scenes.path()));
  CHECK(has(files.readable, library.path()));
  CHECK_FALSE(has(files.readable, "nowhere"));
  CHECK(has(files.writable, std::filesystem::canonical(pictures.path())));
  CHECK(has(files.writable, std::filesystem::canonical(reports.path())));
  CHECK_FALSE(has(files.readable, pictures.path()));
  request.output = request.stats = "-";
  CHECK(sandbox_files(request).writable.empty());
}
