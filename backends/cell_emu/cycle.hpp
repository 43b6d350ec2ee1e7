// Virtual time.
#pragma once

#include <cstdint>

namespace celltrace::cell_emu {

/// SPU cycles since the machine was made.
using Cycle = std::uint64_t;
/// Time of an event that no passing of time brings about.
constexpr Cycle kNever = ~Cycle{0};

} // namespace celltrace::cell_emu
