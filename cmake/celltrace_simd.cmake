# The compiler's flags for the instruction sets of x86 that there are kernels for, and which of these all code may use.
#
# CELLTRACE_AVX2_FLAGS and CELLTRACE_AVX512_FLAGS; CELLTRACE_AVX512_WARNINGS goes with the latter behind other warnings.
# CELLTRACE_BASELINE_OPTIONS is for whatever includes the SDK's headers, here and where they are installed: BaselineArch
# is part of types there. Empty for SSE2, which any x86 has.

# Processors with AVX2 know PREFETCHW, or take it for nothing.
set(CELLTRACE_AVX2_FLAGS -mavx2 -mprfchw)
set(CELLTRACE_AVX512_FLAGS -mavx512f -mavx512cd -mavx512dq -mavx512bw -mavx512vl -mprfchw -mprefer-vector-width=512)
set(CELLTRACE_AVX512_WARNINGS "")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports the undefined operands of its own headers.
  set(CELLTRACE_AVX512_WARNINGS -Wno-uninitialized -Wno-maybe-uninitialized)
endif()

set(CELLTRACE_BASELINE_OPTIONS "")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  if(CELLTRACE_BASELINE_SIMD STREQUAL "avx2")
    set(CELLTRACE_BASELINE_OPTIONS ${CELLTRACE_AVX2_FLAGS} -DCELLTRACE_BASELINE_AVX2)
  elseif(CELLTRACE_BASELINE_SIMD STREQUAL "avx512")
    set(CELLTRACE_BASELINE_OPTIONS ${CELLTRACE_AVX512_FLAGS} -DCELLTRACE_BASELINE_AVX512)
  elseif(NOT CELLTRACE_BASELINE_SIMD STREQUAL "sse2")
    message(FATAL_ERROR "celltrace: CELLTRACE_BASELINE_SIMD is '${CELLTRACE_BASELINE_SIMD}'; "
      "it has to be sse2, avx2 or avx512")
  endif()
endif()
