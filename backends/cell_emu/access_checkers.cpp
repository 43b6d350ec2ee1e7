#include "backends/cell_emu/access_checkers.hpp"

#ifdef CELLTRACE_HAS_MEMCHECK
#include <valgrind/memcheck.h>
#endif

#if defined(__SANITIZE_ADDRESS__)
#define CELLTRACE_HAS_ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CELLTRACE_HAS_ASAN 1
#endif
#endif

// Weak declarations: a program built with the address sanitizer has these functions, whatever this library is
// built with.
#if defined(CELLTRACE_HAS_ASAN) || defined(__ELF__)
#define CELLTRACE_MAY_HAVE_ASAN 1
extern "C" {
[[gnu::weak]] void __asan_poison_memory_region(const volatile void* at, std::size_t bytes);
[[gnu::weak]] void __asan_unpoison_memory_region(const volatile void* at, std::size_t bytes);
[[gnu::weak]] void* __asan_region_is_poisoned(void* at, std::size_t bytes);
[[gnu::weak]] void __sanitizer_start_switch_fiber(void** fake_stack, const void* bottom, std::size_t bytes);
[[gnu::weak]] void __sanitizer_finish_switch_fiber(void* fake_stack, const void** bottom, std::size_t* bytes);
}
#endif

namespace celltrace::cell_emu {

bool runs_under_address_sanitizer() {
#ifdef CELLTRACE_MAY_HAVE_ASAN
  return __asan_poison_memory_region != nullptr;
#else
  return false;
#endif
}

bool has_access_checker() {
  return runs_under_address_sanitizer() || runs_under_valgrind();
}

#ifdef CELLTRACE_HAS_MEMCHECK
bool runs_under_valgrind() {
  static const bool result = RUNNING_ON_VALGRIND != 0;
  return result;
}

UncheckedScope::UncheckedScope() {
  if (runs_under_valgrind()) VALGRIND_DISABLE_ERROR_REPORTING;
}
UncheckedScope::~UncheckedScope() {
  if (runs_under_valgrind()) VALGRIND_ENABLE_ERROR_REPORTING;
}
#else
bool runs_under_valgrind() {
  return false;
}

UncheckedScope::UncheckedScope() = default;
UncheckedScope::~UncheckedScope() = default;
#endif

void forbid_access([[maybe_unused]] const std::uint8_t* at, [[maybe_unused]] std::size_t bytes) {
#ifdef CELLTRACE_MAY_HAVE_ASAN
  if (runs_under_address_sanitizer()) __asan_poison_memory_region(at, bytes);
#endif
#ifdef CELLTRACE_HAS_MEMCHECK
  if (runs_under_valgrind()) VALGRIND_MAKE_MEM_NOACCESS(at, bytes);
#endif
}

void permit_access([[maybe_unused]] const std::uint8_t* at, [[maybe_unused]] std::size_t bytes) {
#ifdef CELLTRACE_MAY_HAVE_ASAN
  if (runs_under_address_sanitizer()) __asan_unpoison_memory_region(at, bytes);
#endif
#ifdef CELLTRACE_HAS_MEMCHECK
  if (runs_under_valgrind()) VALGRIND_MAKE_MEM_DEFINED(at, bytes);
#endif
}

void settle([[maybe_unused]] const void* at, [[maybe_unused]] std::size_t bytes) {
#ifdef CELLTRACE_HAS_MEMCHECK
  if (runs_under_valgrind()) VALGRIND_MAKE_MEM_DEFINED(at, bytes);
#endif
}

bool may_access([[maybe_unused]] const std::uint8_t* at, [[maybe_unused]] std::size_t bytes) {
#ifdef CELLTRACE_MAY_HAVE_ASAN
  if (runs_under_address_sanitizer() &&
      __asan_region_is_poisoned(const_cast<std::uint8_t*>(at), bytes) != nullptr)
    return false;
#endif
#ifdef CELLTRACE_HAS_MEMCHECK
  if (runs_under_valgrind()) {
    const UncheckedScope silent; // Valgrind reports the query itself as an error if the answer is no
    return VALGRIND_CHECK_MEM_IS_ADDRESSABLE(at, bytes) == 0;
  }
#endif
  return true;
}

CheckedStack::CheckedStack(const void* bottom, std::size_t bytes) : bottom_(bottom), bytes_(bytes) {
#ifdef CELLTRACE_MAY_HAVE_ASAN
  // An earlier stack at this place ended by a jump, with its last frames still marked.
  if (runs_under_address_sanitizer()) __asan_unpoison_memory_region(bottom, bytes);
#endif
#ifdef CELLTRACE_HAS_MEMCHECK
  if (runs_under_valgrind())
    valgrind_id_ = VALGRIND_STACK_REGISTER(bottom, static_cast<const char*>(bottom) + bytes);
#endif
}

CheckedStack::~CheckedStack() {
#ifdef CELLTRACE_HAS_MEMCHECK
  if (runs_under_valgrind()) VALGRIND_STACK_DEREGISTER(valgrind_id_);
#endif
}

void CheckedStack::before_enter() {
#ifdef CELLTRACE_MAY_HAVE_ASAN
  if (runs_under_address_sanitizer()) __sanitizer_start_switch_fiber(&callers_fake_stack_, bottom_, bytes_);
#endif
}

void CheckedStack::after_enter() {
#ifdef CELLTRACE_MAY_HAVE_ASAN
  if (runs_under_address_sanitizer())
    __sanitizer_finish_switch_fiber(own_fake_stack_, &callers_bottom_, &callers_bytes_);
#endif
}

void CheckedStack::before_leave([[maybe_unused]] bool for_good) {
#ifdef CELLTRACE_MAY_HAVE_ASAN
  if (runs_under_address_sanitizer())
    __sanitizer_start_switch_fiber(for_good ? nullptr : &own_fake_stack_, callers_bottom_, callers_bytes_);
#endif
}

void CheckedStack::after_leave() {
#ifdef CELLTRACE_MAY_HAVE_ASAN
  if (runs_under_address_sanitizer()) __sanitizer_finish_switch_fiber(callers_fake_stack_, nullptr, nullptr);
#endif
}

} // namespace celltrace::cell_emu
