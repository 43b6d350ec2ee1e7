# Debian packages, by `cpack -G DEB` (tools/make-packages.sh): the libraries libcelltrace0, what compiling with them needs
# libcelltrace-dev, the program celltrace, the Python package python3-celltrace where it is built. They want a build with
# BUILD_SHARED_LIBS and CMAKE_INSTALL_PREFIX=/usr.

set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
if(NOT DEFINED ENV{DEBFULLNAME} OR NOT DEFINED ENV{DEBEMAIL})
  set(maintainer "celltrace authors <celltrace@example.org>")
endif()
set(CELLTRACE_MAINTAINER ${maintainer} CACHE STRING
  "Maintainer of the packages: Name <address>; by default of DEBFULLNAME and DEBEMAIL")

set(CPACK_PACKAGE_NAME celltrace)
set(CPACK_PACKAGE_CONTACT ${CELLTRACE_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS # whatever the umask
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)

# A package's description begins with its synopsis.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(about "celltrace ray-traces POV-Ray scenes with a program that is written for the
SPEs of the Cell Broadband Engine and runs on any PC: as threads with the
widest SIMD of the CPU, or on an emulated Cell that holds it to the machine's
rules.\n")
set(debian ${PROJECT_BINARY_DIR}/debian)
set(packages_runtime libcelltrace${PROJECT_VERSION_MAJOR})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "ray tracer for POV-Ray scenes - libraries
${about}.\nThese are the shared libraries.")
file(WRITE ${debian}/runtime/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${debian}/runtime/triggers)
set(packages_dev libcelltrace-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${packages_runtime} (= ${PROJECT_VERSION}), libglm-dev, libxsimd-dev")
set(CPACK_DEBIAN_DEV_DESCRIPTION "ray tracer for POV-Ray scenes - development files
${about}.\nThese are the headers, a CMake package and pkg-config files.")
set(packages_tools celltrace)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS "libsdl2-2.0-0, libsdl2-ttf-2.0-0, fonts-dejavu-core") # loaded by the viewer
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS ffmpeg)
set(CPACK_DEBIAN_TOOLS_DESCRIPTION "ray tracer for POV-Ray scenes - program
${about}.\nThis is the program, which also runs programs for the SPU.")
set(scripts ${PROJECT_SOURCE_DIR}/cmake/debian/tools) # make /usr/bin/povray an alternative
set(CPACK_DEBIAN_TOOLS_PACKAGE_CONTROL_EXTRA ${scripts}/postinst ${scripts}/prerm ${scripts}/triggers)
set(package_groups runtime dev tools)
if(CELLTRACE_HAS_PYTHON)
  list(APPEND package_groups python)
  set(packages_python python3-celltrace)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "ray tracer for POV-Ray scenes - Python package
${about}.\nThis is a package for Python, with pictures as NumPy's arrays.")
  # One for each minor version of Python: that is what the module is compiled for.
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "${packages_runtime} (= ${PROJECT_VERSION}), python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src) # has the module's library
  # Or Python compiles it when root imports it first, into files that no package owns.
  file(WRITE ${debian}/python/postinst "#!/bin/sh\nset -e\npy3compile -p ${packages_python}\n")
  file(WRITE ${debian}/python/prerm "#!/bin/sh\nset -e\npy3clean -p ${packages_python}\n")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${debian}/python/postinst ${debian}/python/prerm)
endif()

# What Debian wants beside the files: installed by no other way of installing.
file(READ ${PROJECT_SOURCE_DIR}/LICENSE licence)
string(REGEX MATCH "Copyright \\(c\\) [^\n]*" copyright "${licence}")
string(REPLACE "Copyright (c) " "" copyright "${copyright}")
string(REGEX REPLACE "^.*Copyright[^\n]*\n\n" "" licence "${licence}")
string(REGEX REPLACE "\n$" "" licence "${licence}")
string(REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REPLACE "\n" "\n " licence "${licence}")
file(WRITE ${debian}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: celltrace

Files: *
Copyright: ${copyright}
License: Expat
 ${licence}
")
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC) # or what SOURCE_DATE_EPOCH says
file(WRITE ${debian}/changelog "celltrace (${PROJECT_VERSION}) unstable; urgency=medium

  * What changed is in CHANGELOG.md of the sources.

 -- ${CELLTRACE_MAINTAINER}  ${now}
")
find_program(CELLTRACE_GZIP gzip)
mark_as_advanced(CELLTRACE_GZIP)
if(CELLTRACE_GZIP)
  execute_process(COMMAND ${CELLTRACE_GZIP} -9nf ${debian}/changelog)
endif()
set(CPACK_COMPONENTS_ALL "")
foreach(group IN LISTS package_groups)
  list(APPEND CPACK_COMPONENTS_ALL ${group} debian_${group})
  string(TOUPPER ${group} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${packages_${group}})
  install(FILES ${debian}/copyright ${debian}/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${packages_${group}} COMPONENT debian_${group} EXCLUDE_FROM_ALL OPTIONAL)
endforeach()
if(CELLTRACE_MANUAL AND CELLTRACE_GZIP)
  install(CODE "execute_process(COMMAND ${CELLTRACE_GZIP} -9nkf celltrace.1 WORKING_DIRECTORY \"${CELLTRACE_MANUAL}\")"
    COMPONENT debian_tools EXCLUDE_FROM_ALL)
  install(FILES ${CELLTRACE_MANUAL}/celltrace.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
    COMPONENT debian_tools EXCLUDE_FROM_ALL)
endif()
# What /usr/bin/povray leads to, and a folder for a PATH that has it first.
file(CREATE_LINK ../../bin/celltrace ${debian}/povray SYMBOLIC)
install(FILES ${debian}/povray DESTINATION lib/celltrace COMPONENT debian_tools EXCLUDE_FROM_ALL)
# CPack has maintainer scripts of its own call ldconfig.
file(WRITE ${debian}/runtime/${packages_runtime} "${packages_runtime}: maintscript-calls-ldconfig *\n")
install(FILES ${debian}/runtime/${packages_runtime} DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
  COMPONENT debian_runtime EXCLUDE_FROM_ALL)

include(CPack)
foreach(group IN LISTS package_groups)
  cpack_add_component_group(${group})
  cpack_add_component(${group} GROUP ${group})
  cpack_add_component(debian_${group} GROUP ${group})
endforeach()
