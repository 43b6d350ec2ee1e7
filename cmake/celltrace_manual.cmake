# The manual page and the shells' completions, which the program prints itself: the folder ${CELLTRACE_MANUAL}. Where the
# program cannot run while it is built, the variable is empty.

set(CELLTRACE_MANUAL "")
if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
  message(STATUS "celltrace: no CMAKE_CROSSCOMPILING_EMULATOR, so no manual page and no completions")
  return()
endif()

set(CELLTRACE_MANUAL ${PROJECT_BINARY_DIR}/manual)
file(MAKE_DIRECTORY ${CELLTRACE_MANUAL})
function(celltrace_print file)
  add_custom_command(OUTPUT ${CELLTRACE_MANUAL}/${file}
    COMMAND celltrace_program ${ARGN} > ${CELLTRACE_MANUAL}/${file}
    COMMENT "Printing ${file}" VERBATIM)
endfunction()
celltrace_print(celltrace.1 --man-page)
celltrace_print(celltrace.bash --completions bash)
celltrace_print(_celltrace --completions zsh)
celltrace_print(celltrace.fish --completions fish)
add_custom_target(celltrace_manual ALL DEPENDS
  ${CELLTRACE_MANUAL}/celltrace.1 ${CELLTRACE_MANUAL}/celltrace.bash ${CELLTRACE_MANUAL}/_celltrace
  ${CELLTRACE_MANUAL}/celltrace.fish)
