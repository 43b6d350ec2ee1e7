#include "bench/intersection_loop.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(intersection_loop, celltrace::bench::intersection_loop)
