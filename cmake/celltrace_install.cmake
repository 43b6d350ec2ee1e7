# What `cmake --install` installs: libraries and headers by component, the CMake package, pkg-config files, and the
# program with its man page and completions. Install components: runtime, dev, tools; python (src/python).

include(CMakePackageConfigHelpers)

set(CELLTRACE_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/celltrace)
set(headers ${PROJECT_SOURCE_DIR}/include/celltrace)

# celltrace_install_headers(files or folders of include/celltrace...)
function(celltrace_install_headers)
  foreach(header IN LISTS ARGN)
    if(IS_DIRECTORY ${headers}/${header})
      install(DIRECTORY ${headers}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/celltrace COMPONENT dev)
    else()
      install(FILES ${headers}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/celltrace COMPONENT dev)
    endif()
  endforeach()
endfunction()

celltrace_install_headers(error.hpp export.hpp spe)
install(FILES ${PROJECT_BINARY_DIR}/include/celltrace/version.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/celltrace COMPONENT dev)
set(component_headers_emulator emulator.hpp simulator.hpp)
set(component_headers_sdk sdk)
set(component_headers_cache cache.hpp cache)
set(component_headers_balance balance.hpp balance)
set(component_headers_celltrace camera_ray.hpp image.hpp job.hpp load.hpp picture_limit.hpp pov.hpp ray.hpp ray_queries.hpp render.hpp scene.hpp session.hpp texture.hpp transform.hpp)

# --- libraries ---

# celltrace_pkg_config(NAME component DESCRIPTION text [REQUIRES modules...] [PRIVATE modules...] [LIBS flags...]
#   [PRIVATE_LIBS flags...] [CFLAGS flags...]): what is private a static library's users link, too; a shared one's need
# not even have its headers and module, which pkg-config would ask for were it named.
function(celltrace_pkg_config)
  cmake_parse_arguments(PC "" "NAME;DESCRIPTION" "REQUIRES;PRIVATE;LIBS;PRIVATE_LIBS;CFLAGS" ${ARGN})
  if(NOT BUILD_SHARED_LIBS)
    list(APPEND PC_REQUIRES ${PC_PRIVATE})
    list(APPEND PC_LIBS ${PC_PRIVATE_LIBS})
  endif()
  set(PC_FILE celltrace-${PC_NAME})
  if(PC_NAME STREQUAL "celltrace")
    set(PC_FILE celltrace)
  endif()
  list(JOIN PC_REQUIRES ", " PC_REQUIRES)
  list(JOIN PC_LIBS " " PC_LIBS)
  list(APPEND PC_CFLAGS ${CELLTRACE_BASELINE_OPTIONS})
  list(JOIN PC_CFLAGS " " PC_CFLAGS)
  set(PC_DIR ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  set(PC_PREFIX ${CMAKE_INSTALL_PREFIX})
  set(PC_LIBDIR ${CMAKE_INSTALL_LIBDIR})
  set(PC_INCLUDEDIR ${CMAKE_INSTALL_INCLUDEDIR})
  if(NOT IS_ABSOLUTE ${PC_LIBDIR})
    # Wherever it is put.
    file(RELATIVE_PATH to_prefix /${PC_DIR} /)
    string(REGEX REPLACE "/$" "" to_prefix ${to_prefix})
    set(PC_PREFIX "\${pcfiledir}/${to_prefix}")
    set(PC_LIBDIR "\${prefix}/${PC_LIBDIR}")
  endif()
  if(NOT IS_ABSOLUTE ${PC_INCLUDEDIR})
    set(PC_INCLUDEDIR "\${prefix}/${PC_INCLUDEDIR}")
  endif()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/celltrace.pc.in ${PROJECT_BINARY_DIR}/pkgconfig/${PC_FILE}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/pkgconfig/${PC_FILE}.pc DESTINATION ${PC_DIR} COMPONENT dev)
endfunction()

