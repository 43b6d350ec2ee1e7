#include "script_player.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(cache_scripts, celltrace::test::cache_scripts)
