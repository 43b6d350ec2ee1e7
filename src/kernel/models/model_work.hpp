// Scalar work of the stages besides that of the kernels that they share with the tracer; see scalar_work.hpp
// for the method. Kernel dialect.
#pragma once

#include "celltrace/spe/spu.hpp"

namespace celltrace::kernel::models {

namespace model_work {

// Each is {fixed, floating, memory, shuffle, branches, shift, waits, misses}.

/// A job taken, and one sent: doorbell, addresses, commands.
constexpr ScalarWork kJob = {528, 0, 341, 318, 87, 5, 1772, 179, "kJob"};
/// A search of a job, fetched and put.
constexpr ScalarWork kSearch = {169, 0, 121, 74, 34, 4, 228, 75, "kSearch"};
/// A packet's rays or answers, copied within local store.
constexpr ScalarWork kCopy = {13, 0, 94, 5, 8, 1, 9, 7, "kCopy"};
/// Rays that are handed over with their voxels.
constexpr ScalarWork kHandOver = {35, 0, 25, 6, 8, 1, 24, 22, "kHandOver"};

} // namespace model_work

} // namespace celltrace::kernel::models
