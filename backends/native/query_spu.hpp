// What the kernel asks of an SPU that it traverses the scene on, where no SPE is: on a thread of the
// application's.
#pragma once

#include "celltrace/spe/spu.hpp"

namespace celltrace::native {

/// Knows neither other SPEs nor channels, and has no local store to allocate from. `Simd` is a HostSimd.
template <class Simd> class QuerySpu : public SpuBase<QuerySpu<Simd>> {
public:
  static constexpr bool direct_memory = true;
  using simd = Simd;
  using rare_simd = Simd;
};

} // namespace celltrace::native
