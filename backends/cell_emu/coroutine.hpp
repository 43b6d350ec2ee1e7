// A stack of its own for a program that takes turns with others on one thread. On a SwitchedStack, with the
// address and thread sanitizers and the exception machinery told of every switch.
#pragma once

#include <functional>
#include <memory>

namespace celltrace::cell_emu {

/// Thread safety: one thread runs a coroutine and everything it takes turns with.
class Coroutine {
public:
  /// Bytes of stack: what runs on an SPE is small, but may be a test with its assertions.
  static constexpr std::size_t kStackBytes = 1024 * 1024;

  /// `body` starts with the first resume() and may not let an exception out.
  explicit Coroutine(std::function<void()> body);
  /// The body must have ended.
  ~Coroutine();
  Coroutine(const Coroutine&) = delete;
  Coroutine& operator=(const Coroutine&) = delete;

  /// Runs the body until it suspends or ends. Not from inside a coroutine.
  void resume();
  /// From the body: back to where resume() was called.
  void suspend();
  bool ended() const;

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// A pointer that every thread and every coroutine has for itself; null at first.
void*& stack_local();

} // namespace celltrace::cell_emu
