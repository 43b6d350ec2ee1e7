// Types that each have a number, from which dispatch follows. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

/// A list of types, each with a kName. The number of a type is its index.
template <class... T> struct TypeList {
  static constexpr uint32_t kCount = sizeof...(T);
  static constexpr const char* kNames[] = {T::kName...};

  /// Returns the index of a type.
  template <class Wanted> static constexpr uint32_t number() {
    constexpr bool found[] = {is_same<Wanted, T>()...};
    uint32_t number = 0;
    while (!found[number])
      ++number;
    return number;
  }

  /// Calls `visit(T())` for the type with a number, or nothing if there is none.
  template <class Visit> [[gnu::always_inline]] static inline void dispatch(uint32_t wanted, Visit visit) {
    uint32_t number = 0;
    ((wanted == number++ ? visit(T()) : void()), ...);
  }
  /// Calls `visit(T())` for every type.
  template <class Visit> [[gnu::always_inline]] static inline void for_each(Visit visit) {
    (visit(T()), ...);
  }

private:
  template <class A, class B> struct Same { static constexpr bool value = false; };
  template <class A> struct Same<A, A> { static constexpr bool value = true; };
  template <class A, class B> static constexpr bool is_same() { return Same<A, B>::value; }
};

} // namespace celltrace::kernel
