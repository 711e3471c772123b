# Not tried. In a release: vcpkg_from_github() or vcpkg_download_distfile() with its address and sum, in place of the
# checkout that this port lies in.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}" OPTIONS -DD2B_BUILD_TESTS=OFF -DD2B_BUILD_MESH=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/dem2buildings)
vcpkg_fixup_pkgconfig()
vcpkg_copy_tools(TOOL_NAMES dem2buildings dem2buildings_compare dem2buildings_score dem2buildings_tiles AUTO_CLEAN)
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
