// Batches: the host's vector registers, of which simd_host.hpp composes its 16 lanes. If xsimd knows the
// processor, its batches are used. For other processors there are batches of four lanes, made with the vector
// extensions of GCC and clang; they have the operations that simd_host.hpp needs, and give the same bits as
// SSE2.
#pragma once

#include <stdint.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>

#if defined(__x86_64__) || defined(__aarch64__)
#define CELLTRACE_HAS_XSIMD 1
#include <xsimd/xsimd.hpp>
#endif

namespace celltrace {

/// An architecture for processors that xsimd does not know.
struct GenericArch {};

/// The SIMD architecture that every CPU of the build's target has; the CMake option CELLTRACE_BASELINE_SIMD
/// raises it.
#if defined(CELLTRACE_BASELINE_AVX512)
using BaselineArch = xsimd::avx512dq;
#elif defined(CELLTRACE_BASELINE_AVX2)
using BaselineArch = xsimd::avx2;
#elif defined(__x86_64__)
using BaselineArch = xsimd::sse2;
#elif defined(__aarch64__)
using BaselineArch = xsimd::neon64;
#else
using BaselineArch = GenericArch;
#endif

namespace simd_host {

template <class T> struct GenericRegister;
template <> struct GenericRegister<float> { typedef float type __attribute__((vector_size(16))); };
template <> struct GenericRegister<int32_t> { typedef int32_t type __attribute__((vector_size(16))); };
template <> struct GenericRegister<uint32_t> { typedef uint32_t type __attribute__((vector_size(16))); };

/// A mask of four lanes of any type. In a lane either all bits are set or none.
struct GenericMask {
  using register_type = GenericRegister<int32_t>::type;
  register_type data;

