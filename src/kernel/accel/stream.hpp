// Sequential reads and writes of long arrays in main memory. Kernel dialect.
#pragma once

#include "celltrace/spe/types.hpp"
#include "kernel/strategy.hpp"

#include <stdint.h>

namespace celltrace::kernel {

/// Reads records of type T, whose size divides 16 KB. Uses two tags from `tag` on.
///
///   StreamReader(spu, tag)
///   for_each(source, count, visit)      calls `visit(record, index)` for every record in order. `source` is
///                                       aligned like T and at least to 16 bytes; memory up to the next
///                                       multiple of 16 bytes past the end is readable
template <class Spu, class T> using StreamReader = typename Strategy<Spu>::template StreamReader<Spu, T>;

/// Writes records of type T (8 bytes or less, a power of two) in order. Uses two tags from `tag` on.
///
///   StreamWriter(spu, tag, target)      `target` is 128-byte aligned
///   write(record)
///   flush()                             sends what is left, rounded up to 16 bytes, and waits for all of it
///   count()                             records written
template <class Spu, class T> using StreamWriter = typename Strategy<Spu>::template StreamWriter<Spu, T>;

} // namespace celltrace::kernel
