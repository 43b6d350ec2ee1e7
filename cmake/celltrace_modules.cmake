# Makes the linker script of the SPU's code modules from what src/kernel/modules.hpp says:
#
#   cmake -DHEADER=modules.hpp -DSCRIPT=modules.ld -P celltrace_modules.cmake
#
# A region is an overlay. Sections are named by -ffunction-sections and -fdata-sections, so that the names of functions,
# as the C++ ABI mangles them, become patterns of sections: each identifier with its length before it.
cmake_minimum_required(VERSION 3.25)

# The pattern of what is declared as `name`.
function(mangle variable name)
  set(pattern "*")
  set(last "")
  set(rest "${name}")
  if(rest MATCHES "^\\*(.*)") # any name that ends so
    set(rest "${CMAKE_MATCH_1}")
    string(REGEX MATCH "^[A-Za-z_0-9]+" last "${rest}")
    string(APPEND pattern "${last}")
    string(REGEX REPLACE "^[A-Za-z_0-9]+" "" rest "${rest}")
  endif()
  while(NOT rest STREQUAL "")
    if(rest MATCHES "^([A-Za-z_][A-Za-z_0-9]*)(.*)") # an identifier
      set(identifier "${CMAKE_MATCH_1}")
      set(rest "${CMAKE_MATCH_2}")
      if(identifier STREQUAL last)
        string(APPEND pattern "C[12]") # a constructor
      else()
        string(LENGTH ${identifier} length)
        string(APPEND pattern "${length}${identifier}")
      endif()
      set(last ${identifier})
    elseif(rest MATCHES "^<(.*)") # template arguments
      set(rest "${CMAKE_MATCH_1}")
      string(APPEND pattern "I*")
    elseif(rest MATCHES "^\\(([0-9]+)\\)(.*)") # a value of an enumeration
      set(rest "${CMAKE_MATCH_2}")
      string(APPEND pattern "E${CMAKE_MATCH_1}E")
    elseif(rest MATCHES "^([0-9]+)u(.*)") # a value of uint32_t
      set(rest "${CMAKE_MATCH_2}")
      string(APPEND pattern "Lj${CMAKE_MATCH_1}E")
    elseif(rest MATCHES "^(\\.[a-z0-9]+)$") # of a section's name
      set(rest "")
      string(APPEND pattern "*${CMAKE_MATCH_1}")
    elseif(rest MATCHES "^(::|>|, )(.*)")
      set(rest "${CMAKE_MATCH_2}")
    else()
      message(FATAL_ERROR "${HEADER}: '${name}' is no name that this understands")
    endif()
  endwhile()
  if(NOT pattern MATCHES "\\.[a-z0-9]+$")
    string(APPEND pattern "*")
  endif()
  string(REPLACE "**" "*" pattern "${pattern}")
  set(${variable} "${pattern}" PARENT_SCOPE)
endfunction()

# The patterns of the sections `prefix` of what a list of names says.
function(patterns_of variable prefix names)
  set(patterns "")
  # Commas between template arguments separate no names.
  string(REGEX REPLACE "(<[^<>]*),([^<>]*>)" "\\1@\\2" names "${names}")
  string(REPLACE ", " ";" names "${names}")
  foreach(name IN LISTS names)
    string(REPLACE "@" "," name "${name}")
    mangle(pattern "${name}")
    string(APPEND patterns " ${prefix}.${pattern}")
  endforeach()
  set(${variable} "${patterns}" PARENT_SCOPE)
endfunction()

file(READ ${HEADER} text)
string(REPLACE ";" "|" text "${text}")
string(REPLACE "\n" ";" lines "${text}")
set(modules "")
set(module "")
foreach(line IN LISTS lines)
  if(line MATCHES "^constexpr CodeModule [A-Za-z]+ = {\"([a-z]+)\", [0-9]+, ([0-2]), [0-9]+}")
    set(module ${CMAKE_MATCH_1})
    list(APPEND modules ${module})
    list(APPEND region_${CMAKE_MATCH_2} ${module})
    set(names_${module} "")
  elseif(module AND line MATCHES "^//   (.*)")
    string(STRIP "${names_${module}} ${CMAKE_MATCH_1}" names_${module})
  else()
    set(module "")
  endif()
endforeach()
if(NOT modules)
  message(FATAL_ERROR "${HEADER} has no code modules")
endif()

# Load addresses, which nothing loads by, lie outside local store: the linker wants them apart, also those of regions
# whose last module a program lacks.
set(script "/* Made of ${HEADER}. */\n")
set(after .text)
foreach(region 0 1 2)
  math(EXPR address "(${region} + 1) * 0x100000" OUTPUT_FORMAT HEXADECIMAL)
  string(APPEND script "SECTIONS\n{\n  OVERLAY : AT(${address})\n  {\n")
  foreach(module IN LISTS region_${region})
    if(NOT names_${module})
      message(FATAL_ERROR "${HEADER}: the module '${module}' has no functions")
    endif()
    string(REGEX MATCH "^[^|]*" functions "${names_${module}}")
    patterns_of(sections .text "${functions}")
    if(names_${module} MATCHES "\\| data: (.*)")
      patterns_of(data .rodata "${CMAKE_MATCH_1}")
      string(APPEND sections "${data}")
    endif()
    string(APPEND script "    .module.${module}\n    {\n      *(${sections} )\n    }\n")
    set(last ${module})
  endforeach()
  string(APPEND script "  }\n}\nINSERT AFTER ${after};\n")
  set(after .module.${last})
endforeach()
file(WRITE ${SCRIPT} "${script}")
