#include "bench/triangle_loop.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(triangle_loop, celltrace::bench::triangle_loop)
