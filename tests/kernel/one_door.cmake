# Fails if a file of the kernel other than the one that chooses strategies asks whether memory is direct:
#
#   cmake -DKERNEL=src/kernel -P one_door.cmake
cmake_minimum_required(VERSION 3.25)

set(door ${KERNEL}/strategy.hpp)
file(GLOB_RECURSE files ${KERNEL}/*.hpp ${KERNEL}/*.cpp)
if(NOT door IN_LIST files)
  message(FATAL_ERROR "there is no ${door}")
endif()
file(STRINGS ${door} asked REGEX direct_memory)
if(NOT asked)
  message(FATAL_ERROR "${door} does not ask: this test looks for the wrong word")
endif()
list(REMOVE_ITEM files ${door})
foreach(file IN LISTS files)
  file(STRINGS ${file} lines REGEX "direct_memory")
  foreach(line IN LISTS lines)
    message(SEND_ERROR "${file}: name what a Strategy has in place of: ${line}")
  endforeach()
endforeach()

# Nor does a body choose between two of its own: a strategy has both.
foreach(room program accel shading)
  file(GLOB files ${KERNEL}/${room}/*.hpp)
  foreach(file IN LISTS files)
    file(STRINGS ${file} lines REGEX "if constexpr \\(!?k[A-Z][A-Za-z]*<Spu")
    foreach(line IN LISTS lines)
      message(SEND_ERROR "${file}: ask a Strategy in place of: ${line}")
    endforeach()
  endforeach()
endforeach()
