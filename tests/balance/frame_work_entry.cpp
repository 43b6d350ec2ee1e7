#include "frame_work.hpp"

#include "backends/spe_entry.hpp"

CELLTRACE_SPE_ENTRY(frame_work, celltrace::test::frame_work)