  GenericMask() = default;
  explicit GenericMask(bool value) : data(register_type{} - static_cast<int32_t>(value)) {}
  GenericMask(register_type lanes) : data(lanes) {}
  void store_unaligned(bool* lanes) const {
    for (int i = 0; i < 4; ++i)
      lanes[i] = data[i] != 0;
  }
  friend GenericMask operator&(const GenericMask& a, const GenericMask& b) { return a.data & b.data; }
  friend GenericMask operator|(const GenericMask& a, const GenericMask& b) { return a.data | b.data; }
  friend GenericMask operator!(const GenericMask& a) { return ~a.data; }
};

template <class T> struct GenericBatch {
  using value_type = T;
  using arch_type = GenericArch;
  using batch_bool_type = GenericMask;
  using register_type = typename GenericRegister<T>::type;
  using Bits = GenericRegister<uint32_t>::type;
  static constexpr std::size_t size = 4;
  register_type data;

  GenericBatch() = default;
  GenericBatch(T value) : data{value, value, value, value} {}
  GenericBatch(register_type lanes) : data(lanes) {}
  static GenericBatch load_unaligned(const T* lanes) {
    GenericBatch result;
    std::memcpy(&result.data, lanes, sizeof result.data);
    return result;
  }
  static GenericBatch load_aligned(const T* lanes) { return load_unaligned(lanes); }
  static GenericBatch gather(const T* table, const GenericBatch<int32_t>& indices) {
    GenericBatch result;
    for (int i = 0; i < 4; ++i)
      result.data[i] = table[indices.data[i]];
    return result;
  }
  void store_aligned(T* lanes) const { std::memcpy(lanes, &data, sizeof data); }
  void store_unaligned(T* lanes) const { store_aligned(lanes); }

  Bits bits() const { return reinterpret_cast<Bits>(data); }
  static GenericBatch of_bits(Bits lanes) { return reinterpret_cast<register_type>(lanes); }

  // Integers wrap around: they are added as unsigned integers, whose overflow is defined.
  friend GenericBatch operator+(const GenericBatch& a, const GenericBatch& b) {
    if constexpr (std::is_integral_v<T>)
      return of_bits(a.bits() + b.bits());
    else
      return a.data + b.data;
  }
  friend GenericBatch operator-(const GenericBatch& a, const GenericBatch& b) {
    if constexpr (std::is_integral_v<T>)
      return of_bits(a.bits() - b.bits());
    else
      return a.data - b.data;
  }
  friend GenericBatch operator*(const GenericBatch& a, const GenericBatch& b) { return a.data * b.data; }
  friend GenericBatch operator/(const GenericBatch& a, const GenericBatch& b) { return a.data / b.data; }
  friend GenericBatch operator&(const GenericBatch& a, const GenericBatch& b) {
    return of_bits(a.bits() & b.bits());
  }
  friend GenericBatch operator|(const GenericBatch& a, const GenericBatch& b) {
    return of_bits(a.bits() | b.bits());
  }
  friend GenericBatch operator^(const GenericBatch& a, const GenericBatch& b) {
    return of_bits(a.bits() ^ b.bits());
  }
  friend GenericBatch operator<<(const GenericBatch& a, int count) { return of_bits(a.bits() << count); }
  friend GenericBatch operator>>(const GenericBatch& a, int count) { return a.data >> count; }
  friend GenericMask operator<(const GenericBatch& a, const GenericBatch& b) { return a.data < b.data; }
  friend GenericMask operator<=(const GenericBatch& a, const GenericBatch& b) { return a.data <= b.data; }
  friend GenericMask operator==(const GenericBatch& a, const GenericBatch& b) { return a.data == b.data; }
  friend GenericMask operator!=(const GenericBatch& a, const GenericBatch& b) { return a.data != b.data; }
};

inline GenericMask bool_cast(const GenericMask& mask) {
  return mask;
}
template <class To, class T> To bitwise_cast(const GenericBatch<T>& a) {
  return To::of_bits(a.bits());
}
inline GenericBatch<int32_t> to_int(const GenericBatch<float>& a) {
  return __builtin_convertvector(a.data, GenericBatch<int32_t>::register_type);
}
inline GenericBatch<float> to_float(const GenericBatch<int32_t>& a) {
  return __builtin_convertvector(a.data, GenericBatch<float>::register_type);
}
template <class T>
GenericBatch<T> select(const GenericMask& chosen, const GenericBatch<T>& a, const GenericBatch<T>& b) {
  const auto mask = reinterpret_cast<typename GenericBatch<T>::Bits>(chosen.data);
  return GenericBatch<T>::of_bits((mask & a.bits()) | (~mask & b.bits()));
}
template <class T> GenericBatch<T> min(const GenericBatch<T>& a, const GenericBatch<T>& b) {
  return select(a < b, a, b);
}
template <class T> GenericBatch<T> max(const GenericBatch<T>& a, const GenericBatch<T>& b) {
  return select(b < a, a, b);
}
inline GenericBatch<float> abs(const GenericBatch<float>& a) {
  return GenericBatch<float>::of_bits(a.bits() & 0x7FFFFFFFu);
}
inline GenericBatch<float> sqrt(GenericBatch<float> a) {
  for (int i = 0; i < 4; ++i)
    a.data[i] = std::sqrt(a.data[i]);
  return a;
}
/// Returns floor(a), for |a| < 2^31.
inline GenericBatch<float> floor(const GenericBatch<float>& a) {
  const GenericBatch<float> whole = to_float(to_int(a));
  return select(a < whole, whole - GenericBatch<float>(1), whole);
}
template <class T> GenericBatch<T> zip_lo(const GenericBatch<T>& a, const GenericBatch<T>& b) {
  return __builtin_shufflevector(a.data, b.data, 0, 4, 1, 5);
}
template <class T> GenericBatch<T> zip_hi(const GenericBatch<T>& a, const GenericBatch<T>& b) {
  return __builtin_shufflevector(a.data, b.data, 2, 6, 3, 7);
}

template <class Batch> [[gnu::always_inline]] inline Batch divide(const Batch& a, const Batch& b) {
  return a / b;
}

#ifdef CELLTRACE_HAS_XSIMD
using xsimd::abs, xsimd::bitwise_cast, xsimd::bool_cast, xsimd::floor, xsimd::max, xsimd::min, xsimd::select,
    xsimd::sqrt, xsimd::to_float, xsimd::to_int, xsimd::zip_hi, xsimd::zip_lo;

#if defined(__aarch64__)
// Replacements for xsimd 8's operations, which are estimates and do not give IEEE's bits.
inline xsimd::batch<float, xsimd::neon64> divide(const xsimd::batch<float, xsimd::neon64>& a,
                                                 const xsimd::batch<float, xsimd::neon64>& b) {
  return vdivq_f32(a, b);
}
inline xsimd::batch<float, xsimd::neon64> sqrt(const xsimd::batch<float, xsimd::neon64>& a) {
  return vsqrtq_f32(a);
}
#endif

template <class T, class Arch> struct Batches {
  using Batch = xsimd::batch<T, Arch>;
  using Mask = xsimd::batch_bool<T, Arch>;
  template <std::size_t n> using OfSize = xsimd::make_sized_batch_t<T, n>;
};
#else
template <class T, class Arch> struct Batches;
#endif
template <class T> struct Batches<T, GenericArch> {
  using Batch = GenericBatch<T>;
  using Mask = GenericMask;
  template <std::size_t n> using OfSize = GenericBatch<T>;
};

} // namespace simd_host
} // namespace celltrace
