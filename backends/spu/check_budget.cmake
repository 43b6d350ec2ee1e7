# Prints what a program takes of an SPE's local store, and fails if that is more than there is.
#
#   cmake -DELF=... -DSTACK=... -DARENA=bytes [-DSAID_CODE=bytes -DSAID_STACK=bytes] [-DMODULES=modules.hpp]
#     [-DFREE=bytes] -DSIZE_TOOL=spu-elf-size -DNM_TOOL=spu-elf-nm
#     -DOBJDUMP_TOOL=spu-elf-objdump -P check_budget.cmake
#
# SAID_... is what the emulator takes the program's code with its data, and its stack, to be: they may not be more. The
# same is true of the code modules in MODULES. FREE is what the program has to leave.
# STACK is what the linker printed with --stack-analysis: the worst call chain from the entry, crt0 included.

cmake_minimum_required(VERSION 3.25)

set(local_store 262144)

execute_process(COMMAND ${SIZE_TOOL} ${ELF} OUTPUT_VARIABLE sizes RESULT_VARIABLE failed)
if(failed OR NOT sizes MATCHES "\n *([0-9]+)[ \t]+([0-9]+)[ \t]+([0-9]+)")
  message(FATAL_ERROR "${SIZE_TOOL} cannot read ${ELF}")
endif()
set(code ${CMAKE_MATCH_1})
math(EXPR data "${CMAKE_MATCH_2} + ${CMAKE_MATCH_3} - ${ARENA}")

# Code modules lie in the file, and in turn in one of some regions.
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

# What the emulator charges for modules is what they really take, and it knows them apart.
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

# The region that an address is in, or nothing.
function(region_of address result)
  set(${result} "" PARENT_SCOPE)
  foreach(at ${regions})
    math(EXPR end "${at} + ${region_${at}}")
    if(NOT address LESS at AND address LESS end)
      set(${result} ${at} PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# A call from one module into another of its region would return to where the first one no longer is. The linker's stubs
# for such calls lie in the modules themselves.
if(modules)
  execute_process(COMMAND ${NM_TOOL} ${ELF} OUTPUT_VARIABLE symbols)
  string(REGEX MATCHALL "[0-9a-f]+ [a-zA-Z] [0-9a-f]+\\.ovl_call[^\n]*" stubs "${symbols}")
  foreach(stub ${stubs})
    string(REGEX MATCH "^([0-9a-f]+) [a-zA-Z] ([0-9a-f]+)\\.ovl_call\\.([^\n]*)" all "${stub}")
    set(number ${CMAKE_MATCH_2})
    set(called ${CMAKE_MATCH_3})
    math(EXPR at "0x${CMAKE_MATCH_1}")
    region_of(${at} from)
    if(from STREQUAL "")
      continue()
    endif()
    string(REGEX REPLACE "([][+.*()^$?\\\\])" "\\\\\\1" pattern "${called}")
    if(symbols MATCHES "([0-9a-f]+) [tTwW] ${pattern}\n")
      math(EXPR at "0x${CMAKE_MATCH_1}")
    else()
      # Of a function without a name of its own the stub tells the address, in its own module, by number from 1 on.
      math(EXPR number "0x${number} - 1")
      list(GET modules ${number} module)
      string(REGEX MATCH "^[^ ]+" section ${module})
      math(EXPR end "${at} + 16")
      execute_process(COMMAND ${OBJDUMP_TOOL} -d -j ${section} --start-address=${at} --stop-address=${end} ${ELF}
        OUTPUT_VARIABLE instructions)
      if(NOT instructions MATCHES "ila[ \t]+\\$79,([0-9]+)")
        message(FATAL_ERROR "${ELF}: cannot tell what the stub at ${at} in ${section} calls: ${instructions}")
      endif()
      set(at ${CMAKE_MATCH_1})
    endif()
    region_of(${at} to)
    if(from STREQUAL to)
      message(FATAL_ERROR "a code module of ${ELF} calls another one of its region: ${called}")
    endif()
  endforeach()
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
