// CELLTRACE_ONE_COPY, before a function's declaration, forbids inlining on an SPU: local store is short of
// code, a function that is not inlined has one copy, and its frame is on the stack only while it runs. On
// other targets compilers may inline, because a call would pass vectors of packets through memory.
//
// Long functions that few packets need are [[gnu::noinline]] on all targets: inlined, they would take
// registers and cache from frequent code.
#pragma once

#ifdef __SPU__
#define CELLTRACE_ONE_COPY [[gnu::noinline]]
#else
#define CELLTRACE_ONE_COPY
#endif
