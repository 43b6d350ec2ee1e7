# Builds a project that uses celltrace in a folder of its own, and runs it:
#
#   cmake -DCONSUMER=folder -DWORK=folder -DCOMPILER=... [-DLAUNCHER=...] [-DPREFIX=installed] [-DTARGET=consumer]
#     [-DARGUMENTS=a,b] [-DPKG_CONFIG=module] -P run.cmake
#
# With PKG_CONFIG main.cpp is compiled with what pkg-config says of this module, without CMake. A consumer that builds
# celltrace, too, takes
#
#   -DSOURCE=celltrace -DPROGRAM=main.cpp -DCOMPONENTS=a,b [-DWITHOUT=packages,which,are,hidden] [-DOPTIONS=-Da=b,-Dc=d]
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed with ${result}: ${command}")
  endif()
endfunction()

if(NOT TARGET)
  set(TARGET consumer)
endif()
foreach(list ARGUMENTS WITHOUT OPTIONS)
  string(REPLACE "," ";" ${list} "${${list}}")
endforeach()
string(REPLACE "," "\\;" COMPONENTS "${COMPONENTS}") # one argument
if(SOURCE)
  list(APPEND OPTIONS -DCELLTRACE_SOURCE=${SOURCE} -DPROGRAM=${PROGRAM} "-DCOMPONENTS=${COMPONENTS}")
endif()
foreach(package IN LISTS WITHOUT)
  list(APPEND OPTIONS -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/build)
file(COPY ${CONSUMER}/ DESTINATION ${WORK}/source)

if(PKG_CONFIG)
  file(GLOB_RECURSE files ${PREFIX}/celltrace*.pc)
  list(GET files 0 file)
  cmake_path(GET file PARENT_PATH folder)
  set(ENV{PKG_CONFIG_PATH} ${folder})
  execute_process(COMMAND pkg-config --cflags --libs ${PKG_CONFIG} OUTPUT_VARIABLE flags
    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  cmake_path(GET folder PARENT_PATH libraries)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run(${COMPILER} -std=c++20 -O1 source/main.cpp -o build/${TARGET} ${flags} -Wl,-rpath,${libraries})
else()
  set(arguments -DCMAKE_CXX_COMPILER=${COMPILER} "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" -DCMAKE_PREFIX_PATH=${PREFIX})
  execute_process(COMMAND ${CMAKE_COMMAND} -G Ninja -S source -B build ${arguments} ${OPTIONS}
    WORKING_DIRECTORY ${WORK} COMMAND_ERROR_IS_FATAL ANY)
  run(${CMAKE_COMMAND} --build build --target ${TARGET})
endif()
run(${WORK}/build/${TARGET} ${ARGUMENTS})
