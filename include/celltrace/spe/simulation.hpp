// What `cell_sim`, which executes machine code, is told besides: what its programs may ask of the PPE, and
// what is recorded of them.
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

/// Where the cycles of a program went, word by word of local store. Programs that replace their code share
/// the words. Thread safety: several SPEs may add at once; read it when none runs.
class CELLTRACE_EXPORT SpuProfile {
public:
  struct Word {
    std::uint64_t hits = 0;   ///< times that the instruction was issued
    std::uint64_t cycles = 0; ///< from the issue before until its own, and what its channel stalled
    std::uint64_t dual = 0;   ///< issues together with the instruction before it
    // Of the cycles: by what kept it.
    std::uint64_t dependency = 0, branch_miss = 0, prefetch_miss = 0, hint_target = 0, fp_resource = 0,
                  channel = 0;
    std::uint32_t instruction = 0; ///< the word as it was last executed
  };

  static constexpr std::uint32_t kWords = 65536;

  /// Adds what one SPE's program did, `kWords` words.
  void add(const std::vector<Word>& words);
  /// By word of local store; empty before any program has run.
  const std::vector<Word>& words() const { return words_; }

private:
  std::mutex mutex_;
  std::vector<Word> words_;
};

/// For `cell_sim`.
struct SimulationConfig {
  /// Take what programs write to their standard output and error output, in pieces; null: it is dropped.
  /// Called by one thread at a time.
  std::function<void(std::string_view)> output, error_output;
  /// argv of stand-alone programs, from argv[0], the program's name, on. A program that is linked with
  /// -mstdmain finds it in its local store, as main(argc, argv). For any other, where there is more than
  /// argv[0], argp is the effective address of an argv as a PPE of 64 bits has it (big-endian effective
  /// addresses of strings, and a 0) instead of what Machine::start() was given.
  std::vector<std::string> arguments;
  /// What programs read from their standard input, and what gives more when they have read it all: pieces, ""
  /// at the end; null: there is no more. Called by one thread at a time.
  std::string input;
  std::function<std::string()> more_input;
  /// The folders whose files programs may open, read, write, make and remove; none: no files.
  std::vector<std::filesystem::path> allowed_folders;
  /// Where the cycles of all programs are added up; it must outlive the machine. Null: nowhere.
  SpuProfile* profile = nullptr;
};

} // namespace celltrace
