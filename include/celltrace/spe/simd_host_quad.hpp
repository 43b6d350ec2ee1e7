// Four lanes of a host CPU with the operators of simd.hpp: for tests of a single ray with four triangles,
// which would leave most of sixteen lanes empty.
#pragma once

#include "celltrace/spe/simd_host.hpp"

namespace celltrace {

/// Types of four lanes. `Simd` is a HostSimd; it is part of the type's name, so that translation units
/// compiled for different CPUs share no inline function.
template <class Simd> struct HostQuad {
  using Batch = typename Simd::F4::Batch;
  static constexpr uint32_t kLanes = 4;

  struct M {
    typename Batch::batch_bool_type lanes;

    static M none() { return {typename Batch::batch_bool_type(false)}; }
    uint32_t bits() const { return simd_host::lane_bits<Batch>(lanes); }
    friend M operator&(const M& a, const M& b) { return {a.lanes & b.lanes}; }
    friend M operator|(const M& a, const M& b) { return {a.lanes | b.lanes}; }
    friend M operator!(const M& a) { return {!a.lanes}; }
  };

  struct F {
    Batch lanes;

    F() = default;
    F(float value) : lanes(value) {}
    F(const Batch& batch) : lanes(batch) {}
    static F load(const float* words) { return Batch::load_aligned(words); }
    void store(float* words) const { lanes.store_aligned(words); }
    friend F operator+(const F& a, const F& b) { return a.lanes + b.lanes; }
    friend F operator-(const F& a, const F& b) { return a.lanes - b.lanes; }
    friend F operator*(const F& a, const F& b) { return a.lanes * b.lanes; }
    friend F operator/(const F& a, const F& b) { return simd_host::divide(a.lanes, b.lanes); }
    friend F operator-(const F& a) {
      return a.lanes ^ Batch(-0.0f);
    } // flips the sign bit: 0 - a would give zeros the wrong sign
    friend M operator<(const F& a, const F& b) { return {a.lanes < b.lanes}; }
    friend M operator<=(const F& a, const F& b) { return {a.lanes <= b.lanes}; }
    friend M operator>(const F& a, const F& b) { return b < a; }
    friend M operator>=(const F& a, const F& b) { return b <= a; }
  };

  static F min(const F& a, const F& b) { return simd_host::min(a.lanes, b.lanes); }
  static F max(const F& a, const F& b) { return simd_host::max(a.lanes, b.lanes); }
  static F abs(const F& a) { return simd_host::abs(a.lanes); }
  static F select(const M& m, const F& a, const F& b) { return simd_host::select(m.lanes, a.lanes, b.lanes); }
  /// Transposes the 4x4 numbers whose rows are `a` to `d`.
  static void transpose(F& a, F& b, F& c, F& d) {
    simd_host::transpose_quads(a.lanes, b.lanes, c.lanes, d.lanes);
  }
};

} // namespace celltrace
