#include "traversal_probe.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(traversal, celltrace::test::traversal)
