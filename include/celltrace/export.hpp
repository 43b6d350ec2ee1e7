// What the shared libraries offer to others: everything is hidden but what carries CELLTRACE_EXPORT.
#pragma once

#if defined(__GNUC__) && !defined(__SPU__)
#define CELLTRACE_EXPORT __attribute__((visibility("default")))
#else
#define CELLTRACE_EXPORT
#endif
