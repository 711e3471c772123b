# Finds GeographicLib, here and for programs that use the installed static library. GeographicLib's own package
# config serves where there is one; Debian's package has none, so header and library are looked up themselves.
# Gives the target GeographicLib::GeographicLib.
find_package(GeographicLib CONFIG QUIET)
include(FindPackageHandleStandardArgs)
if(GeographicLib_CONFIG)
  find_package_handle_standard_args(GeographicLib CONFIG_MODE)
  set(GeographicLib_link ${GeographicLib_LIBRARIES})
else()
  find_path(GeographicLib_INCLUDE_DIR NAMES GeographicLib/Geodesic.hpp)
  # Before its version 2 the library was called Geographic.
  find_library(GeographicLib_LIBRARY NAMES GeographicLib Geographic)
  mark_as_advanced(GeographicLib_INCLUDE_DIR GeographicLib_LIBRARY)
  if(EXISTS "${GeographicLib_INCLUDE_DIR}/GeographicLib/Config.h")
    file(STRINGS "${GeographicLib_INCLUDE_DIR}/GeographicLib/Config.h" GeographicLib_version_line
         REGEX "define GEOGRAPHICLIB_VERSION_STRING")
    string(REGEX MATCH "[0-9.]+[0-9]" GeographicLib_VERSION "${GeographicLib_version_line}")
    unset(GeographicLib_version_line)
  endif()
  find_package_handle_standard_args(GeographicLib
    REQUIRED_VARS GeographicLib_LIBRARY GeographicLib_INCLUDE_DIR VERSION_VAR GeographicLib_VERSION
    REASON_FAILURE_MESSAGE "install libgeographiclib-dev, or add its folder to CMAKE_PREFIX_PATH")
  set(GeographicLib_link ${GeographicLib_LIBRARY})
endif()

if(GeographicLib_FOUND AND NOT TARGET GeographicLib::GeographicLib)
  add_library(GeographicLib::GeographicLib INTERFACE IMPORTED)
  set_target_properties(GeographicLib::GeographicLib PROPERTIES INTERFACE_LINK_LIBRARIES "${GeographicLib_link}")
  if(GeographicLib_INCLUDE_DIR)
    set_target_properties(GeographicLib::GeographicLib PROPERTIES
                          INTERFACE_INCLUDE_DIRECTORIES "${GeographicLib_INCLUDE_DIR}")
  endif()
endif()
unset(GeographicLib_link)
