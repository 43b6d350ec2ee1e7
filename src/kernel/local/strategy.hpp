// The strategy of an SPU that has a local store. Kernel dialect.
#pragma once

#include "kernel/local/memory.hpp"
#include "kernel/local/packets.hpp"
#include "kernel/local/patterns.hpp"
#include "kernel/local/shapes.hpp"

namespace celltrace::kernel {

struct LocalStrategy : LocalMemory, LocalPackets, LocalPatterns, LocalShapes {};

} // namespace celltrace::kernel
