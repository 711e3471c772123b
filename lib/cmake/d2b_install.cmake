# Files that `cmake --install` copies, except the tools, which their own folder installs.
include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dem2buildings)
set(include_dir ${CMAKE_INSTALL_INCLUDEDIR}/dem2buildings)

install(TARGETS dem2buildings EXPORT dem2buildingsTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT tools
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(EXPORT dem2buildingsTargets NAMESPACE dem2buildings:: DESTINATION ${config_dir})

install(DIRECTORY ${PROJECT_SOURCE_DIR}/lib/include/dem2buildings DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_BINARY_DIR}/lib/dem2buildings/version.hpp DESTINATION ${include_dir})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/dem2buildingsConfig.cmake.in
  ${PROJECT_BINARY_DIR}/dem2buildingsConfig.cmake INSTALL_DESTINATION ${config_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/dem2buildingsConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/dem2buildingsConfig.cmake
  ${PROJECT_BINARY_DIR}/dem2buildingsConfigVersion.cmake ${CMAKE_CURRENT_LIST_DIR}/FindGeographicLib.cmake
  DESTINATION ${config_dir})

# Serves build systems other than CMake. A static library leaves its libraries to the program.
file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" to_prefix ${to_prefix})
if(BUILD_SHARED_LIBS)
  set(requires Requires.private)
  set(libraries "")
else()
  set(requires Requires)
  set(libraries " -lGeographicLib -lpthread")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/dem2buildings.pc.in ${PROJECT_BINARY_DIR}/dem2buildings.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/dem2buildings.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(PROJECT_IS_TOP_LEVEL)
  add_custom_target(uninstall COMMAND ${CMAKE_COMMAND} -D BUILD=${PROJECT_BINARY_DIR}
                                      -P ${CMAKE_CURRENT_LIST_DIR}/d2b_uninstall.cmake VERBATIM)
endif()

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT tools)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT tools)
