// The strategy of an SPU that has a local store. Kernel dialect.
#pragma once

#include "kernel/local/memory.hpp"
#include "kernel/local/packets.hpp"
#include "kernel/local/patterns.hpp"

namespace celltrace::kernel {

struct LocalStrategy : LocalMemory, LocalPackets, LocalPatterns {};

} // namespace celltrace::kernel
