// Marks what the shared libraries export: everything without CELLTRACE_EXPORT is hidden.
#pragma once

#if defined(__GNUC__) && !defined(__SPU__)
#define CELLTRACE_EXPORT __attribute__((visibility("default")))
#else
#define CELLTRACE_EXPORT
#endif
