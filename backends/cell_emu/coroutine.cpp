#include "backends/cell_emu/coroutine.hpp"

#include "backends/cell_emu/switched_stack.hpp"

#include <cxxabi.h>
#include <utility>

#if defined(__SANITIZE_ADDRESS__)
#define CELLTRACE_HAS_ASAN 1
#endif
#if defined(__SANITIZE_THREAD__)
#define CELLTRACE_HAS_TSAN 1
#endif
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CELLTRACE_HAS_ASAN 1
#endif
#if __has_feature(thread_sanitizer)
#define CELLTRACE_HAS_TSAN 1
#endif
#endif
#ifdef CELLTRACE_HAS_ASAN
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>
#endif
#ifdef CELLTRACE_HAS_TSAN
#include <sanitizer/tsan_interface.h>
#endif

namespace celltrace::cell_emu {
namespace {

/// That of the stack that is running.
thread_local void* running_stack_local = nullptr;

/// The exceptions that a thread has under way, as the C++ ABI lays them out. Each stack has its own.
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
#ifdef CELLTRACE_HAS_ASAN
    // A stack that lay here before ended by a jump, with its last frames still marked.
    __asan_unpoison_memory_region(stack_.bottom(), stack_.bytes());
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
#ifdef CELLTRACE_HAS_ASAN
    void* fake_stack = nullptr;
    __sanitizer_start_switch_fiber(&fake_stack, stack_.bottom(), stack_.bytes());
#endif
    stack_.enter();
#ifdef CELLTRACE_HAS_ASAN
    __sanitizer_finish_switch_fiber(fake_stack, nullptr, nullptr);
#endif
    std::swap(running_stack_local, stack_local_);
    exchange_exceptions(exceptions_);
  }

  void suspend() {
    leave(false);
    stack_.leave();
    arrive();
  }

  bool ended() const {
    return stack_.ended();
  }

private:
  void run() {
    arrive();
    body_();
    body_ = nullptr;
    leave(true);
  }

  void arrive() {
#ifdef CELLTRACE_HAS_ASAN
    __sanitizer_finish_switch_fiber(fake_stack_, &caller_bottom_, &caller_bytes_);
#endif
  }
  void leave([[maybe_unused]] bool for_good) {
#ifdef CELLTRACE_HAS_TSAN
    __tsan_switch_to_fiber(tsan_caller_, 0);
#endif
#ifdef CELLTRACE_HAS_ASAN
    __sanitizer_start_switch_fiber(for_good ? nullptr : &fake_stack_, caller_bottom_, caller_bytes_);
#endif
  }

  std::function<void()> body_;
  SwitchedStack stack_{kStackBytes};
  ExceptionState exceptions_;
  void* stack_local_ = nullptr;
#ifdef CELLTRACE_HAS_ASAN
  void* fake_stack_ = nullptr;
  const void* caller_bottom_ = nullptr;
  std::size_t caller_bytes_ = 0;
#endif
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

// Not inline: where a coroutine goes on on another thread, no address of the old thread's may have been kept.
void*& stack_local() {
  return running_stack_local;
}

} // namespace celltrace::cell_emu
