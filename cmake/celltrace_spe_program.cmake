# Compiles SPE programs for every SPU type of the build.
#
#   celltrace_spe_program(NAME [HOT] [LEVEL -On] SOURCE entry.cpp [SPUS types...] [CODE_BYTES n STACK_BYTES n]
#     [SPU_HEADER kernel.hpp SPU_KERNEL qualified::function [SPU_ARENA bytes] [SPU_MODULES modules.hpp]] [LINK targets...])
#
# makes the static library celltrace_NAME_program. CODE_BYTES (with data) and STACK_BYTES are what the program takes of
# a real SPE's local store; celltrace_spu_budget_test() of the same name holds them against the real build. HOT: what
# users wait for, which may take longer to compile. LEVEL: of optimisation, in place of the build's. The source says
# which kernel it is:
#
#   #include "kernel/program/tracer.hpp"
#   #include "backends/spe_entry.hpp"
#   CELLTRACE_SPE_ENTRY(NAME, celltrace::kernel::tracer)
#
# and is compiled once per SPU type, or for those of SPUS only, each time with the flags of its CPU and with
#
#   CELLTRACE_SPU_HEADER   header of the SPU type, for #include
#   CELLTRACE_SPU_TYPE     the type, qualified
#   CELLTRACE_SPU_NAME     an identifier for it, as in the lists below
#
# The library defines `celltrace::SpeProgram celltrace::NAME_program()` with all entries; its user declares it.
#
# SPU_HEADER and SPU_KERNEL say the same kernel to the real SPU's compiler: celltrace_spu_elf(NAME) makes an ELF of it,
# which is the program's image for machines that execute machine code (`cell_sim`). Without that compiler there is none.

# CELLTRACE_BASELINE_SPU is the SPU type of `native` that every CPU of this build has: that of C++'s BaselineArch.

# Per SPU type: its header, type, key and flags, and more flags for hot programs.
set(CELLTRACE_SPUS "" CACHE INTERNAL "SPU types of this build")
function(celltrace_spu_type name)
  cmake_parse_arguments(SPU "" "HEADER;TYPE;KEY" "FLAGS;HOT_FLAGS" ${ARGN})
  set(CELLTRACE_SPUS ${CELLTRACE_SPUS} ${name} CACHE INTERNAL "SPU types of this build")
  foreach(property HEADER TYPE KEY FLAGS HOT_FLAGS)
    set(CELLTRACE_SPU_${name}_${property} "${SPU_${property}}" CACHE INTERNAL "")
  endforeach()
endfunction()

set(native_flags "")
set(hot_flags "")
set(wide_hot_flags "")
set(wide_flags "")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # A program is one translation unit, and GCC stops inlining what is called for every packet where the unit grows by
  # more than 40 %: rays then take 2 to 4 % longer.
  set(native_flags --param=inline-unit-growth=100)
  # Hot programs: vectors of packets go through memory across a call, so that larger functions are inlined than is usual
  # (30 instructions). Where one register holds a packet or half of it: AVX2 takes 12 % less time, AVX-512 6 %, for a
  # program that is half as large again; limits of 200 and 500 are slower than that. With narrower registers 100
  # instructions are as good as 400, 3 %, and compile in less time.
  set(hot_flags --param=inline-unit-growth=600 --param=max-inline-insns-auto=100)
  set(wide_hot_flags --param=inline-unit-growth=600 --param=max-inline-insns-auto=400)
  # Rays are copied by vectors: REP MOVS, GCC's way for anything larger, takes longer to start than to copy a packet.
  set(wide_flags -mmemcpy-strategy=vector_loop:-1:noalign)
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(CELLTRACE_BASELINE_SPU native_${CELLTRACE_BASELINE_SIMD} CACHE INTERNAL "")
  if(CELLTRACE_BASELINE_SIMD STREQUAL "sse2")
    celltrace_spu_type(native_sse2 HEADER backends/native/spu.hpp KEY native.sse2
      TYPE "celltrace::native::Spu<xsimd::sse2>" FLAGS ${native_flags} HOT_FLAGS ${hot_flags})
  endif()
  if(CELLTRACE_BASELINE_SIMD STREQUAL "avx2" OR (CELLTRACE_WIDE_SIMD AND CELLTRACE_BASELINE_SIMD STREQUAL "sse2"))
    celltrace_spu_type(native_avx2 HEADER backends/native/spu.hpp KEY native.avx2
      TYPE "celltrace::native::Spu<xsimd::avx2>"
      FLAGS ${native_flags} ${CELLTRACE_AVX2_FLAGS} ${wide_flags} HOT_FLAGS ${wide_hot_flags})
  endif()
  if(CELLTRACE_BASELINE_SIMD STREQUAL "avx512" OR CELLTRACE_WIDE_SIMD)
    celltrace_spu_type(native_avx512 HEADER backends/native/spu.hpp KEY native.avx512
      TYPE "celltrace::native::Spu<xsimd::avx512dq>"
      FLAGS ${native_flags} ${CELLTRACE_AVX512_FLAGS} ${wide_flags} ${CELLTRACE_AVX512_WARNINGS} HOT_FLAGS ${wide_hot_flags})
  endif()
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  set(CELLTRACE_BASELINE_SPU native_neon64 CACHE INTERNAL "")
  celltrace_spu_type(native_neon64 HEADER backends/native/spu.hpp KEY native.neon64
    TYPE "celltrace::native::Spu<xsimd::neon64>" FLAGS ${native_flags} HOT_FLAGS ${hot_flags})