foreach(component IN LISTS CELLTRACE_COMPONENTS)
  if(component STREQUAL "program")
    continue()
  endif()
  celltrace_target(target ${component})
  celltrace_install_headers(${component_headers_${component}})
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "SHARED_LIBRARY" AND NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    # Where the system does not look one finds the others beside it, whatever the path of the program that needs it.
    set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN")
  endif()
  install(TARGETS ${target} EXPORT celltrace-${component}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT dev
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  install(EXPORT celltrace-${component} NAMESPACE celltrace:: FILE celltrace-${component}-targets.cmake
    DESTINATION ${CELLTRACE_CMAKE_DIR} COMPONENT dev)
endforeach()

if("emulator" IN_LIST CELLTRACE_COMPONENTS)
  set(stacks "")
  if(NOT CELLTRACE_UCONTEXT)
    set(stacks -lboost_context)
  endif()
  celltrace_pkg_config(NAME emulator DESCRIPTION "Emulated Cell SPEs, for tests of SPE code"
    REQUIRES xsimd LIBS -lcelltrace-emulator -pthread PRIVATE_LIBS ${stacks})
endif()
if("sdk" IN_LIST CELLTRACE_COMPONENTS)
  celltrace_pkg_config(NAME sdk DESCRIPTION "The Cell SDK's headers, in front of the emulator"
    REQUIRES celltrace-emulator CFLAGS "-I\${includedir}/celltrace/sdk")
endif()
if("cache" IN_LIST CELLTRACE_COMPONENTS)
  celltrace_pkg_config(NAME cache DESCRIPTION "A software cache for local stores, its traces and their replay"
    LIBS -lcelltrace-cache)
endif()
if("balance" IN_LIST CELLTRACE_COMPONENTS)
  celltrace_pkg_config(NAME balance DESCRIPTION "Load balancing by generalized dimension exchange and diffusion")
endif()
set(CELLTRACE_HAS_EXR OFF)
set(exr "")
if(TARGET Exr::Exr)
  set(CELLTRACE_HAS_EXR ON)
  set(exr OpenEXR)
endif()
set(CELLTRACE_HAS_JPEG OFF)
set(jpeg "")
if(TARGET JPEG::JPEG)
  set(CELLTRACE_HAS_JPEG ON)
  set(jpeg libjpeg)
endif()
set(CELLTRACE_HAS_FREETYPE OFF)
set(freetype "")
if(TARGET Freetype::Freetype)
  set(CELLTRACE_HAS_FREETYPE ON)
  set(freetype freetype2)
endif()
if("celltrace" IN_LIST CELLTRACE_COMPONENTS)
  celltrace_pkg_config(NAME celltrace DESCRIPTION "Ray-traces POV-Ray scenes"
    REQUIRES celltrace-emulator glm PRIVATE libpng zlib libdeflate ${exr} ${freetype} ${jpeg} LIBS -lcelltrace)
endif()

set(CELLTRACE_IS_STATIC ON)
if(BUILD_SHARED_LIBS)
  set(CELLTRACE_IS_STATIC OFF)
endif()
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/celltraceConfig.cmake.in
  ${PROJECT_BINARY_DIR}/cmake/celltraceConfig.cmake INSTALL_DESTINATION ${CELLTRACE_CMAKE_DIR}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cmake/celltraceConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/cmake/celltraceConfig.cmake
  ${PROJECT_BINARY_DIR}/cmake/celltraceConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/FindDeflate.cmake
  ${PROJECT_SOURCE_DIR}/cmake/FindExr.cmake
  DESTINATION ${CELLTRACE_CMAKE_DIR} COMPONENT dev)

# --- the program, and what is read ---

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT read)
if("program" IN_LIST CELLTRACE_COMPONENTS)
  install(TARGETS celltrace_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
  option(CELLTRACE_POVRAY_LINK "Install the program under the name povray, too: a symbolic link beside it" OFF)
  if(CELLTRACE_POVRAY_LINK)
    file(CREATE_LINK celltrace ${PROJECT_BINARY_DIR}/povray SYMBOLIC)
    install(FILES ${PROJECT_BINARY_DIR}/povray DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT povray) # in no package
  endif()
  include(celltrace_manual)
  if(CELLTRACE_MANUAL)
    install(FILES ${CELLTRACE_MANUAL}/celltrace.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT read)
    install(FILES ${CELLTRACE_MANUAL}/celltrace.bash RENAME celltrace COMPONENT tools
      DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
    install(FILES ${CELLTRACE_MANUAL}/_celltrace COMPONENT tools
      DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
    install(FILES ${CELLTRACE_MANUAL}/celltrace.fish COMPONENT tools
      DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  endif()
endif()
