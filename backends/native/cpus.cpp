#include "backends/native/cpus.hpp"

#include <algorithm>
#include <numeric>
#include <thread>

#if defined(__linux__)
#include <sched.h>
#endif

namespace celltrace::native {

std::vector<unsigned> usable_cpus() {
  std::vector<unsigned> cpus;
#if defined(__linux__)
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0)
    for (unsigned cpu = 0; cpu < CPU_SETSIZE; ++cpu)
      if (CPU_ISSET(cpu, &set)) cpus.push_back(cpu);
#endif
  if (cpus.empty()) {
    cpus.resize(std::max(std::thread::hardware_concurrency(), 1u));
    std::iota(cpus.begin(), cpus.end(), 0);
  }
  return cpus;
}

void stay_on_cpu([[maybe_unused]] unsigned cpu) {
#if defined(__linux__)
  if (cpu >= CPU_SETSIZE) return;
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(cpu, &set);
  sched_setaffinity(0, sizeof set, &set);
#endif
}

} // namespace celltrace::native
