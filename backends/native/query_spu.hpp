// The interface of an SPU that the kernel needs to traverse the scene, for ray queries on a thread of the
// application without an SPE.
#pragma once

#include "celltrace/spe/spu.hpp"

namespace celltrace::native {

/// A Spu that has no other SPEs, no channels, and no local store to allocate from. `Simd` is a HostSimd.
template <class Simd> class QuerySpu : public SpuBase<QuerySpu<Simd>> {
public:
  static constexpr bool direct_memory = true;
  using simd = Simd;
  using rare_simd = Simd;
};

} // namespace celltrace::native
