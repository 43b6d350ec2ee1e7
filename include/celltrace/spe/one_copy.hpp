// CELLTRACE_ONE_COPY, before a function's declaration: local store is short of code, so that on an SPU there
// is one copy of the function, and its frame is on the stack while it runs only. Elsewhere compilers decide:
// across a call, vectors of packets go through memory.
//
// Long functions that few packets need are [[gnu::noinline]] everywhere: inlined, they would take registers
// and cache from what is frequent.
#pragma once

#ifdef __SPU__
#define CELLTRACE_ONE_COPY [[gnu::noinline]]
#else
#define CELLTRACE_ONE_COPY
#endif
