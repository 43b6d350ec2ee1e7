// Coroutine: a function with a stack of its own that takes turns with other coroutines on one thread. A
// coroutine runs on a SwitchedStack, and informs the address and thread sanitizers and the C++ exception
// runtime of every switch.
#pragma once

#include <functional>
#include <memory>

namespace celltrace::cell_emu {

/// A coroutine. Thread safety: one thread runs a coroutine and everything it takes turns with.
class Coroutine {
public:
  /// Bytes of stack. SPE code needs little, but a test with its assertions may need much.
  static constexpr std::size_t kStackBytes = 1024 * 1024;

  /// `body` starts with the first resume() and may not let an exception out.
  explicit Coroutine(std::function<void()> body);
  /// Destroys the coroutine, whose body must have ended.
  ~Coroutine();
  Coroutine(const Coroutine&) = delete;
  Coroutine& operator=(const Coroutine&) = delete;

  /// Runs the body until it suspends or ends. Must not be called from inside a coroutine.
  void resume();
  /// Returns from the body to the caller of resume().
  void suspend();
  bool ended() const;

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Returns a pointer of which every thread and every coroutine has its own; null at first.
void*& stack_local();

} // namespace celltrace::cell_emu
