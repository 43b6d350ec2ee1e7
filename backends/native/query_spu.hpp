// QuerySpu: an Spu for ray queries, with which the kernel traverses the scene on a thread of the application.
#pragma once

#include "celltrace/spe/spu.hpp"

namespace celltrace::native {

/// An Spu without other SPEs, without channels and without an arena. `Simd` is a HostSimd.
template <class Simd> class QuerySpu : public SpuBase<QuerySpu<Simd>> {
public:
  static constexpr bool direct_memory = true;
  using simd = Simd;
  using rare_simd = Simd;
};

} // namespace celltrace::native
