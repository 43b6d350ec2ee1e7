// The strategy of an SPU whose memory is direct. Kernel dialect.
#pragma once

#include "kernel/direct/memory.hpp"
#include "kernel/direct/packets.hpp"
#include "kernel/direct/patterns.hpp"
#include "kernel/direct/shapes.hpp"

namespace celltrace::kernel {

struct DirectStrategy : DirectMemory, DirectPackets, DirectPatterns, DirectShapes {};

} // namespace celltrace::kernel
