// The vector types of the C/C++ Language Extensions for Cell, on the host: vec_float4 and others, and
// qword.
//
// The types behave as on the SPU: element 0 is at the lowest address. A cast from one type to another keeps
// the 128 bits of the register, in which element 0 is the most significant, whatever the byte order of the
// host. Operators give the results of the SPU's instructions. In memory, elements are numbers in the host's
// byte order.
//
//   vec_float4 v = {1, 2, 3, 4};
//   vec_uchar16 pattern = (vec_uchar16)(vec_uint4){0x04050607, 0x00010203, 0x0C0D0E0F, 0x08090A0B};
//
// The vectors of GCC and Clang of 16 bytes (`vector float` of existing sources, see sdk/spu_intrinsics.h)
// convert to these types and back.
#pragma once

#include "celltrace/spe/quadword.hpp"
#include "celltrace/spe/spu_instructions.hpp"

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <type_traits>

namespace celltrace::sdk {

template <class T> class Vector;

/// The compilers' own vector types.
template <class T> struct NativeVector;
/// Traits of types: only vector types have an element_type.
template <class V> struct VectorTraits {};
template <class T> struct VectorTraits<Vector<T>> {
  using element_type = T;
  static constexpr bool is_native = false;
};

#define CELLTRACE_NATIVE_VECTOR(T)                                                                           \
  template <> struct NativeVector<T> { typedef T type __attribute__((vector_size(16))); };                   \
  template <> struct VectorTraits<NativeVector<T>::type> {                                                   \
    using element_type = T;                                                                                  \
    static constexpr bool is_native = true;                                                                  \
  };
CELLTRACE_NATIVE_VECTOR(unsigned char)
CELLTRACE_NATIVE_VECTOR(signed char)
CELLTRACE_NATIVE_VECTOR(unsigned short)
CELLTRACE_NATIVE_VECTOR(short)
CELLTRACE_NATIVE_VECTOR(unsigned int)
CELLTRACE_NATIVE_VECTOR(int)
CELLTRACE_NATIVE_VECTOR(unsigned long long)
CELLTRACE_NATIVE_VECTOR(long long)
CELLTRACE_NATIVE_VECTOR(float)
CELLTRACE_NATIVE_VECTOR(double)
#undef CELLTRACE_NATIVE_VECTOR

template <class V>
concept AnyVector = requires {
  typename VectorTraits<std::remove_cvref_t<V>>::element_type;
};
template <class V>
concept AnyNativeVector = AnyVector<V> && VectorTraits<std::remove_cvref_t<V>>::is_native;
template <AnyVector V> using ElementOf = typename VectorTraits<std::remove_cvref_t<V>>::element_type;
template <AnyVector V> using VectorOf = Vector<ElementOf<V>>;

/// An element of a braced list, converted from a number of any type, as in C.
template <class T> struct ListedElement {
  T value;
  template <class Number>
  requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
  constexpr ListedElement(Number number) : value(static_cast<T>(number)) {}
};

/// The instructions of an operation, by type of elements; `stop`: there is no instruction.
struct OpcodeByElement {
  Opcode byte = Opcode::stop, halfword = Opcode::stop, word = Opcode::stop, single = Opcode::stop,
         doubleword = Opcode::stop;

