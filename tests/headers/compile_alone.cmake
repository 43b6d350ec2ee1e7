# Compiles every public header alone, with nothing of the project but public headers in reach:
#
#   cmake -DCOMPILER=g++ [-DLAUNCHER=ccache] -DHEADERS=include -DGENERATED=include -DWORK=folder -P compile_alone.cmake
cmake_minimum_required(VERSION 3.25)

file(MAKE_DIRECTORY ${WORK})
file(GLOB_RECURSE headers RELATIVE ${HEADERS} ${HEADERS}/celltrace/*.h ${HEADERS}/celltrace/*.hpp)
list(APPEND headers celltrace/version.hpp)
foreach(header IN LISTS headers)
  string(MAKE_C_IDENTIFIER ${header} name)
  set(source "#include <${header}>\n")
  set(before "")
  if(EXISTS ${WORK}/${name}.cpp)
    file(READ ${WORK}/${name}.cpp before)
  endif()
  if(NOT before STREQUAL source)
    file(WRITE ${WORK}/${name}.cpp ${source})
  endif()
  execute_process(COMMAND ${LAUNCHER} ${COMPILER} -std=c++20 -I${HEADERS} -I${GENERATED}
    -Wall -Wextra -Wold-style-cast -Wconversion -Werror -c ${name}.cpp -o ${name}.o
    WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(SEND_ERROR "${header} does not compile alone")
  endif()
endforeach()
