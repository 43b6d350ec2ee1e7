// Lifetimes of the pointers that a software cache returns, and the checked mode that watches them. Kernel
// dialect.
//
// A cache without checks returns plain pointers into its lines. A checked cache returns pointers to copies in
// a window of its own, and overwrites a copy when its lifetime ends, whether or not the line is still cached.
// A program that uses a pointer too late then always fails, not only if the line happens to be replaced: a
// checked pointer halts the SPE with stale_pointer; a plain pointer or reference made from a checked pointer
// reads poison.
#pragma once

#include "celltrace/cache/config.hpp"

#include <stdint.h>

namespace celltrace {

/// Checks nothing: plain pointers, for a cache without checks.
template <class Spu, bool checked> class CacheLifetimes {
protected:
  template <class T> using Pointer = const T*;

  static constexpr uint32_t lifetime_bytes(const CacheConfig&) { return 0; }
  void set_up_lifetimes(Spu&, const CacheConfig&) {}
  void begin_call() {}
  void end_lifetimes() {}
  template <class T> Pointer<T> shown(const uint8_t* line, uint32_t at) {
    return reinterpret_cast<const T*>(line + at);
  }
};

/// A pointer that checks its lifetime at each use. Trivially copyable; like all pointers into a cache, it
/// belongs to the thread of its SPE.
template <class T, class Lifetimes> class CheckedCachePointer {
public:
  CheckedCachePointer(const T* object, const Lifetimes& lifetimes, uint32_t call)
      : object_(object), lifetimes_(&lifetimes), call_(call) {}

  /// Returns the plain pointer. Halts the SPE with stale_pointer if the object's lifetime is over.
  const T* get() const {
    lifetimes_->check(call_);
    return object_;
  }
  const T& operator*() const { return *get(); }
  const T* operator->() const { return get(); }
  operator const T*() const { return get(); }

private:
  const T* object_;
  const Lifetimes* lifetimes_;
  uint32_t call_;
};

template <class Spu> class CacheLifetimes<Spu, true> {
public:
  /// The word that objects are overwritten with at the end of their lifetimes: as a float it is a NaN on the
  /// host, and enormous on an SPU.
  static constexpr uint32_t kPoison = 0x7FB0DEADu;

  void check(uint32_t call) const {
    if (calls_ - call >= calls_alive_) spu_->halt(HaltCode::stale_pointer);
  }

protected:
  template <class T> using Pointer = CheckedCachePointer<T, CacheLifetimes>;

  static constexpr uint32_t lifetime_bytes(const CacheConfig& config) {
    return calls_alive(config) * kLineBytes;
  }
  void set_up_lifetimes(Spu& spu, const CacheConfig& config) {
    spu_ = &spu;
    calls_alive_ = calls_alive(config);
    window_ = spu.template allocate<Line>(calls_alive_);
    end_lifetimes();
  }

  /// Begins a call of a member of the cache, which ends the lifetime of the object that was returned
  /// calls_alive_ calls ago.
  void begin_call() {
    ++calls_;
    poison(window_[place()]);
  }
  /// Ends the lifetimes of all returned objects.
  void end_lifetimes() {
    calls_ += calls_alive_;
    for (uint32_t i = 0; i < calls_alive_; ++i)
      poison(window_[i]);
  }
  /// Returns the object at byte `at` of the line, as the result of the present call.
  template <class T> Pointer<T> shown(const uint8_t* line, uint32_t at) {
    if (at % alignof(T) != 0 || at + sizeof(T) > kLineBytes) spu_->halt(HaltCode::bad_argument);
    Line& shown = window_[place()];
    shown = *reinterpret_cast<const Line*>(line);
    return {reinterpret_cast<const T*>(reinterpret_cast<const uint8_t*>(&shown) + at), *this, calls_};
  }

private:
  struct alignas(kLineBytes) Line {
    uint32_t words[kLineBytes / 4];
  };
  /// Largest number of lines of the window. With more ways, checked pointers live shorter than the cache
  /// promises.
  static constexpr uint32_t kMaxCallsAlive = 8;

  /// Returns the number of calls for which a returned object is valid, including the call that returns it. A
  /// power of two.
  static constexpr uint32_t calls_alive(const CacheConfig& config) {
    if (!config.enabled || config.replacement != CacheReplacement::lru) return 1;
    return config.ways < kMaxCallsAlive ? config.ways : kMaxCallsAlive;
  }
  uint32_t place() const { return calls_ & (calls_alive_ - 1); }
  static void poison(Line& line) {
    for (uint32_t& word : line.words)
      word = kPoison;
  }

  Spu* spu_ = nullptr;
  uint32_t calls_ = 0;
  uint32_t calls_alive_ = 1;
  Line* window_ = nullptr;
};

} // namespace celltrace