  template <class T> constexpr Opcode of() const {
    if (std::is_same_v<T, float>) return single;
    if (std::is_same_v<T, double>) return doubleword;
    return sizeof(T) == 1 ? byte : sizeof(T) == 2 ? halfword : sizeof(T) == 4 ? word : Opcode::stop;
  }
};

/// A vector of 16 bytes. Trivial; may alias other types. Thread safety: as an array.
template <class T> class [[gnu::may_alias]] alignas(16) Vector {
public:
  using value_type = T;
  using Native = typename NativeVector<T>::type;
  static constexpr unsigned kElements = 16 / sizeof(T);

  Vector() = default;
  /// Makes a vector of elements in braces; missing elements are 0. Throws std::length_error for too many
  /// elements.
  constexpr Vector(std::initializer_list<ListedElement<T>> list) : elements_{} {
    if (list.size() > kElements) throw std::length_error("too many elements for a vector");
    unsigned i = 0;
    for (const ListedElement<T>& each : list)
      elements_[i++] = each.value;
  }
  explicit Vector(const Quadword& q) {
    if constexpr (sizeof(T) == 1)
      q.store(reinterpret_cast<std::uint8_t*>(elements_));
    else
      for (unsigned i = 0; i < kElements; ++i)
        elements_[i] = q.get<T>(i);
  }
  /// Converts from another vector type; the bits stay the same.
  template <class Other> explicit Vector(const Vector<Other>& other) : Vector(other.quadword()) {}

  Vector(const Native& native) { std::memcpy(elements_, &native, sizeof elements_); }
  operator Native() const {
    Native native;
    std::memcpy(&native, elements_, sizeof native);
    return native;
  }
  template <AnyNativeVector Other>
  requires(!std::is_same_v<ElementOf<Other>, T>) explicit Vector(const Other& native)
      : Vector(VectorOf<Other>(native)) {}
  template <AnyNativeVector Other>
  requires(!std::is_same_v<ElementOf<Other>, T>) explicit operator Other() const {
    return VectorOf<Other>(*this);
  }

  /// Returns the register that holds the vector.
  Quadword quadword() const {
    if constexpr (sizeof(T) == 1) {
      return Quadword::load(reinterpret_cast<const std::uint8_t*>(elements_));
    } else {
      Quadword q;
      for (unsigned i = 0; i < kElements; ++i)
        q.set(i, elements_[i]);
      return q;
    }
  }

  constexpr T& operator[](unsigned i) { return elements_[i]; }
  constexpr const T& operator[](unsigned i) const { return elements_[i]; }

  friend Vector operator+(const Vector& a, const Vector& b) {
    if constexpr (kHasSums) {
      constexpr OpcodeByElement kAdd{
          .halfword = Opcode::ah, .word = Opcode::a, .single = Opcode::fa, .doubleword = Opcode::dfa};
      return of(kAdd.of<T>(), a, b);
    } else {
      return each(a, b, [](auto x, auto y) { return x + y; });
    }
  }
  friend Vector operator-(const Vector& a, const Vector& b) {
    if constexpr (std::is_floating_point_v<T>)
      return of(sizeof(T) == 4 ? Opcode::fs : Opcode::dfs, a, b);
    else if constexpr (kHasSums) // the instruction subtracts its first operand from its second
      return of(sizeof(T) == 4 ? Opcode::sf : Opcode::sfh, b, a);
    else
      return each(a, b, [](auto x, auto y) { return x - y; });
  }
  friend Vector operator*(const Vector& a, const Vector& b) {
    if constexpr (std::is_floating_point_v<T>)
      return of(sizeof(T) == 4 ? Opcode::fm : Opcode::dfm, a, b);
    else
      return each(a, b, [](auto x, auto y) { return x * y; });
  }
  friend Vector operator&(const Vector& a, const Vector& b) { return of(Opcode::and_, a, b); }
  friend Vector operator|(const Vector& a, const Vector& b) { return of(Opcode::or_, a, b); }
  friend Vector operator^(const Vector& a, const Vector& b) { return of(Opcode::xor_, a, b); }
  friend Vector operator~(const Vector& a) { return of(Opcode::nor, a, a); }
  /// Returns the negated elements; floating-point zeros change their sign, too.
  friend Vector operator-(const Vector& a) {
    if constexpr (std::is_floating_point_v<T>) {
      Vector signs;
      for (T& each : signs.elements_)
        each = static_cast<T>(-0.0);
      return a ^ signs;
    } else {
      return Vector{} - a;
    }
  }
  Vector& operator+=(const Vector& b) { return *this = *this + b; }
  Vector& operator-=(const Vector& b) { return *this = *this - b; }
  Vector& operator*=(const Vector& b) { return *this = *this * b; }
  Vector& operator&=(const Vector& b) { return *this = *this & b; }
  Vector& operator|=(const Vector& b) { return *this = *this | b; }
  Vector& operator^=(const Vector& b) { return *this = *this ^ b; }

private:
  /// True if the SPU has an add instruction for these elements. Compilers for the SPU compose sums of bytes
  /// and doublewords of other instructions.
  static constexpr bool kHasSums = std::is_floating_point_v<T> || sizeof(T) == 2 || sizeof(T) == 4;

  static Vector of(Opcode opcode, const Vector& a, const Vector& b) {
    return Vector(execute(opcode, a.quadword(), b.quadword(), Quadword::zero(), 0));
  }
  /// Applies `f` to each pair of integers, which wrap around.
  template <class F> static Vector each(const Vector& a, const Vector& b, F f) {
    using Bits = std::make_unsigned_t<std::conditional_t<sizeof(T) < 4, int, T>>;
    Vector result;
    for (unsigned i = 0; i < kElements; ++i)
      result[i] = static_cast<T>(f(static_cast<Bits>(a[i]), static_cast<Bits>(b[i])));
    return result;
  }

  T elements_[kElements];
};

/// The vector type whose elements are of a scalar type: unsigned char for char, which has no sign on the SPU.
template <class Scalar> struct VectorForScalar { using type = Vector<Scalar>; };
template <> struct VectorForScalar<char> { using type = Vector<unsigned char>; };
template <> struct VectorForScalar<long> {
  using type = Vector<std::conditional_t<sizeof(long) == 8, long long, int>>;
};
template <> struct VectorForScalar<unsigned long> {
  using type = Vector<std::conditional_t<sizeof(long) == 8, unsigned long long, unsigned int>>;
};

} // namespace celltrace::sdk

using vec_uchar16 = celltrace::sdk::Vector<unsigned char>;
using vec_char16 = celltrace::sdk::Vector<signed char>;
using vec_ushort8 = celltrace::sdk::Vector<unsigned short>;
using vec_short8 = celltrace::sdk::Vector<short>;
using vec_uint4 = celltrace::sdk::Vector<unsigned int>;
using vec_int4 = celltrace::sdk::Vector<int>;
using vec_ullong2 = celltrace::sdk::Vector<unsigned long long>;
using vec_llong2 = celltrace::sdk::Vector<long long>;
using vec_float4 = celltrace::sdk::Vector<float>;
using vec_double2 = celltrace::sdk::Vector<double>;

/// The register type that the specific intrinsics work on.
using qword = vec_char16;
