// The CPUs that threads of this process run on. On systems other than Linux nobody is told where to run.
#pragma once

#include <vector>

namespace celltrace::native {

/// The numbers of those that the calling thread may run on, at least one, in rising order.
std::vector<unsigned> usable_cpus();

/// Keeps the calling thread on one of them from now on. If the system does not want that, nothing changes.
void stay_on_cpu(unsigned cpu);

} // namespace celltrace::native
