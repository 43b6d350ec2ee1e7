# Fails if a file includes what its room may not, by the table in docs/architecture.md:
#
#   cmake -DSOURCE=src -P rooms.cmake
cmake_minimum_required(VERSION 3.25)

# Of each room, what it may include besides itself and public headers.
set(allowed_cli "study/|pov/|render/|image/|cache/|viewer/|memory/")
set(allowed_viewer "")
set(allowed_python "")
set(allowed_study "render/|image/|cache/|kernel/|scene/")
set(allowed_job "")
set(allowed_pov "scene/|geometry/|scene_image/(point_texture|single_precision)\\.hpp|memory/")
set(allowed_render "scene/|geometry/|scene_image/|image/|memory/|kernel/|backends/spe_entry\\.hpp|backends/native/query_spu\\.hpp")
set(allowed_scene_image "prepare/|geometry/|scene/|memory/|kernel/")
set(allowed_prepare "geometry/|scene/|kernel/records\\.hpp")
set(allowed_geometry "scene/|kernel/(records|textures/noise_tables)\\.hpp")
set(allowed_scene "")
set(allowed_image "")
set(allowed_memory "")
set(allowed_cache "")
set(allowed_kernel "")

# Complains about each include of a file that is of a room, or a backend, and that `allowed` does not begin.
function(check_includes file allowed)
  file(STRINGS ${file} lines REGEX "^#include \"(backends|cache|cli|geometry|image|job|kernel|memory|pov|prepare|python|render|scene|scene_image|study|viewer)/")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^#include \"([^\"]*)\".*" "\\1" included ${line})
    if(NOT included MATCHES "^(${allowed})")
      message(SEND_ERROR "${file}: may not include ${included}")
    endif()
  endforeach()
endfunction()

foreach(room cli viewer python study job pov render scene_image prepare geometry scene image memory cache kernel)
  file(GLOB_RECURSE files ${SOURCE}/${room}/*.[ch]pp ${SOURCE}/${room}/*.[ly])
  if(NOT files)
    message(FATAL_ERROR "there is no ${SOURCE}/${room}")
  endif()
  set(allowed "${room}/")
  if(allowed_${room})
    string(APPEND allowed "|${allowed_${room}}")
  endif()
  foreach(file IN LISTS files)
    check_includes(${file} "${allowed}")
  endforeach()
endforeach()

# A library is silent: what it has to say goes to functions of the application's.
file(GLOB_RECURSE files ${SOURCE}/*.[ch]pp ${SOURCE}/*.[ly] ${SOURCE}/../backends/*.[ch]pp ${SOURCE}/../include/*.[ch]pp)
list(FILTER files EXCLUDE REGEX "/src/(cli|viewer|study)/")
foreach(file IN LISTS files)
  file(STRINGS ${file} lines REGEX "std::(cerr|cout|clog)|[^a-z_](stderr|stdout)[^a-z_]|[^a-z_](perror|puts|printf)\\(")
  list(FILTER lines EXCLUDE REGEX "^ *//")
  foreach(line IN LISTS lines)
    message(SEND_ERROR "${file}: a library does not print: ${line}")
  endforeach()
endforeach()

# Where the eye is, passes ask an Eye, which remembers that they did: the image is made anew when it moves.
file(GLOB files ${SOURCE}/geometry/*.[ch]pp ${SOURCE}/prepare/*.[ch]pp ${SOURCE}/scene_image/*.[ch]pp)
list(FILTER files EXCLUDE REGEX "/(eye\\.hpp|validation\\.cpp|scene_image\\.cpp)$")
foreach(file IN LISTS files)
  file(STRINGS ${file} lines REGEX "[.>]camera[^a-z_]")
  foreach(line IN LISTS lines)
    message(SEND_ERROR "${file}: reads the camera, not the Eye: ${line}")
  endforeach()
endforeach()

# Programs of functions know neither the language nor places in scenes.
file(GLOB files ${SOURCE}/geometry/function_*.[ch]pp)
foreach(file IN LISTS files)
  check_includes(${file} "geometry/function_")
endforeach()
