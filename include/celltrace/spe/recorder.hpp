// What kernels record while they run on a machine that measures, word by word: for studies and tests.
#pragma once

#include "celltrace/export.hpp"

#include <cstdint>

namespace celltrace {

struct ScalarWork;

/// Takes the words. `source` tells apart the objects of one SPE's program that record; what their words mean
/// is their own affair.
class CELLTRACE_EXPORT SpeRecorder {
public:
  virtual ~SpeRecorder() = default;
  /// Called by the threads that run the SPEs: by one at a time for one `spe`, but for several SPEs at once.
  virtual void record(unsigned spe, const void* source, std::uint32_t word) = 0;
  /// Hears, by the same threads, of every compute(). `work` may be gone afterwards, its name stays.
  virtual void computed(unsigned spe, const ScalarWork& work) {
    (void)spe;
    (void)work;
  }
};

} // namespace celltrace
