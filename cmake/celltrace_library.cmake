# The libraries that others link.
#
#   celltrace_library(NAME ROOMS rooms... [PUBLIC targets...] [PRIVATE targets...])
#
# makes celltrace::NAME of the objects of rooms, static or shared as BUILD_SHARED_LIBS says. Tests and the program link the
# rooms themselves, whose functions a shared library hides. NAME celltrace is the library `celltrace`, any other
# `celltrace-NAME`.
#
#   celltrace_headers(NAME [PUBLIC targets...])
#
# makes celltrace::NAME of headers alone.

configure_file(${PROJECT_SOURCE_DIR}/cmake/version.hpp.in ${PROJECT_BINARY_DIR}/include/celltrace/version.hpp @ONLY)

# The target's name in this build of celltrace::NAME.
function(celltrace_target variable name)
  if(name STREQUAL "celltrace")
    set(${variable} celltrace PARENT_SCOPE)
  else()
    set(${variable} celltrace_${name}_library PARENT_SCOPE)
  endif()
endfunction()

function(celltrace_public_headers target scope)
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} ${scope} cxx_std_20)
  target_compile_options(${target} ${scope} ${CELLTRACE_BASELINE_OPTIONS})
endfunction()

function(celltrace_library name)
  cmake_parse_arguments(LIBRARY "" "" "ROOMS;PUBLIC;PRIVATE" ${ARGN})
  celltrace_target(target ${name})
  set(objects "")
  foreach(room version ${LIBRARY_ROOMS})
    get_target_property(parts celltrace_${room} CELLTRACE_PARTS) # objects that are compiled elsewhere
    foreach(part celltrace_${room} ${parts})
      if(TARGET ${part})
        list(APPEND objects $<TARGET_OBJECTS:${part}>)
      endif()
    endforeach()
  endforeach()
  add_library(${target} ${objects})
  add_library(celltrace::${name} ALIAS ${target})
  celltrace_public_headers(${target} PUBLIC)
  target_link_libraries(${target} PUBLIC ${LIBRARY_PUBLIC} PRIVATE ${LIBRARY_PRIVATE})
  set_target_properties(${target} PROPERTIES
    LINKER_LANGUAGE CXX EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
  if(NOT name STREQUAL "celltrace")
    set_target_properties(${target} PROPERTIES OUTPUT_NAME celltrace-${name})
  endif()
  if(CELLTRACE_SANITIZE)
    target_link_options(${target} PUBLIC -fsanitize=${CELLTRACE_SANITIZE})
  elseif(NOT APPLE)
    # What is missing is missed here, and not by who links it.
    target_link_options(${target} PRIVATE -Wl,-z,defs -Wl,--exclude-libs,ALL)
  endif()
endfunction()

function(celltrace_headers name)
  cmake_parse_arguments(HEADERS "" "" "PUBLIC" ${ARGN})
  celltrace_target(target ${name})
  add_library(${target} INTERFACE)
  add_library(celltrace::${name} ALIAS ${target})
  celltrace_public_headers(${target} INTERFACE)
  target_link_libraries(${target} INTERFACE ${HEADERS_PUBLIC})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
endfunction()
