# The Python that the module celltrace is for: sets CELLTRACE_HAS_PYTHON, Python3_EXECUTABLE and the target
# Python3::Module. By CELLTRACE_PYTHON: ON, OFF, or AUTO, which does without where something is missing.

set(CELLTRACE_PYTHON_DEFAULT OFF)
if(CELLTRACE_WHOLE AND NOT CELLTRACE_SANITIZE) # a process of sanitized code has to be so from its start
  set(CELLTRACE_PYTHON_DEFAULT AUTO)
endif()
set(CELLTRACE_PYTHON ${CELLTRACE_PYTHON_DEFAULT} CACHE STRING "The Python module: ON, OFF, or AUTO, where there are pybind11 and NumPy")
set_property(CACHE CELLTRACE_PYTHON PROPERTY STRINGS AUTO ON OFF)

set(CELLTRACE_HAS_PYTHON OFF)
if(NOT CELLTRACE_PYTHON)
  return()
endif()

# The first one on the PATH is often one of the user's, without what Debian's packages put into /usr/bin/python3's.
if(NOT Python3_EXECUTABLE)
  find_program(CELLTRACE_FIRST_PYTHON python3)
  mark_as_advanced(CELLTRACE_FIRST_PYTHON)
  foreach(candidate ${CELLTRACE_FIRST_PYTHON} /usr/bin/python3)
    execute_process(COMMAND ${candidate} -c "import numpy" RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
    if(result EQUAL 0)
      set(Python3_EXECUTABLE ${candidate})
      break()
    endif()
  endforeach()
endif()
find_package(Python3 QUIET COMPONENTS Interpreter Development.Module NumPy)
if(Python3_FOUND)
  set(PYBIND11_NOPYTHON ON)
  find_package(pybind11 2.10 CONFIG QUIET)
endif()
if(Python3_FOUND AND pybind11_FOUND)
  set(CELLTRACE_HAS_PYTHON ON)
elseif(CELLTRACE_PYTHON STREQUAL "AUTO")
  message(STATUS "celltrace: without pybind11, NumPy and Python's headers there is no Python module")
else()
  message(FATAL_ERROR "celltrace: CELLTRACE_PYTHON needs pybind11, NumPy and Python's headers")
endif()
