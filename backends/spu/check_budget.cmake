# Prints how much of an SPE's local store a program takes, and fails if that is more than there is.
#
#   cmake -DELF=... -DSTACK=... -DMAP=... -DARENA=bytes [-DSAID_CODE=bytes -DSAID_STACK=bytes] [-DMODULES=modules.hpp]
#     [-DFREE=bytes] -DSIZE_TOOL=spu-elf-size -DOBJDUMP_TOOL=spu-elf-objdump -P check_budget.cmake
#
# SAID_... are upper limits of the size of the program's code and data, and of its stack, which the emulator
# assumes; MODULES has upper limits of the sizes of code modules. FREE is the number of bytes that the program
# has to leave free. MAP is the linker's map. STACK is the linker's output with --stack-analysis: the worst
# call chain from the entry, crt0 included.

cmake_minimum_required(VERSION 3.25)

set(local_store 262144)

execute_process(COMMAND ${SIZE_TOOL} ${ELF} OUTPUT_VARIABLE sizes RESULT_VARIABLE failed)
if(failed OR NOT sizes MATCHES "\n *([0-9]+)[ \t]+([0-9]+)[ \t]+([0-9]+)")
  message(FATAL_ERROR "${SIZE_TOOL} cannot read ${ELF}")
endif()
set(code ${CMAKE_MATCH_1})
math(EXPR data "${CMAKE_MATCH_2} + ${CMAKE_MATCH_3} - ${ARENA}")

# Code modules are in the file; in local store the modules of a region share its place.
execute_process(COMMAND ${SIZE_TOOL} -A ${ELF} OUTPUT_VARIABLE sections)
string(REGEX MATCHALL "\\.module\\.[a-z]+ +[0-9]+ +[0-9]+" modules "${sections}")
set(regions "")
set(lines "")
foreach(module ${modules})
  string(REGEX MATCH "^([^ ]+) +([0-9]+) +([0-9]+)$" all ${module})
  set(bytes ${CMAKE_MATCH_2})
  set(at ${CMAKE_MATCH_3})
  math(EXPR code "${code} - ${bytes}")
  string(APPEND lines "    ${CMAKE_MATCH_1} ${bytes}\n")
  list(APPEND regions ${at})
  if(NOT DEFINED region_${at} OR bytes GREATER region_${at})
    set(region_${at} ${bytes})
  endif()
endforeach()
list(REMOVE_DUPLICATES regions)
set(region 0)
foreach(at ${regions})
  math(EXPR region "${region} + ${region_${at}}")
endforeach()
math(EXPR code "${code} + ${region}")

# Check that the sizes that the emulator assumes for modules are not exceeded, and that modules have different
# numbers.
if(MODULES)
  file(READ ${MODULES} said_modules)
  set(numbers "")
  foreach(module ${modules})
    string(REGEX MATCH "^\\.module\\.([a-z]+) +([0-9]+)" all ${module})
    set(name ${CMAKE_MATCH_1})
    set(bytes ${CMAKE_MATCH_2})
    if(NOT said_modules MATCHES "{\"${name}\", ([0-9]+), [0-9]+, ([0-9]+)}")
      message(FATAL_ERROR "${MODULES} has no code module '${name}'")
    endif()
    if(bytes GREATER CMAKE_MATCH_2)
      message(FATAL_ERROR "the code module '${name}' of ${ELF} takes ${bytes} bytes, not ${CMAKE_MATCH_2} at most")
    endif()
    if(CMAKE_MATCH_1 IN_LIST numbers)
      message(FATAL_ERROR "${MODULES} has two code modules of number ${CMAKE_MATCH_1}")
    endif()
    list(APPEND numbers ${CMAKE_MATCH_1})
  endforeach()
endif()

# Check that no module calls another module of its region: the callee would replace the caller, which could
# not go on.
if(modules)
  execute_process(COMMAND ${OBJDUMP_TOOL} -t ${ELF} OUTPUT_FILE ${STACK}.symbols)
  execute_process(COMMAND ${SIZE_TOOL} -A ${ELF} OUTPUT_FILE ${STACK}.sections)
  execute_process(COMMAND awk -f ${CMAKE_CURRENT_LIST_DIR}/module_calls.awk ${STACK}.sections ${STACK}.symbols ${MAP}
    OUTPUT_VARIABLE calls ERROR_VARIABLE calls RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${ELF}: ${calls}")
  endif()
endif()

file(READ ${STACK} analysis)
if(NOT analysis MATCHES "Maximum stack required is (0x[0-9a-f]+)")
  message(FATAL_ERROR "${STACK} holds no stack analysis")
endif()
math(EXPR stack "${CMAKE_MATCH_1}")

math(EXPR total "${code} + ${data} + ${ARENA} + ${stack}")
math(EXPR free "${local_store} - ${total}")
get_filename_component(name ${ELF} NAME)
message("local store of ${name}, bytes:\n"
  "  code and constants  ${code}\n"
  "    of it, regions of modules  ${region}\n${lines}"
  "  data                ${data}\n"
  "  arena               ${ARENA}\n"
  "  stack               ${stack}\n"
  "  free                ${free}")
math(EXPR program "${code} + ${data}")
if(SAID_CODE AND (program GREATER SAID_CODE OR stack GREATER SAID_STACK))
  message(FATAL_ERROR "${name} takes ${program} bytes of code and data and ${stack} of stack; its "
    "celltrace_spe_program() says ${SAID_CODE} and ${SAID_STACK}")
endif()
if(FREE AND free LESS FREE)
  message(FATAL_ERROR "${name} leaves ${free} bytes of local store, not ${FREE}")
endif()
if(free LESS 0)
  message(FATAL_ERROR "${name} takes ${total} of ${local_store} bytes")
endif()
