// The searcher, compiled once per SPU type.
#include "kernel/models/searcher.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(stage_searcher, celltrace::kernel::models::searcher)
