// A software cache of main memory in local store: n-way set associative, lines of 128 bytes, the tags of a
// set compared by SIMD instructions. Freestanding C++17 (kernel dialect); needs an Spu (spe/spu.hpp), but not
// the tracer. docs/software-cache.md is the guide.
//
// On the host, celltrace/cache/trace.hpp and celltrace/cache/replay.hpp record the requests to a cache and
// replay them through caches of other shapes.
#pragma once

#include "celltrace/cache/config.hpp"
#include "celltrace/cache/software_cache.hpp"
#include "celltrace/cache/word_run.hpp"
