// Interfaces to tools that check each memory access of a program that runs under them: the address
// sanitizer, which the program may be built with though this library is not, and Valgrind's memcheck. Both
// tools report accesses to forbidden bytes at the line of the access. Neither tells loads from stores.
//
// The address sanitizer marks units of 8 bytes, and cannot forbid a part of one; Valgrind marks bytes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace celltrace::cell_emu {

bool runs_under_address_sanitizer();
bool runs_under_valgrind();
bool has_access_checker();

/// Makes the tool report every access of the program to the bytes. Without a tool, does nothing.
void forbid_access(const std::uint8_t* at, std::size_t bytes);
void permit_access(const std::uint8_t* at, std::size_t bytes);
/// Returns whether no byte is forbidden.
bool may_access(const std::uint8_t* at, std::size_t bytes);

/// Declares bytes as set that the emulator derived from the program's bytes, some of which may be
/// uninitialised.
void settle(const void* at, std::size_t bytes);

/// Silences Valgrind on this thread while the emulator itself uses forbidden or uninitialised bytes.
class UncheckedScope {
public:
  UncheckedScope();
  ~UncheckedScope();
  UncheckedScope(const UncheckedScope&) = delete;
  UncheckedScope& operator=(const UncheckedScope&) = delete;
};

/// Tells the tools about a stack that they cannot know.
class CheckedStack {
public:
  CheckedStack(const void* bottom, std::size_t bytes);
  ~CheckedStack();
  CheckedStack(const CheckedStack&) = delete;
  CheckedStack& operator=(const CheckedStack&) = delete;

  // Call these around each switch: the first two on the side that leaves, the others on the side that
  // arrives.
  void before_enter();
  void before_leave(bool for_good);
  void after_enter();
  void after_leave();

private:
  // The tools that the build supports decide which of these members are used.
  [[maybe_unused]] const void* bottom_;
  [[maybe_unused]] std::size_t bytes_;
  [[maybe_unused]] unsigned valgrind_id_ = 0;
  [[maybe_unused]] void* callers_fake_stack_ = nullptr;
  [[maybe_unused]] void* own_fake_stack_ = nullptr;
  [[maybe_unused]] const void* callers_bottom_ = nullptr;
  [[maybe_unused]] std::size_t callers_bytes_ = 0;
};

} // namespace celltrace::cell_emu
