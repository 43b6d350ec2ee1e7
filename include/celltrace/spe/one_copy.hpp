// CELLTRACE_ONE_COPY, before a function's declaration, forbids inlining on an SPU: local store is short of
// code, so there is one copy of the function, and its frame is on the stack only while it runs. Elsewhere
// compilers decide, because vectors of packets go through memory across a call.
//
// Long functions that few packets need are [[gnu::noinline]] on all targets: inlined, they would take
// registers and cache from frequent code.
#pragma once

#ifdef __SPU__
#define CELLTRACE_ONE_COPY [[gnu::noinline]]
#else
#define CELLTRACE_ONE_COPY
#endif
