// Offsets in a scene image. Kernel dialect.
#pragma once

#include <stdint.h>

namespace celltrace::kernel {

constexpr uint32_t kNoOffset = 0xFFFFFFFFu;
constexpr uint32_t kNoGroup = 0xFFFFFFFFu;

} // namespace celltrace::kernel
