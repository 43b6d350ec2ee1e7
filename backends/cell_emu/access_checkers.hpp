// Interfaces to tools that check each memory access of a program: the address sanitizer, also if the program
// is built with it but this library is not, and Valgrind's memcheck. Both tools report accesses to forbidden
// bytes, with the line of the access. Neither tool tells loads from stores.
//
// The address sanitizer marks units of 8 bytes, and cannot forbid a part of a unit; Valgrind marks bytes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace celltrace::cell_emu {

bool runs_under_address_sanitizer();
bool runs_under_valgrind();
bool has_access_checker();

/// Make the tool report, or no longer report, every access of the program to `bytes` bytes. Without a tool,
/// do nothing.
void forbid_access(const std::uint8_t* at, std::size_t bytes);
void permit_access(const std::uint8_t* at, std::size_t bytes);
/// Returns true if none of the bytes is forbidden.
bool may_access(const std::uint8_t* at, std::size_t bytes);

/// Declares bytes as initialised. For bytes that the emulator has derived from the program's bytes, some of
/// which may be uninitialised.
void settle(const void* at, std::size_t bytes);

/// Silences Valgrind on this thread while the emulator itself uses forbidden or uninitialised bytes.
class UncheckedScope {
public:
  UncheckedScope();
  ~UncheckedScope();
  UncheckedScope(const UncheckedScope&) = delete;
  UncheckedScope& operator=(const UncheckedScope&) = delete;
};

/// Tells the tools about a stack that the emulator has made and switches to.
class CheckedStack {
public:
  CheckedStack(const void* bottom, std::size_t bytes);
  ~CheckedStack();
  CheckedStack(const CheckedStack&) = delete;
  CheckedStack& operator=(const CheckedStack&) = delete;

  // Call these functions around each switch of stacks: before_... on the stack that is left, after_... on the
  // stack that is entered.
  void before_enter();
  void before_leave(bool for_good);
  void after_enter();
  void after_leave();

private:
  // Each member is used only if the build supports the tool that needs it.
  [[maybe_unused]] const void* bottom_;
  [[maybe_unused]] std::size_t bytes_;
  [[maybe_unused]] unsigned valgrind_id_ = 0;
  [[maybe_unused]] void* callers_fake_stack_ = nullptr;
  [[maybe_unused]] void* own_fake_stack_ = nullptr;
  [[maybe_unused]] const void* callers_bottom_ = nullptr;
  [[maybe_unused]] std::size_t callers_bytes_ = 0;
};

} // namespace celltrace::cell_emu
