// The program, run as its users run it.
#pragma once

#include "files.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace celltrace::test {

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
  long peak_kilobytes = 0; ///< most memory that it had at a time
};

/// The name that the program is started by, and variables of the environment ("NAME=VALUE") besides the
/// test's own, which they replace.
struct Start {
  std::string name = "celltrace";
  std::vector<std::string> variables;
};

/// One run of celltrace in a folder of its own, with its output in files there. What it reads is in
/// stdin.txt, if that is there.
class Run {
public:
  Run(const TemporaryFolder& folder, std::vector<std::string> arguments, Start start = {}) : folder_(folder) {
    arguments.insert(arguments.begin(), start.name);
    std::vector<char*> variables;
    for (std::string& variable : start.variables)
      variables.push_back(variable.data());
    for (char** variable = environ; *variable != nullptr; ++variable) {
      const std::string name(*variable, std::strcspn(*variable, "=") + 1);
      if (std::none_of(start.variables.begin(), start.variables.end(),
                       [&](const std::string& own) { return own.rfind(name, 0) == 0; }))
        variables.push_back(*variable);
    }
    variables.push_back(nullptr);
    std::vector<char*> argv;
    for (std::string& argument : arguments)
      argv.push_back(argument.data());
    argv.push_back(nullptr);
    // posix_spawn() returns after the exec, so that no handler of the test program is taken for celltrace's.
    constexpr int kFlags = O_CREAT | O_TRUNC | O_WRONLY;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.path().c_str());
    const char* const input = std::filesystem::exists(folder / "stdin.txt") ? "stdin.txt" : "/dev/null";
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, input, O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "stdout.txt", kFlags, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "stderr.txt", kFlags, 0600);
    const int error = posix_spawn(&pid_, CELLTRACE_PROGRAM, &actions, nullptr, argv.data(), variables.data());
    posix_spawn_file_actions_destroy(&actions);
    REQUIRE(error == 0);
  }

  /// Waits until the program catches SIGINT and its threads run, then sends it or another signal.
  void interrupt(int signal = SIGINT, int times = 1) {
    while (!runs())
      std::this_thread::yield();
    for (int i = 0; i < times; ++i)
      kill(pid_, signal);
  }

  /// At once, whatever the program does.
  void send(int signal) { kill(pid_, signal); }

  Outcome finish() {
    int status = 0;
    rusage usage{};
    wait4(pid_, &status, 0, &usage);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            read_bytes(folder_ / "stdout.txt"), read_bytes(folder_ / "stderr.txt"), usage.ru_maxrss};
  }

private:
  bool runs() const {
    std::ifstream file("/proc/" + std::to_string(pid_) + "/status");
    unsigned long threads = 0, caught = 0;
    for (std::string line; std::getline(file, line);) {
      if (line.rfind("Threads:", 0) == 0) threads = std::stoul(line.substr(8));
      if (line.rfind("SigCgt:", 0) == 0) caught = std::stoul(line.substr(7), nullptr, 16);
      if (line.rfind("State:\tZ", 0) == 0) return true; // over already, as finish() will show
    }
    return threads > 1 && (caught >> (SIGINT - 1) & 1) != 0;
  }

  const TemporaryFolder& folder_;
  pid_t pid_ = -1;
};

inline Outcome celltrace_run(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                             const Start& start = {}) {
  return Run(folder, arguments, start).finish();
}

inline long lines(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

} // namespace celltrace::test
