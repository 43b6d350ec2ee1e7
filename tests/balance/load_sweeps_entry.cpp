#include "load_sweeps.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(load_sweeps, celltrace::test::load_sweeps)
