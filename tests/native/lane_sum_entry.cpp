#include "lane_sum.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(lane_sum, celltrace::test::lane_sum)
