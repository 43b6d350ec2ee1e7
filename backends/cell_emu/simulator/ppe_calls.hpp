// The PPE's part of the C library of a program for the SPU: the answers to its calls for help.
//
// Most of the SPU's C library (newlib, or the one of IBM's SDK) is a stub that stops with a code of 0x21xx;
// the word behind the stop says what is wanted and where the arguments lie. On a Cell libspe2 and the kernel
// answer. What they do is done here, but for what would reach the host beyond the folders that were allowed,
// or would differ from run to run.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cell_emu {

/// What the programs of one machine may use.
struct PpeCallsConfig {
  using Output = std::function<void(std::string_view)>;

  /// Called with every piece as it is written, from whichever thread the SPE is on, one at a time. What it
  /// throws leaves handle(). Empty: the text is dropped.
  Output standard_output, standard_error;
  std::string standard_input;
  /// Gives what follows, when that has been read: a piece, "" at the end. Empty: nothing follows.
  std::function<std::string()> more_input;

  /// Folders of the host whose files may be read and written, with all that is below them. Names that are not
  /// absolute start at the first one. Without any, every file is refused with EACCES.
  std::vector<std::filesystem::path> folders;
  std::size_t max_open_files = 64; ///< at once, besides the three standard ones; and as many folders again

  /// Main memory for malloc_ea() and its like, all blocks together.
  std::uint64_t max_ea_bytes = 256 << 20;

  /// Where an effective address that no malloc_ea() returned lies, such as one of a local store, if a program
  /// may use all of [ea, ea + bytes), else null. Empty: none may be used.
  std::function<std::uint8_t*(std::uint64_t ea, std::uint64_t bytes)> effective_memory;

  /// Time since 1970. Runs repeat if it is virtual. Empty: it stands still at the first second of 2007.
  std::function<std::chrono::microseconds()> clock;
  /// time_t has 32 bits in programs of IBM's SDK and 64 in those of the present newlib.
  bool time_has_32_bits = false;
};

/// One for all SPEs of a machine: they share files, streams and main memory.
/// Thread safety: handle() may be called from several threads; calls are answered one after the other.
class PpeCalls {
public:
  /// Throws InputError for a folder that is none.
  explicit PpeCalls(PpeCallsConfig config = {});
  ~PpeCalls(); ///< closes all files, frees all memory that programs allocated

  /// Answers the call that a stop with this code makes. All that lies in local store is checked: no argument
  /// makes it read or write outside, or work for longer than in proportion to local store and files.
  /// @param code 0x2100 (C99), 0x2101 (POSIX), 0x2104 (Linux) or 0x2105 (main memory)
  /// @param local_store 256 KB, the results are written there
  /// @param npc the address of the word behind the stop; the program goes on behind that word
  /// @return false, and nothing is done, for what is no such call
  bool handle(unsigned code, std::uint8_t* local_store, std::uint32_t npc);

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace celltrace::cell_emu
