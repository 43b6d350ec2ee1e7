// PpeState, the state of PpeCalls that all calls share, and the tables of functions that execute calls.
#pragma once

#include "backends/cell_emu/simulator/ppe/allowed_folders.hpp"
#include "backends/cell_emu/simulator/ppe/call_arguments.hpp"
#include "backends/cell_emu/simulator/ppe/ea_heap.hpp"
#include "backends/cell_emu/simulator/ppe/open_files.hpp"
#include "backends/cell_emu/simulator/ppe_calls.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace celltrace::cell_emu {

/// A folder that is being listed.
struct ListedFolder {
  struct Entry {
    std::uint32_t inode;
    std::string name;
  };
  std::vector<Entry> entries; ///< sorted by name
  std::size_t next = 0;
};

/// Files, folders and main memory of all programs. Thread safety: none; PpeCalls executes one call at a time.
struct PpeState {
  explicit PpeState(PpeCallsConfig config);

  std::chrono::microseconds now() const;

  /// Opens a file of the host. `host_flags` are the host's flags of open(), `mode` is POSIX's.
  std::shared_ptr<HostFile> open(std::string_view name, int host_flags, unsigned mode) const;

  /// Makes a new file whose name is `prefix` followed by six characters that end in a number. Throws
  /// CallFailed.
  /// @param name receives the name
  std::shared_ptr<HostFile> make_temporary(std::string_view prefix, std::string& name);
  /// Returns a name as make_temporary() would use, without making the file.
  std::string temporary_name(std::string_view prefix);

  /// Returns the memory of [ea, ea + bytes). Throws CallFailed with EFAULT if a program may not use it.
  std::span<std::uint8_t> effective_memory(std::uint64_t ea, std::uint64_t bytes) const;

  PpeCallsConfig config;
  AllowedFolders folders;
  OpenFiles files;
  Streams streams;
  EaHeap ea_heap;
  /// Folders that programs list; the folder with the program's number n has index n - 1.
  std::vector<std::unique_ptr<ListedFolder>> listed_folders;
  unsigned umask = 022;
  unsigned temporary_files = 0; ///< number of files made so far
};

/// A call, with the function that executes it and may throw CallFailed.
struct PpeCall {
  enum class OnFailure { minus_one, zero };

  CallResult (*answer)(PpeState&, const CallArguments&) = nullptr; ///< null: ENOSYS
  OnFailure on_failure = OnFailure::minus_one;
};

/// Return the calls by the number of their operation; entry 0 is no call.
std::span<const PpeCall> c99_calls();
std::span<const PpeCall> posix_calls();
std::span<const PpeCall> memory_calls();

/// Execute mmap_ea() and related calls, which have POSIX operation numbers.
CallResult map_memory(PpeState&, const CallArguments&);
CallResult remap_memory(PpeState&, const CallArguments&);
CallResult synchronize_memory(PpeState&, const CallArguments&);
CallResult unmap_memory(PpeState&, const CallArguments&);

/// Executes a system call of Linux. Its number and its six arguments are doublewords at `block`. The result,
/// a value or -errno, replaces the number.
void answer_linux_call(PpeState& state, const LocalStoreView& local_store, std::uint32_t block);

} // namespace celltrace::cell_emu
