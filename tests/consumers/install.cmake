# Installs a build into an empty prefix, where nothing may name the folders that it was made of:
#
#   cmake -DBUILD=folder -DPREFIX=folder -DFORBIDDEN=folders -P install.cmake
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

file(GLOB_RECURSE texts ${PREFIX}/*.cmake ${PREFIX}/*.pc ${PREFIX}/*.hpp ${PREFIX}/*.h)
foreach(text IN LISTS texts)
  file(READ ${text} content)
  foreach(folder IN LISTS FORBIDDEN)
    string(FIND "${content}" "${folder}/" at)
    if(NOT at EQUAL -1)
      message(SEND_ERROR "${text} names ${folder}")
    endif()
  endforeach()
endforeach()
