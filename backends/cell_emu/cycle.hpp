// Virtual time.
#pragma once

#include <cstdint>

namespace celltrace::cell_emu {

/// SPU cycles since the machine was made.
using Cycle = std::uint64_t;
/// The time of what does not happen by itself.
constexpr Cycle kNever = ~Cycle{0};

} // namespace celltrace::cell_emu
