// Eight lanes of a host CPU, for tests of a single ray with eight boxes.
#pragma once

#include "celltrace/spe/simd_host.hpp"

#include <type_traits>

namespace celltrace {

/// Eight floats. `Simd` is a HostSimd; it is part of the type's name, so that translation units compiled for
/// different CPUs share no inline function.
template <class Simd> struct HostEight {
  using Batches = simd_host::Batches<float, typename Simd::FloatBatch::arch_type>;
  using Part =
      std::conditional_t<(Simd::kWidth >= 8), typename Batches::template OfSize<8>, typename Simd::F4::Batch>;
  static constexpr uint32_t kParts = 8 / static_cast<uint32_t>(Part::size);

  Part part[kParts];

  template <class Make> [[gnu::always_inline]] static HostEight make(Make make_part) {
    HostEight result;
    for (uint32_t i = 0; i < kParts; ++i)
      result.part[i] = make_part(i);
    return result;
  }
  static HostEight splat(float value) {
    return make([&](uint32_t) { return Part(value); });
  }
  static HostEight load(const float* words) {
    return make([&](uint32_t i) { return Part::load_aligned(words + i * Part::size); });
  }
  void store(float* words) const {
    for (uint32_t i = 0; i < kParts; ++i)
      part[i].store_aligned(words + i * Part::size);
  }
  friend HostEight operator*(const HostEight& a, const HostEight& b) {
    return make([&](uint32_t i) { return a.part[i] * b.part[i]; });
  }
  /// Returns a * b - c, rounded once (fused) or twice.
  friend HostEight multiply_subtract(const HostEight& a, const HostEight& b, const HostEight& c) {
    return make([&](uint32_t i) {
#if defined(__AVX512VL__)
      if constexpr (Part::size == 8)
        return Part(_mm256_mask_fmsub_ps(a.part[i], 0xFF, b.part[i], c.part[i]));
      else
#endif
        return a.part[i] * b.part[i] - c.part[i];
    });
  }
  static HostEight min(const HostEight& a, const HostEight& b) {
    return make([&](uint32_t i) { return simd_host::min(a.part[i], b.part[i]); });
  }
  static HostEight max(const HostEight& a, const HostEight& b) {
    return make([&](uint32_t i) { return simd_host::max(a.part[i], b.part[i]); });
  }
  friend uint32_t not_above_bits(const HostEight& a, const HostEight& b) {
    uint32_t bits = 0;
    for (uint32_t i = 0; i < kParts; ++i)
      bits |= simd_host::lane_bits<Part>(a.part[i] <= b.part[i]) << (i * Part::size);
    return bits;
  }
};

} // namespace celltrace
