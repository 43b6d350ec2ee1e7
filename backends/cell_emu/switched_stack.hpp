// SwitchedStack: a stack, with switches to it and back, by Boost.Context, or in builds without Boost by the
// system's <ucontext.h>, which is slower because it saves the signal mask at every switch.
#pragma once

#include <functional>
#include <utility>

#ifdef CELLTRACE_UCONTEXT
#include "celltrace/error.hpp"

#include <cstdint>
#include <sys/mman.h>
#include <ucontext.h>
#include <unistd.h>
#else
#include <boost/context/fiber.hpp>
#include <boost/context/protected_fixedsize_stack.hpp>
#endif

namespace celltrace::cell_emu {

#ifdef CELLTRACE_UCONTEXT

class SwitchedStack {
public:
  explicit SwitchedStack(std::size_t bytes)
      : guard_bytes_(static_cast<std::size_t>(getpagesize())), bytes_(bytes) {
    mapping_ =
        mmap(nullptr, guard_bytes_ + bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapping_ == MAP_FAILED || mprotect(mapping_, guard_bytes_, PROT_NONE) != 0)
      throw Error("no memory for a stack");
  }
  ~SwitchedStack() { munmap(mapping_, guard_bytes_ + bytes_); }
  SwitchedStack(const SwitchedStack&) = delete;
  SwitchedStack& operator=(const SwitchedStack&) = delete;

  const char* bottom() const { return static_cast<const char*>(mapping_) + guard_bytes_; }
  std::size_t bytes() const { return bytes_; }

  /// Sets the function that the first enter() calls; it must not throw.
  void start(std::function<void()> body) {
    body_ = std::move(body);
    getcontext(&own_);
    own_.uc_stack.ss_sp = static_cast<char*>(mapping_) + guard_bytes_;
    own_.uc_stack.ss_size = bytes_;
    own_.uc_link = &caller_;
    const auto address = reinterpret_cast<std::uintptr_t>(this);
    makecontext(&own_, reinterpret_cast<void (*)()>(run), 2, static_cast<unsigned>(address >> 32),
                static_cast<unsigned>(address));
  }
  /// Switches to the body until it leaves or ends.
  void enter() { swapcontext(&caller_, &own_); }
  /// Switches back, from the body.
  void leave() { swapcontext(&own_, &caller_); }
  bool ended() const { return ended_; }

private:
  /// Runs the body. The address of the SwitchedStack comes in two halves, because makecontext() only passes
  /// ints.
  static void run(unsigned high, unsigned low) {
    auto* const self = reinterpret_cast<SwitchedStack*>(static_cast<std::uintptr_t>(high) << 32 | low);
    self->body_();
    self->ended_ = true;
  }

  std::size_t guard_bytes_, bytes_;
  void* mapping_;
  std::function<void()> body_;
  ucontext_t own_, caller_;
  bool ended_ = false;
};

#else

class SwitchedStack {
public:
  explicit SwitchedStack(std::size_t bytes) : allocator_(bytes), stack_(allocator_.allocate()) {}

  const char* bottom() const { return static_cast<const char*>(stack_.sp) - stack_.size; }
  std::size_t bytes() const { return stack_.size; }

  /// Sets the function that the first enter() calls; it must not throw.
  void start(std::function<void()> body) {
    namespace context = boost::context;
    fiber_ = context::fiber(std::allocator_arg, context::preallocated(stack_.sp, stack_.size, stack_),
                            allocator_, [this, body = std::move(body)](context::fiber&& caller) {
                              caller_ = std::move(caller);
                              body();
                              return std::move(caller_);
                            });
  }
  /// Switches to the body until it leaves or ends.
  void enter() { fiber_ = std::move(fiber_).resume(); }
  /// Switches back, from the body.
  void leave() { caller_ = std::move(caller_).resume(); }
  bool ended() const { return !fiber_; }

private:
  boost::context::protected_fixedsize_stack allocator_;
  boost::context::stack_context stack_;
  boost::context::fiber fiber_;
  boost::context::fiber caller_;
};

#endif

} // namespace celltrace::cell_emu
