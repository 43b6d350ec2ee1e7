// From the kinds of patterns as people write them to those of the kernel.
#pragma once

#include "celltrace/texture.hpp"

#include <cstdint>

namespace celltrace {

/// The kind's number in PatternRecords; its parameters go to `parameter`. Throws InputError if the kernel has
/// no such pattern.
std::uint32_t pattern_parameters(const pattern::Kind& kind, float (&parameter)[6]);

} // namespace celltrace
