// SpeRecorder receives words that kernels record on the emulated machine `cell_emu`, for studies and tests.
#pragma once

#include "celltrace/export.hpp"

#include <cstdint>

namespace celltrace {

struct ScalarWork;

/// A receiver of recorded words. `source` is the recording object in the SPE's program; each kind of
/// recording object defines the meaning of its words.
class CELLTRACE_EXPORT SpeRecorder {
public:
  virtual ~SpeRecorder() = default;
  /// Receives one word. Called by the threads that run the SPEs: one at a time for one `spe`, but for several
  /// SPEs at once.
  virtual void record(unsigned spe, const void* source, std::uint32_t word) = 0;
  /// Receives every compute(), from the same threads. `work` is valid during the call only, its name for
  /// ever.
  virtual void computed(unsigned spe, const ScalarWork& work) {
    (void)spe;
    (void)work;
  }
};

} // namespace celltrace
