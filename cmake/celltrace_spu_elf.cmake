# Compiles kernels for the real SPU with CELLTRACE_SPU_GXX.
#
#   celltrace_spu_elf(NAME HEADER kernel.hpp KERNEL qualified::function [ARENA bytes] [MODULES modules.hpp])
#
# makes the target celltrace_spu_NAME, part of `all`: NAME.elf, NAME.map (the linker's map, with the stack that every
# function needs) and NAME.stack.txt in the current binary directory. The header is looked for in the current source
# directory too. The ELF names functions and lines; that is no part of what is loaded. MODULES puts functions into code
# modules: a linker script with overlays, each in an output section .module.NAME, all of one region.
#
#   celltrace_spu_elf_source(VARIABLE NAME)
#
# sets VARIABLE to a C++ source, made when the ELF has been, that defines
# `std::span<const std::uint8_t> celltrace::NAME_elf()`: its bytes. For a target of the same directory.
#
#   celltrace_spu_budget_test("test name" NAME [FREE bytes])
#
# checks in CTest that code, data, arena and stack of NAME fit the local store together and leave FREE bytes, that they
# are not more than celltrace_spe_program(NAME) says, if it says something, and that code modules are what the header
# beside the script says, of the same name but .hpp. Without a compiler all of this does nothing but to register a test
# that is skipped.

# What stays of the 256 KB for code, data and stack is 154 KB.
set(CELLTRACE_SPU_ARENA_BYTES 104960 CACHE STRING "Local store for the kernel's arena in programs for the real SPU")

function(celltrace_spu_elf name)
  cmake_parse_arguments(ELF "" "HEADER;KERNEL;ARENA;MODULES" "" ${ARGN})
  if(NOT CELLTRACE_SPU_GXX)
    return()
  endif()
  if(NOT ELF_ARENA)
    set(ELF_ARENA ${CELLTRACE_SPU_ARENA_BYTES})
  endif()
  set(includes "")
  foreach(directory ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}
      ${CMAKE_CURRENT_SOURCE_DIR})
    list(APPEND includes -I${directory})
  endforeach()
  set(main ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../backends/spu/main.cpp)
  # Of local store these save 7 KB of the tracer, and take no more than 0.5 % of its cycles: fewer values that wait for
  # their use on the stack, and no instructions that do nothing but to pair others.
  set(optimisation -O2 -fno-move-loop-invariants -fno-tree-pre -mdual-nops=0)
  # Of functions that are the same in two code modules each calls its own.
  list(APPEND optimisation -fno-ipa-icf)
  set(base ${CMAKE_CURRENT_BINARY_DIR}/${name})
  add_custom_command(
    OUTPUT ${base}.o
    COMMAND ${CELLTRACE_SPU_GXX} -std=c++17 ${optimisation} -g1 -Wall -Wextra -Werror -fno-exceptions -fno-rtti
      -fno-threadsafe-statics -ffunction-sections -fdata-sections
      -fdebug-prefix-map=${PROJECT_BINARY_DIR}=. -fdebug-prefix-map=${PROJECT_SOURCE_DIR}/= ${includes}
      "-DCELLTRACE_SPU_KERNEL_HEADER=\"${ELF_HEADER}\"" -DCELLTRACE_SPU_KERNEL=${ELF_KERNEL}
      -DCELLTRACE_SPU_ARENA_BYTES=${ELF_ARENA} -MD -MF ${base}.d -MT ${base}.o
      -c ${main} -o ${base}.o
    DEPENDS ${main} DEPFILE ${base}.d
    COMMENT "Compiling ${name} for the SPU" VERBATIM)
  set(modules "")
  set(modules_script "")
  if(ELF_MODULES)
    set(modules_script ${base}.modules.ld)
    set(maker ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/celltrace_modules.cmake)
    add_custom_command(
      OUTPUT ${modules_script}
      COMMAND ${CMAKE_COMMAND} -DHEADER=${ELF_MODULES} -DSCRIPT=${modules_script} -P ${maker}
      DEPENDS ${ELF_MODULES} ${maker} COMMENT "Making the linker script of ${name}'s code modules" VERBATIM)
    set(modules ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../backends/spu/modules.S
      -Wl,-T,${modules_script} -Wl,-u,__ovly_load -Wl,-u,__ovly_return
      -Wl,--emit-stub-syms) # stubs are made when unused sections are gone
  endif()
  add_custom_command(
    OUTPUT ${base}.elf
    BYPRODUCTS ${base}.map ${base}.stack.txt
    COMMAND ${CELLTRACE_SPU_GXX} -Wl,--gc-sections -Wl,--stack-analysis -Wl,-Map,${base}.map ${modules}
      ${name}.o -o ${name}.elf > ${name}.stack.txt # whose name as given here becomes part of it
    DEPENDS ${base}.o ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../backends/spu/modules.S ${modules_script} WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}
    COMMENT "Linking ${name} for the SPU" VERBATIM)
  add_custom_target(celltrace_spu_${name} ALL DEPENDS ${base}.elf)
  set_target_properties(celltrace_spu_${name} PROPERTIES CELLTRACE_BASE ${base} CELLTRACE_ARENA ${ELF_ARENA}
    CELLTRACE_MODULES "${ELF_MODULES}")
endfunction()

function(celltrace_spu_elf_source variable name)
  get_target_property(base celltrace_spu_${name} CELLTRACE_BASE)
  set(script ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/bytes_as_source.cmake)
  add_custom_command(
    OUTPUT ${base}_elf.cpp
    COMMAND ${CMAKE_COMMAND} -DINPUT=${base}.elf -DFUNCTION=${name}_elf -DOUTPUT=${base}_elf.cpp -P ${script}
    DEPENDS ${base}.elf ${script} VERBATIM)
  set(${variable} ${base}_elf.cpp PARENT_SCOPE)
endfunction()

function(celltrace_spu_budget_test test name)
  if(NOT CELLTRACE_SPU_GXX)
    add_test(NAME ${test} COMMAND ${CMAKE_COMMAND} -E echo "skipped: set CELLTRACE_SPU_GXX to spu-elf-g++")
    set_tests_properties(${test} PROPERTIES SKIP_REGULAR_EXPRESSION "skipped:")
    return()
  endif()
  get_target_property(base celltrace_spu_${name} CELLTRACE_BASE)
  get_target_property(arena celltrace_spu_${name} CELLTRACE_ARENA)
  get_target_property(modules celltrace_spu_${name} CELLTRACE_MODULES)
  cmake_parse_arguments(TEST "" "FREE" "" ${ARGN})
  set(check ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../backends/spu/check_budget.cmake)
  get_property(said_code GLOBAL PROPERTY CELLTRACE_${name}_CODE_BYTES)
  get_property(said_stack GLOBAL PROPERTY CELLTRACE_${name}_STACK_BYTES)
  string(REGEX REPLACE "g\\+\\+$" "size" size_tool ${CELLTRACE_SPU_GXX})
  string(REGEX REPLACE "g\\+\\+$" "objdump" objdump_tool ${CELLTRACE_SPU_GXX})
  add_test(NAME ${test} COMMAND ${CMAKE_COMMAND}
    -DELF=${base}.elf -DSTACK=${base}.stack.txt -DARENA=${arena} -DSAID_CODE=${said_code}
    -DSAID_STACK=${said_stack} -DMODULES=${modules} -DFREE=${TEST_FREE} -DSIZE_TOOL=${size_tool}
    -DMAP=${base}.map -DOBJDUMP_TOOL=${objdump_tool} -P ${check})
endfunction()
