# OpenEXR by its files: the target Exr::Exr. Debian 12's CMake package of it asks for a library for Python.

find_path(Exr_INCLUDE_DIR ImfOutputFile.h PATH_SUFFIXES OpenEXR)
find_path(Exr_IMATH_INCLUDE_DIR ImathBox.h PATH_SUFFIXES Imath)
find_library(Exr_LIBRARY OpenEXR)
find_library(Exr_IEX_LIBRARY Iex)
find_library(Exr_IMATH_LIBRARY Imath)
mark_as_advanced(Exr_INCLUDE_DIR Exr_IMATH_INCLUDE_DIR Exr_LIBRARY Exr_IEX_LIBRARY Exr_IMATH_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Exr
  REQUIRED_VARS Exr_LIBRARY Exr_IEX_LIBRARY Exr_IMATH_LIBRARY Exr_INCLUDE_DIR Exr_IMATH_INCLUDE_DIR)

if(Exr_FOUND AND NOT TARGET Exr::Exr)
  add_library(Exr::Exr UNKNOWN IMPORTED)
  set_target_properties(Exr::Exr PROPERTIES
    IMPORTED_LOCATION "${Exr_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${Exr_INCLUDE_DIR};${Exr_IMATH_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${Exr_IEX_LIBRARY};${Exr_IMATH_LIBRARY}")
endif()
