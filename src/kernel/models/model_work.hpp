// Charges for scalar work of the stages in addition to that of the kernels that they share with the tracer;
// see scalar_work.hpp for the method. Kernel dialect.
#pragma once

#include "celltrace/spe/spu.hpp"

namespace celltrace::kernel::models {

namespace model_work {

// Each constant is {fixed, floating, memory, shuffle, branches, shift, waits, misses}.

/// Taking and sending a job: doorbell, addresses, commands.
constexpr ScalarWork kJob = {0, 0, 0, 23, 21, 17, 0, 163, "kJob"};
/// Fetching and putting a search of a job.
constexpr ScalarWork kSearch = {503, 0, 269, 187, 78, 13, 1049, 222, "kSearch"};
/// Copying a packet's rays or answers within local store.
constexpr ScalarWork kCopy = {0, 0, 0, 0, 0, 3, 0, 0, "kCopy"};
/// Handing over rays with their voxels.
constexpr ScalarWork kHandOver = {189, 0, 90, 22, 28, 3, 150, 60, "kHandOver"};

} // namespace model_work

} // namespace celltrace::kernel::models
