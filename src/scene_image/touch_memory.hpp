// Makes memory ready before threads write to all of it at once.
#pragma once

#include "memory/aligned_block.hpp"

#include <cstddef>

namespace celltrace {

/// Takes the first `bytes` bytes of memory from the system in ascending order. If records were written to
/// scattered places first, the system would make all of that memory ready at once, which nothing could
/// interrupt.
void touch(AlignedBlock& block, std::size_t bytes, unsigned threads);

} // namespace celltrace
