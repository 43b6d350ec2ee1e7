// Recorders receive words from kernels that run on a machine that measures: for studies and tests.
#pragma once

#include "celltrace/export.hpp"

#include <cstdint>

namespace celltrace {

struct ScalarWork;

/// Receives the words. `source` tells apart the recording objects of one SPE's program, which define the
/// meaning of their words.
class CELLTRACE_EXPORT SpeRecorder {
public:
  virtual ~SpeRecorder() = default;
  /// Receives one word. Called by the threads that run the SPEs: one at a time for one `spe`, but for several
  /// SPEs at once.
  virtual void record(unsigned spe, const void* source, std::uint32_t word) = 0;
  /// Receives every compute(), from the same threads. `work` may be gone afterwards, its name stays.
  virtual void computed(unsigned spe, const ScalarWork& work) {
    (void)spe;
    (void)work;
  }
};

} // namespace celltrace
