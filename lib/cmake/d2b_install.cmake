# What `cmake --install` copies, but for the tools, which their own folder installs.
include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dem2buildings)
set(include_dir ${CMAKE_INSTALL_INCLUDEDIR}/dem2buildings)

install(TARGETS dem2buildings EXPORT dem2buildingsTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT tools
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(EXPORT dem2buildingsTargets NAMESPACE dem2buildings:: DESTINATION ${config_dir})

get_property(headers GLOBAL PROPERTY D2B_HEADERS)
foreach(header IN LISTS headers)
  cmake_path(GET header PARENT_PATH folder)
  set(place ${PROJECT_SOURCE_DIR}/lib/include/${header})
  if(NOT EXISTS ${place})
    set(place ${PROJECT_SOURCE_DIR}/lib/${header})
  endif()
  install(FILES ${place} DESTINATION ${include_dir}/${folder})
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/lib/core/version.hpp DESTINATION ${include_dir}/core)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/dem2buildingsConfig.cmake.in
  ${PROJECT_BINARY_DIR}/dem2buildingsConfig.cmake INSTALL_DESTINATION ${config_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/dem2buildingsConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/dem2buildingsConfig.cmake
  ${PROJECT_BINARY_DIR}/dem2buildingsConfigVersion.cmake ${CMAKE_CURRENT_LIST_DIR}/FindGeographicLib.cmake
  DESTINATION ${config_dir})

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT tools)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT tools)
