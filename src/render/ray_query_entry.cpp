// Ray queries, compiled once per CPU.
#include "kernel/direct/ray_queries.hpp"

#include "backends/native/query_spu.hpp"
#include "backends/spe_entry.hpp"
#include "celltrace/spe/simd_host_eight.hpp"
#include "celltrace/spe/simd_host_quad.hpp"

namespace celltrace {

// An entry point that no SPE runs: applications get their query functions from it.
void CELLTRACE_SPE_ENTRY_NAME(ray_queries, CELLTRACE_SPU_NAME)(void* spu, ea_t argument);
void CELLTRACE_SPE_ENTRY_NAME(ray_queries, CELLTRACE_SPU_NAME)(void*, ea_t argument) {
  using Simd = CELLTRACE_SPU_TYPE::simd;
  using Spu = native::QuerySpu<Simd>;
  kernel::enter_ray_query_functions<kernel::RayQueryAnswers<Spu, HostQuad<Simd>, HostEight<Simd>>>(argument);
}

} // namespace celltrace
