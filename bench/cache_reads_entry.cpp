#include "tests/cache/script_player.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(cache_reads, celltrace::test::cache_scripts)