else()
  set(CELLTRACE_GENERIC_SIMD ON) # there is no other
  set(CELLTRACE_BASELINE_SPU native_generic CACHE INTERNAL "")
endif()
if(CELLTRACE_GENERIC_SIMD)
  celltrace_spu_type(native_generic HEADER backends/native/spu.hpp KEY native.generic
    TYPE "celltrace::native::Spu<celltrace::GenericArch>" FLAGS ${native_flags} HOT_FLAGS ${hot_flags})
endif()
celltrace_spu_type(cell_emu HEADER celltrace/spe/emulated_spu.hpp KEY cell_emu TYPE "celltrace::cell_emu::Spu")

function(celltrace_spe_program name)
  cmake_parse_arguments(PROGRAM "HOT" "LEVEL;SOURCE;CODE_BYTES;STACK_BYTES;SPU_HEADER;SPU_KERNEL;SPU_ARENA;SPU_MODULES" "LINK;SPUS" ${ARGN})
  if(NOT PROGRAM_SPUS)
    set(PROGRAM_SPUS ${CELLTRACE_SPUS})
  endif()
  set(local_store_use "")
  if(PROGRAM_CODE_BYTES)
    set(local_store_use "  program.takes({${PROGRAM_CODE_BYTES}, ${PROGRAM_STACK_BYTES}});\n")
    set_property(GLOBAL PROPERTY CELLTRACE_${name}_CODE_BYTES ${PROGRAM_CODE_BYTES})
    set_property(GLOBAL PROPERTY CELLTRACE_${name}_STACK_BYTES ${PROGRAM_STACK_BYTES})
  endif()
  set(library celltrace_${name}_program)
  set(parts "")
  set(declarations "")
  set(entries "")
  set(objects "")
  foreach(spu ${PROGRAM_SPUS})
    set(object ${library}_${spu})
    add_library(${object} OBJECT ${PROGRAM_SOURCE})
    target_link_libraries(${object} PUBLIC celltrace_options celltrace_native celltrace_cell_emu ${PROGRAM_LINK})
    target_compile_options(${object} PRIVATE ${CELLTRACE_SPU_${spu}_FLAGS} ${PROGRAM_LEVEL})
    if(PROGRAM_HOT)
      target_compile_options(${object} PRIVATE ${CELLTRACE_SPU_${spu}_HOT_FLAGS})
    endif()
    target_compile_definitions(${object} PRIVATE
      "CELLTRACE_SPU_HEADER=\"${CELLTRACE_SPU_${spu}_HEADER}\""
      "CELLTRACE_SPU_TYPE=${CELLTRACE_SPU_${spu}_TYPE}"
      CELLTRACE_SPU_NAME=${spu})
    string(APPEND declarations "void ${name}_${spu}(void* spu, ea_t argument);\n")
    string(APPEND entries "  program.add(\"${CELLTRACE_SPU_${spu}_KEY}\", ${name}_${spu});\n")
    list(APPEND parts ${object})
    list(APPEND objects $<TARGET_OBJECTS:${object}>)
  endforeach()
  set(image "")
  if(PROGRAM_SPU_KERNEL AND CELLTRACE_SPU_GXX)
    celltrace_spu_elf(${name} HEADER ${PROGRAM_SPU_HEADER} KERNEL ${PROGRAM_SPU_KERNEL} ARENA ${PROGRAM_SPU_ARENA}
      MODULES ${PROGRAM_SPU_MODULES})
    celltrace_spu_elf_source(elf_source ${name})
    list(APPEND objects ${elf_source})
    string(APPEND declarations "std::span<const std::uint8_t> ${name}_elf();\n")
    set(image "  program.add_image(\"cell_sim\", ${name}_elf());\n")
  endif()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}_program.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [=[
#include "celltrace/spe/program.hpp"

namespace celltrace {

@declarations@
SpeProgram @name@_program();
SpeProgram @name@_program() {
  SpeProgram program("@name@");
@entries@@image@@local_store_use@  return program;
}

} // namespace celltrace
]=])
  add_library(${library} STATIC ${source} ${objects})
  set_target_properties(${library} PROPERTIES CELLTRACE_PARTS "${parts}")
  target_link_libraries(${library}
    PRIVATE celltrace_options PUBLIC celltrace_native celltrace_cell_emu ${PROGRAM_LINK})
  if(image)
    # Make would otherwise let both targets make the ELF at a time.
    add_dependencies(${library} celltrace_spu_${name})
  endif()
endfunction()
