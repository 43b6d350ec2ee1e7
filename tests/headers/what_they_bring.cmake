# Fails if a public header includes what its users did not ask for:
#
#   cmake -DCOMPILER=g++ -DHEADERS=include -DGENERATED=include -P what_they_bring.cmake
cmake_minimum_required(VERSION 3.25)

# not_in(HEADER patterns...): nothing that HEADER includes, directly or not, matches one of the patterns.
function(not_in header)
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/brings.cpp "#include <celltrace/${header}>\n")
  execute_process(COMMAND ${COMPILER} -std=c++20 -I${HEADERS} -I${GENERATED} -M ${CMAKE_CURRENT_BINARY_DIR}/brings.cpp
    OUTPUT_VARIABLE included COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE ${CMAKE_CURRENT_BINARY_DIR}/brings.cpp)
  foreach(pattern IN LISTS ARGN)
    if(included MATCHES "[^ ]*${pattern}[^ ]*")
      message(SEND_ERROR "${header} includes ${CMAKE_MATCH_0}")
    endif()
  endforeach()
endfunction()

set(tracer celltrace/scene.hpp celltrace/image.hpp celltrace/pov.hpp celltrace/render.hpp /glm/)
set(runtime celltrace/spe/spu.hpp celltrace/spe/simd_host.hpp celltrace/cache/software_cache.hpp celltrace/emulator.hpp /xsimd/)
not_in(render.hpp celltrace/pov.hpp ${runtime})
not_in(session.hpp celltrace/pov.hpp ${runtime})
not_in(pov.hpp celltrace/render.hpp ${runtime})
not_in(image.hpp celltrace/scene.hpp /glm/ ${runtime})
not_in(scene.hpp celltrace/render.hpp celltrace/image.hpp ${runtime})
not_in(emulator.hpp celltrace/cache ${tracer})
not_in(simulator.hpp celltrace/cache ${tracer})
not_in(cache.hpp celltrace/emulator.hpp celltrace/spe/machine.hpp celltrace/spe/simd_host.hpp /xsimd/ ${tracer})
not_in(balance.hpp celltrace/cache celltrace/spe/machine.hpp celltrace/spe/simd_host.hpp /xsimd/ ${tracer})
not_in(error.hpp celltrace/spe ${tracer})
