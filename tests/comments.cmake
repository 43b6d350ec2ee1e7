# Fails if a comment begins with a word that leaves its subject out:
#
#   cmake -DSOURCE=folder -P comments.cmake
cmake_minimum_required(VERSION 3.25)

foreach(folder src include backends)
  file(GLOB_RECURSE files ${SOURCE}/${folder}/*.[ch]pp ${SOURCE}/${folder}/*.h)
  if(NOT files)
    message(FATAL_ERROR "there are no sources in ${SOURCE}/${folder}")
  endif()
  foreach(file IN LISTS files)
    file(STRINGS ${file} lines REGEX "//+<? *(What|Of|Those|Which|So|Likewise|The same|They) ")
    foreach(line IN LISTS lines)
      message(SEND_ERROR "${file}: the sentence needs a subject, or a verb of a function, at its beginning: ${line}")
    endforeach()
  endforeach()
endforeach()
