// Shared state of the answers to calls for help, and the tables of these answers.
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

/// The state of all files and memory. Thread safety: none; PpeCalls serializes.
struct PpeState {
  explicit PpeState(PpeCallsConfig config);

  std::chrono::microseconds now() const;

  /// Opens a file of the host. The mode is POSIX's; flags are the host's.
  std::shared_ptr<HostFile> open(std::string_view name, int host_flags, unsigned mode) const;

  /// Makes a new file whose name is `prefix` and six characters that end in a number. Throws CallFailed.
  /// @param name receives the name
  std::shared_ptr<HostFile> make_temporary(std::string_view prefix, std::string& name);
  /// Returns a name as for make_temporary(), without making the file.
  std::string temporary_name(std::string_view prefix);

  /// Returns memory that a program may use by effective address. Throws EFAULT.
  std::span<std::uint8_t> effective_memory(std::uint64_t ea, std::uint64_t bytes) const;

  PpeCallsConfig config;
  AllowedFolders folders;
  OpenFiles files;
  Streams streams;
  EaHeap ea_heap;
  std::vector<std::unique_ptr<ListedFolder>> listed_folders; ///< index: the program's number for them, from 1
  unsigned umask = 022;
  unsigned temporary_files = 0; ///< number of files made so far
};

/// One operation. Its answer may throw CallFailed.
struct PpeCall {
  enum class OnFailure { minus_one, zero };

  CallResult (*answer)(PpeState&, const CallArguments&) = nullptr; ///< null: ENOSYS
  OnFailure on_failure = OnFailure::minus_one;
};

/// Return the calls by operation; entry 0 is none.
std::span<const PpeCall> c99_calls();
std::span<const PpeCall> posix_calls();
std::span<const PpeCall> memory_calls();

/// mmap_ea() and related calls, which are POSIX operations.
CallResult map_memory(PpeState&, const CallArguments&);
CallResult remap_memory(PpeState&, const CallArguments&);
CallResult synchronize_memory(PpeState&, const CallArguments&);
CallResult unmap_memory(PpeState&, const CallArguments&);

/// Answers a system call of Linux. Its number and its six arguments are doublewords at `block`; the result
/// replaces the number: a value, or -errno.
void answer_linux_call(PpeState& state, const LocalStoreView& local_store, std::uint32_t block);

} // namespace celltrace::cell_emu
