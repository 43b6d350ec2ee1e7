// Makes memory ready before threads write to all of it at once.
#pragma once

#include "memory/aligned_block.hpp"

#include <cstddef>

namespace celltrace {

/// Takes the first `bytes` bytes of memory from the system in their order. Where records are sent anywhere,
/// the first few of them would have it make all of that memory ready, which nothing could interrupt.
void touch(AlignedBlock& block, std::size_t bytes, unsigned threads);

} // namespace celltrace
