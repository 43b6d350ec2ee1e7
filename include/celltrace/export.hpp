// CELLTRACE_EXPORT marks symbols that the shared libraries export; all other symbols are hidden.
#pragma once

#if defined(__GNUC__) && !defined(__SPU__)
#define CELLTRACE_EXPORT __attribute__((visibility("default")))
#else
#define CELLTRACE_EXPORT
#endif
