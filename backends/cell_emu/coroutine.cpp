#include "backends/cell_emu/coroutine.hpp"

#include "backends/cell_emu/access_checkers.hpp"
#include "backends/cell_emu/switched_stack.hpp"

#include <cxxabi.h>
#include <utility>

#if defined(__SANITIZE_THREAD__)
#define CELLTRACE_HAS_TSAN 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define CELLTRACE_HAS_TSAN 1
#endif
#endif
#ifdef CELLTRACE_HAS_TSAN
#include <sanitizer/tsan_interface.h>
#endif

namespace celltrace::cell_emu {
namespace {

/// The stack_local() of the present stack.
thread_local void* running_stack_local = nullptr;

/// The exceptions that a thread is handling, in the layout of the C++ ABI. Each stack has its own.
struct ExceptionState {
  void* caught = nullptr;
  unsigned int uncaught = 0;
};

void exchange_exceptions(ExceptionState& state) {
  std::swap(*reinterpret_cast<ExceptionState*>(abi::__cxa_get_globals()), state);
}

} // namespace

class Coroutine::Impl {
public:
  explicit Impl(std::function<void()> body) : body_(std::move(body)) {
#ifdef CELLTRACE_HAS_TSAN
    tsan_fiber_ = __tsan_create_fiber(0);
#endif
    stack_.start([this] { run(); });
  }
  ~Impl() {
#ifdef CELLTRACE_HAS_TSAN
    __tsan_destroy_fiber(tsan_fiber_);
#endif
  }

  void resume() {
    exchange_exceptions(exceptions_);
    std::swap(running_stack_local, stack_local_);
#ifdef CELLTRACE_HAS_TSAN
    tsan_caller_ = __tsan_get_current_fiber();
    __tsan_switch_to_fiber(tsan_fiber_, 0);
#endif
    checked_.before_enter();
    stack_.enter();
    checked_.after_leave();
    std::swap(running_stack_local, stack_local_);
    exchange_exceptions(exceptions_);
  }

  void suspend() {
    leave(false);
    stack_.leave();
    checked_.after_enter();
  }

  bool ended() const {
    return stack_.ended();
  }

private:
  void run() {
    checked_.after_enter();
    body_();
    body_ = nullptr;
    leave(true);
  }

  void leave(bool for_good) {
#ifdef CELLTRACE_HAS_TSAN
    __tsan_switch_to_fiber(tsan_caller_, 0);
#endif
    checked_.before_leave(for_good);
  }

  std::function<void()> body_;
  SwitchedStack stack_{kStackBytes};
  CheckedStack checked_{stack_.bottom(), stack_.bytes()};
  ExceptionState exceptions_;
  void* stack_local_ = nullptr;
#ifdef CELLTRACE_HAS_TSAN
  void* tsan_fiber_ = nullptr;
  void* tsan_caller_ = nullptr;
#endif
};

Coroutine::Coroutine(std::function<void()> body) : impl_(std::make_unique<Impl>(std::move(body))) {
}
Coroutine::~Coroutine() = default;

void Coroutine::resume() {
  impl_->resume();
}
void Coroutine::suspend() {
  impl_->suspend();
}
bool Coroutine::ended() const {
  return impl_->ended();
}

// Not inlined: a coroutine that goes on on another thread must not use an address of the old thread's
// variable.
void*& stack_local() {
  return running_stack_local;
}

} // namespace celltrace::cell_emu
