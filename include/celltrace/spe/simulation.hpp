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

/// The cycles of programs, by word of local store. If programs overlay code, the cycles of all code at a word
/// are added up. Thread safety: several SPEs may add at once; read the profile when no SPE runs.
class CELLTRACE_EXPORT SpuProfile {
public:
  struct Word {
    std::uint64_t hits = 0; ///< times that the instruction was issued
    /// Cycles from the issue of the instruction before to this instruction's issue, plus the stall at its
    /// channel.
    std::uint64_t cycles = 0;
    /// Times that the instruction was issued together with the instruction before it.
    std::uint64_t dual = 0;
    // Parts of `cycles`, by the cause of the delay.
    std::uint64_t dependency = 0, branch_miss = 0, prefetch_miss = 0, hint_target = 0, fp_resource = 0,
                  channel = 0;
    std::uint32_t instruction = 0; ///< the instruction that the word held when it was last executed
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
  /// Receive the text that programs write to their standard output and error output, in pieces; null: the
  /// text is dropped. Called by one thread at a time.
  std::function<void(std::string_view)> output, error_output;
  /// Arguments (argv) of stand-alone programs, beginning with the program's name. A program that is linked
  /// with -mstdmain has main(argc, argv) and gets the arguments in its local store. Any other program, if
  /// there are arguments besides the name, gets as argp, in place of the argument of Machine::start(), the
  /// effective address of an argv in the format of a 64-bit PPE: big-endian effective addresses of strings,
  /// and a 0.
  std::vector<std::string> arguments;
  /// Standard input of programs, and a function that returns further input when programs have read all of
  /// `input`, "" at the end; null: there is no further input. Called by one thread at a time.
  std::string input;
  std::function<std::string()> more_input;
  /// Folders in which programs may open, read, write, make and remove files; none: no files.
  std::vector<std::filesystem::path> allowed_folders;
  /// Receives the cycles of all programs; must outlive the machine. Null: no profile.
  SpuProfile* profile = nullptr;
};

} // namespace celltrace
