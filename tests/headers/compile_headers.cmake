# Compiles the public headers, each alone or all together, with nothing of the project but public headers in reach:
#
#   cmake -DCOMPILER=g++ [-DLAUNCHER=ccache] [-DTOGETHER=ON] -DHEADERS=include -DGENERATED=include -DWORK=folder
#     -P compile_headers.cmake
cmake_minimum_required(VERSION 3.25)

# compile(NAME SOURCE): a source that has not changed is not written again, so that a compiler cache finds it.
function(compile name source)
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
    message(SEND_ERROR "${name} does not compile")
  endif()
endfunction()

file(MAKE_DIRECTORY ${WORK})
file(GLOB_RECURSE headers RELATIVE ${HEADERS} ${HEADERS}/celltrace/*.h ${HEADERS}/celltrace/*.hpp)
list(APPEND headers celltrace/version.hpp)
set(all "")
foreach(header IN LISTS headers)
  set(source "#include <${header}>\n")
  string(APPEND all ${source})
  if(NOT TOGETHER)
    string(MAKE_C_IDENTIFIER ${header} name)
    compile(${name} ${source})
  endif()
endforeach()
if(TOGETHER)
  compile(all_headers ${all})
endif()
