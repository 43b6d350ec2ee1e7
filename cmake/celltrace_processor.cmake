# Stops with an error where celltrace cannot be compiled, instead of leaving that to the compiler.

if(NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  message(FATAL_ERROR "celltrace: needs GCC or clang, not ${CMAKE_CXX_COMPILER_ID}")
endif()
if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64|aarch64|arm64|ppc64|powerpc64)$" OR NOT CMAKE_SIZEOF_VOID_P EQUAL 8)
  math(EXPR bits "8 * ${CMAKE_SIZEOF_VOID_P}")
  message(FATAL_ERROR "celltrace: not made for this processor, '${CMAKE_SYSTEM_PROCESSOR}' with ${bits} bits; "
    "it has to be x86-64 (in CMAKE_SYSTEM_PROCESSOR: x86_64 or AMD64), AArch64 (aarch64 or arm64) "
    "or big-endian POWER (ppc64 or powerpc64)")
endif()
