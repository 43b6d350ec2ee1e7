# Compiler settings shared by every target of the project, and the function that makes one of its rooms.

add_library(celltrace_options INTERFACE)
target_compile_features(celltrace_options INTERFACE cxx_std_20)
# The kernels give the same bits on every backend only if no compiler fuses multiply and add on its own.
target_compile_options(celltrace_options INTERFACE
  -Wall -Wextra -Wpedantic -Wnon-virtual-dtor -ffp-contract=off ${CELLTRACE_BASELINE_OPTIONS})
if(CELLTRACE_BASELINE_SIMD STREQUAL "avx512")
  target_compile_options(celltrace_options INTERFACE ${CELLTRACE_AVX512_WARNINGS})
endif()
if(NOT CELLTRACE_UNITY)
  target_compile_options(celltrace_options INTERFACE -Wshadow)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Sources look like headers, whose classes were to have no member of an anonymous namespace's type.
  target_compile_options(celltrace_options INTERFACE -Wno-subobject-linkage -Wshadow=local)
endif()
if(CELLTRACE_WERROR)
  target_compile_options(celltrace_options INTERFACE -Werror)
endif()
if(CELLTRACE_SANITIZE)
  target_compile_options(celltrace_options INTERFACE
    -fsanitize=${CELLTRACE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  if(CELLTRACE_NO_SANITIZE)
    target_compile_options(celltrace_options INTERFACE -fno-sanitize=${CELLTRACE_NO_SANITIZE})
  endif()
  target_link_options(celltrace_options INTERFACE -fsanitize=${CELLTRACE_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Instrumented code makes GCC 12 report the standard library's own <regex>.
    target_compile_options(celltrace_options INTERFACE -Wno-maybe-uninitialized)
  endif()
endif()

if(CELLTRACE_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "celltrace: CELLTRACE_FUZZ needs clang, whose libFuzzer it uses")
  endif()
endif()

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  if(PROJECT_IS_TOP_LEVEL)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
  else()
    message(STATUS "celltrace: CMAKE_BUILD_TYPE is empty; without optimisation rays take ten times as long")
  endif()
endif()
set(CMAKE_CXX_EXTENSIONS OFF)
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
endif()

# Everything can become part of a shared library, or of a plugin that links static ones. Hidden, no function of the
# tracer is called through tables for it; and thread-local objects have a fixed place, at the price of a few hundred
# bytes of the memory that the system keeps for such.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
target_compile_options(celltrace_options INTERFACE -ftls-model=initial-exec)

# With CELLTRACE_UNITY, compiles a target's sources BATCH at a time, but for those that are APART.
function(celltrace_unity target)
  cmake_parse_arguments(UNITY "" "BATCH" "APART" ${ARGN})
  if(UNITY_APART)
    set_source_files_properties(${UNITY_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${CELLTRACE_UNITY} UNITY_BUILD_BATCH_SIZE ${UNITY_BATCH})
endfunction()

# A room of the house: a static library celltrace_NAME whose headers are found from the root of src/, backends/ and
# include/. The project's own warnings do not reach whoever links it. Sources that are APART name what others name, too:
# they are never compiled together with them.
function(celltrace_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;APART;LINK" ${ARGN})
  add_library(celltrace_${name} STATIC ${ROOM_SOURCES} ${ROOM_APART})
  celltrace_unity(celltrace_${name} BATCH 12 APART ${ROOM_APART})
  target_include_directories(celltrace_${name} PUBLIC
    ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
  target_compile_features(celltrace_${name} PUBLIC cxx_std_20)
  target_link_libraries(celltrace_${name} PRIVATE celltrace_options PUBLIC ${ROOM_LINK})
  if(CELLTRACE_FUZZ)
    # What branches on what a scene says; the kernels, whose lanes hardly branch, would take a tenth longer.
    target_compile_options(celltrace_${name} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
endfunction()
