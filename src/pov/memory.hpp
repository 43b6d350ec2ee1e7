// Counts the memory that a parse holds, as it is allocated and released, so that no scene can pass its limit.
//
// A parse and everything that it counts belong to one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "celltrace/pov.hpp"

namespace celltrace::pov {

/// Thrown if the scene has passed a limit; parse() adds the place.
struct LimitPassed {
  std::uint64_t ParseLimits::*limit;
  const char* who; ///< subject of the message, such as "the scene's declarations need"
  const char* unit;
};

/// Counts memory for the calling thread's innermost parse while it lives.
class MemoryCount {
public:
  explicit MemoryCount(const ParseLimits& limits) : limits_(limits), outer_(current_) { current_ = this; }
  MemoryCount(const MemoryCount&) = delete;
  MemoryCount& operator=(const MemoryCount&) = delete;
  ~MemoryCount() { current_ = outer_; }

  /// Counts bytes. Throws LimitPassed.
  static void take(std::size_t bytes) {
    if (current_) current_->take_bytes(bytes);
  }
  /// Counts bytes where nothing may throw; the next call of take() checks the limit.
  static void take_unchecked(std::size_t bytes) noexcept {
    if (current_) current_->bytes_ += bytes;
  }
  static void give_back(std::size_t bytes) noexcept {
    if (current_) current_->bytes_ -= bytes;
  }
  static void take_elements(std::size_t count) {
    if (current_) current_->take_array_elements(count);
  }
  static void give_elements_back(std::size_t count) noexcept {
    if (current_) current_->elements_ -= count;
  }

private:
  void take_bytes(std::size_t bytes) {
    if (bytes > limits_.memory || bytes_ + bytes > limits_.memory)
      throw LimitPassed{&ParseLimits::memory, "the declarations of the scene need", "bytes of memory"};
    bytes_ += bytes;
  }
  void take_array_elements(std::size_t count) {
    if (count > limits_.array_elements || elements_ + count > limits_.array_elements)
      throw LimitPassed{&ParseLimits::array_elements, "the arrays of the scene have", "elements"};
    elements_ += count;
  }

  const ParseLimits& limits_;
  MemoryCount* outer_;
  std::uint64_t bytes_ = 0, elements_ = 0;
  static inline thread_local MemoryCount* current_ = nullptr;
};

/// A member that counts each object of type T.
template <class T> class Counted {
public:
  Counted() { MemoryCount::take(sizeof(T)); }
  Counted(const Counted&) : Counted() {}
  Counted(Counted&&) noexcept { MemoryCount::take_unchecked(sizeof(T)); }
  Counted& operator=(const Counted&) { return *this; }
  ~Counted() { MemoryCount::give_back(sizeof(T)); }
};

/// A member that counts bytes whose number is known later.
class MemoryShare {
public:
  MemoryShare() = default;
  MemoryShare(const MemoryShare&) = delete;
  MemoryShare& operator=(const MemoryShare&) = delete;
  ~MemoryShare() { MemoryCount::give_back(bytes_); }

  void take(std::size_t bytes) {
    MemoryCount::take(bytes);
    bytes_ += bytes;
  }

private:
  std::size_t bytes_ = 0;
};

/// An allocator for the elements of arrays, which counts them.
template <class T> struct ElementAllocator {
  using value_type = T;

  ElementAllocator() = default;
  template <class U> ElementAllocator(const ElementAllocator<U>&) {}

  T* allocate(std::size_t count) {
    MemoryCount::take_elements(count);
    try {
      return std::allocator<T>().allocate(count);
    } catch (...) {
      MemoryCount::give_elements_back(count);
      throw;
    }
  }
  void deallocate(T* elements, std::size_t count) noexcept {
    std::allocator<T>().deallocate(elements, count);
    MemoryCount::give_elements_back(count);
  }
  template <class U> bool operator==(const ElementAllocator<U>&) const { return true; }
};

} // namespace celltrace::pov
