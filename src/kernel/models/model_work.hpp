// Scalar work of the stages besides that of the kernels that they share with the tracer; see scalar_work.hpp
// for the method. Kernel dialect.
#pragma once

#include "celltrace/spe/spu.hpp"

namespace celltrace::kernel::models {

namespace model_work {

// Each is {fixed, floating, memory, shuffle, branches}.

/// A job taken, and one sent: doorbell, addresses, commands.
constexpr ScalarWork kJob = {150, 0, 90, 75, 16, 0, "kJob"};
/// A search of a job, fetched and put.
constexpr ScalarWork kSearch = {80, 0, 60, 45, 8, 0, "kSearch"};
/// A packet's rays or answers, copied within local store.
constexpr ScalarWork kCopy = {12, 0, 56, 0, 1, 0, "kCopy"};
/// Rays that are handed over with their voxels.
constexpr ScalarWork kHandOver = {25, 2, 24, 14, 3, 0, "kHandOver"};

} // namespace model_work

} // namespace celltrace::kernel::models
