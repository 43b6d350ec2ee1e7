// Ray queries, compiled once per CPU.
#include "kernel/direct/ray_queries.hpp"

#include "backends/native/query_spu.hpp"
#include "backends/spe_entry.hpp"
#include "celltrace/spe/simd_host_eight.hpp"
#include "celltrace/spe/simd_host_quad.hpp"

namespace celltrace {

namespace {

/// Not run by an SPE: where applications get their functions from.
template <class Spu> void enter_functions(Spu&, ea_t argument) {
  using Simd = typename Spu::simd;
  kernel::enter_ray_query_functions<
      kernel::RayQueryAnswers<native::QuerySpu<Simd>, HostQuad<Simd>, HostEight<Simd>>>(argument);
}

} // namespace

} // namespace celltrace

CELLTRACE_SPE_ENTRY(ray_queries, enter_functions)
