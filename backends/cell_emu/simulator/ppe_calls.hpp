// PpeCalls executes, as the PPE would, functions of the SPU's C library that the library leaves to the PPE.
//
// Most of the SPU's C library (newlib, or the library of IBM's SDK) consists of stubs that stop with a code
// of 0x21xx; the word behind the stop has the operation and the address of the arguments. On a Cell, libspe2
// and the operating system execute the call. PpeCalls does the same, but refuses calls that would reach the
// host beyond the allowed folders, and changes calls whose results would differ from run to run.
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

  /// Receive every piece of text when it is written. Called by the SPE's thread, one call at a time.
  /// Exceptions of these functions pass through handle(). Empty: the text is dropped.
  Output standard_output, standard_error;
  std::string standard_input;
  /// Returns further input when all input has been read, "" at the end. Empty: there is no further input.
  std::function<std::string()> more_input;

  /// Folders of the host whose files may be read and written, with everything below them. Relative names are
  /// relative to the first folder. Without folders, every file is refused with EACCES.
  std::vector<std::filesystem::path> folders;
  /// Limit of files that are open at once, besides the three standard streams, and of folders that are open
  /// at once.
  std::size_t max_open_files = 64;

  /// Limit in bytes of main memory for malloc_ea() and related calls, for all blocks together.
  std::uint64_t max_ea_bytes = 256 << 20;

  /// Returns the host's address of effective address `ea` if a program may use all of [ea, ea + bytes), else
  /// null. Called for addresses outside of malloc_ea()'s blocks, such as addresses in a local store. Empty:
  /// no such memory may be used.
  std::function<std::uint8_t*(std::uint64_t ea, std::uint64_t bytes)> effective_memory;

  /// Returns the time since 1970. If this time is virtual, runs can be repeated. Empty: the time is always
  /// the first second of 2007.
  std::function<std::chrono::microseconds()> clock;
  /// True: time_t has 32 bits, as in programs of IBM's SDK; false: 64 bits, as in the present newlib.
  bool time_has_32_bits = false;
};

/// The calls of all SPEs of a machine, which share files, streams and main memory. Thread safety: handle()
/// may be called from several threads; calls are executed one after the other.
class PpeCalls {
public:
  /// Throws InputError for a folder that does not exist.
  explicit PpeCalls(PpeCallsConfig config = {});
  ~PpeCalls(); ///< closes all files, frees all memory that programs allocated

  /// Executes the call that a stop with this code makes. All data in local store are checked: whatever the
  /// arguments, no memory outside is read or written, and time is at most proportional to the sizes of local
  /// store and files.
  /// @param code 0x2100 (C99), 0x2101 (POSIX), 0x2104 (Linux) or 0x2105 (main memory)
  /// @param local_store 256 KB, the results are written there
  /// @param npc the address of the word behind the stop, which describes the call; the program continues
  /// behind it
  /// @return false, and does nothing, if the code is no such call
  bool handle(unsigned code, std::uint8_t* local_store, std::uint32_t npc);

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace celltrace::cell_emu
