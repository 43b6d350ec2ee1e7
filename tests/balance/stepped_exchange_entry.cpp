#include "stepped_exchange.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(stepped_exchange, celltrace::test::stepped_exchange)
