# Fails if a function that a public header declares and does not define is hidden in a shared library:
#
#   cmake -DHEADERS=include -P exported.cmake
cmake_minimum_required(VERSION 3.25)

set(found 0)
file(GLOB_RECURSE headers RELATIVE ${HEADERS} ${HEADERS}/celltrace/*.hpp)
list(FILTER headers EXCLUDE REGEX "celltrace/balance/") # all inline, some of it declared first
foreach(header IN LISTS headers)
  # Where the declaration of a function begins: in the first column, with its type and name.
  file(STRINGS ${HEADERS}/${header} lines REGEX "^[A-Za-z][A-Za-z0-9_:<>,&* ]* [&*]*[a-z_0-9]+\\(|CELLTRACE_EXPORT .*>$")
  foreach(line IN LISTS lines)
    if(line MATCHES "^CELLTRACE_EXPORT")
      math(EXPR found "${found} + 1")
    elseif(NOT line MATCHES "^(inline|constexpr|template|static|friend|using|FieldList)")
      message(SEND_ERROR "${header}: not exported: ${line}")
    endif()
  endforeach()
endforeach()
if(found LESS 20)
  message(SEND_ERROR "only ${found} functions were found")
endif()
