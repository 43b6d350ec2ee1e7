// Finds usable CPUs, and binds threads to CPUs. On systems other than Linux threads are not bound.
#pragma once

#include <vector>

namespace celltrace::native {

/// Returns the numbers of the CPUs that the calling thread may run on, at least one, in ascending order.
std::vector<unsigned> usable_cpus();

/// Binds the calling thread to a CPU from now on. If the system refuses, nothing changes.
void stay_on_cpu(unsigned cpu);

} // namespace celltrace::native
