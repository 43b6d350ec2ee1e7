// Further options of `cell_sim`, which executes machine code: the PPE services for its programs, and
// profiles.
#pragma once

#include "celltrace/export.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace {

/// The cycles of programs, by word of local store. Programs that replace their code share
/// the words. Thread safety: several SPEs may add at once; read it when none runs.
class CELLTRACE_EXPORT SpuProfile {
public:
  struct Word {
    std::uint64_t hits = 0;   ///< times that the instruction was issued
    std::uint64_t cycles = 0; ///< cycles from the issue before to its own, plus the stall of its channel
    std::uint64_t dual = 0;   ///< issues together with the instruction before it
    // Parts of `cycles`, by the cause of the delay.
    std::uint64_t dependency = 0, branch_miss = 0, prefetch_miss = 0, hint_target = 0, fp_resource = 0,
                  channel = 0;
    std::uint32_t instruction = 0; ///< the word as it was last executed
  };

  static constexpr std::uint32_t kWords = 65536;

  /// Adds the counts of one SPE's program, `kWords` words.
  void add(const std::vector<Word>& words);
  /// Returns the counts by word of local store; empty before any program has run.
  const std::vector<Word>& words() const { return words_; }

private:
  std::mutex mutex_;
  std::vector<Word> words_;
};

/// Options of `cell_sim`.
struct SimulationConfig {
  /// Receive the text that programs write to their standard output and error output, in pieces; null: it is
  /// dropped. Called by one thread at a time.
  std::function<void(std::string_view)> output, error_output;
  /// argv of stand-alone programs, from argv[0], the program's name, on. A program that is linked with
  /// -mstdmain finds it in its local store, as main(argc, argv). For any other program, if there is more than
  /// argv[0], argp is the effective address of an argv in the format of a 64-bit PPE (big-endian effective
  /// addresses of strings, and a 0) instead of the argument of Machine::start().
  std::vector<std::string> arguments;
  /// Standard input of programs, and a function that returns further pieces when they have read it all, "" at
  /// the end; null: there is no more. Called by one thread at a time.
  std::string input;
  std::function<std::string()> more_input;
  /// Folders in which programs may open, read, write, make and remove files; none: no files.
  std::vector<std::filesystem::path> allowed_folders;
  /// Receives the cycles of all programs; must outlive the machine. Null: no profile.
  SpuProfile* profile = nullptr;
};

} // namespace celltrace
