// The PPE's part of the C library of a program for the SPU: answers the program's calls for help.
//
// Most of the SPU's C library (newlib, or the one of IBM's SDK) consists of stubs that stop with a code of
// 0x21xx; the word behind the stop has the operation and the address of the arguments. On a Cell libspe2 and
// the kernel answer. This file does the same, except for calls that would reach the host beyond the allowed
// folders, or would differ from run to run.
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

/// The resources that the programs of one machine may use.
struct PpeCallsConfig {
  using Output = std::function<void(std::string_view)>;

  /// Called with every piece of text as it is written, from the thread that the SPE is on, one at a time. Its
  /// exceptions leave handle(). Empty: the text is dropped.
  Output standard_output, standard_error;
  std::string standard_input;
  /// Returns the next piece when all input has been read, "" at the end. Empty: there is no more.
  std::function<std::string()> more_input;

  /// Folders of the host whose files may be read and written, with everything below them. Relative names
  /// start at the first one. Without folders, every file is refused with EACCES.
  std::vector<std::filesystem::path> folders;
  /// Limit on files that are open at once, besides the three standard ones, and on open folders.
  std::size_t max_open_files = 64;

  /// Limit on the main memory that malloc_ea() and related calls allocate in all.
  std::uint64_t max_ea_bytes = 256 << 20;

  /// Returns the memory at an effective address outside of malloc_ea()'s blocks, such as in a local store, if
  /// a program may use all of [ea, ea + bytes), else null. Empty: none may be used.
  std::function<std::uint8_t*(std::uint64_t ea, std::uint64_t bytes)> effective_memory;

  /// Returns the time since 1970; with a virtual time, runs can be repeated. Empty: the time stands still at
  /// the first second of 2007.
  std::function<std::chrono::microseconds()> clock;
  /// True: time_t has 32 bits, as in programs of IBM's SDK. False: 64 bits, as in the present newlib.
  bool time_has_32_bits = false;
};

/// The answers for all SPEs of a machine, which share files, streams and main memory.
/// Thread safety: handle() may be called from several threads; calls are answered one after the other.
class PpeCalls {
public:
  /// Throws InputError for a folder that does not exist.
  explicit PpeCalls(PpeCallsConfig config = {});
  ~PpeCalls(); ///< closes all files, frees all memory that programs allocated

  /// Answers the call that a stop with this code makes. Everything in local store is checked: no argument
  /// makes it read or write outside, or work for longer than in proportion to local store and files.
  /// @param code 0x2100 (C99), 0x2101 (POSIX), 0x2104 (Linux) or 0x2105 (main memory)
  /// @param local_store 256 KB, the results are written there
  /// @param npc the address of the word behind the stop; the program goes on behind that word
  /// @return false, and does nothing, if the code is no such call
  bool handle(unsigned code, std::uint8_t* local_store, std::uint32_t npc);

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace celltrace::cell_emu
