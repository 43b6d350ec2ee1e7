#include "facade_probe.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(facade, celltrace::test::facade)
