# Which parts of celltrace are built, as CELLTRACE_COMPONENTS says; each finds only the libraries that it needs itself.
#
#   celltrace  parsing and rendering, with emulator and cache
#   emulator   machines with emulated and simulated SPEs, and SPEs of threads
#   cache      traces of software caches and their replay, and the caches' headers
#   balance    the balancer's headers
#   sdk        the headers of the SDK's names, with emulator
#   program    the program celltrace, with everything else
#
# The result has the components that those named need. CELLTRACE_WHOLE is true where celltrace is built for its own sake
# and whole.

set(CELLTRACE_ALL_COMPONENTS celltrace emulator cache balance sdk program)
set(CELLTRACE_COMPONENTS ${CELLTRACE_ALL_COMPONENTS} CACHE STRING
  "Parts to build: celltrace, emulator, cache, balance, sdk, program")

foreach(component IN LISTS CELLTRACE_COMPONENTS)
  if(NOT component IN_LIST CELLTRACE_ALL_COMPONENTS)
    list(JOIN CELLTRACE_ALL_COMPONENTS ", " known)
    message(FATAL_ERROR "celltrace: CELLTRACE_COMPONENTS: '${component}' is none of ${known}")
  endif()
endforeach()
if("program" IN_LIST CELLTRACE_COMPONENTS)
  set(CELLTRACE_COMPONENTS ${CELLTRACE_ALL_COMPONENTS})
endif()
if("celltrace" IN_LIST CELLTRACE_COMPONENTS)
  list(APPEND CELLTRACE_COMPONENTS emulator cache)
endif()
if("sdk" IN_LIST CELLTRACE_COMPONENTS)
  list(APPEND CELLTRACE_COMPONENTS emulator)
endif()
list(REMOVE_DUPLICATES CELLTRACE_COMPONENTS)

set(CELLTRACE_WHOLE OFF)
if(PROJECT_IS_TOP_LEVEL AND "program" IN_LIST CELLTRACE_COMPONENTS)
  set(CELLTRACE_WHOLE ON)
endif()
