#!/usr/bin/env bash
# Makes dem2buildings-<version>-windows.zip on Debian 12: the plugin for QGIS, with the programs for 64-bit Windows, the data
# of GDAL and PROJ, the sample town and the licences in it. The programs need no other files. As root or with sudo.
#   windows.sh [folder]
# The folder, build-windows by default, gets the libraries, the build and the zip. Existing parts are not built again.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/dev/setup.sh

mkdir -p "${1:-build-windows}"
folder=$(cd "${1:-build-windows}" && pwd)
tools/dev/static_libraries.sh windows "$folder"
# shellcheck disable=SC2086  # a list of words
install_packages $page_packages zip
export ROOT_WINDOWS=$folder/windows/root
build=$folder/windows/program
programs="dem2buildings dem2buildings_score dem2buildings_compare dem2buildings_tiles"

# A linker of the environment need not know Windows.
unset LDFLAGS
# GDAL's own description of itself names the libraries that a static one needs; CMake's does not.
# shellcheck disable=SC2086  # options of CMake
PKG_CONFIG_LIBDIR=$ROOT_WINDOWS/lib/pkgconfig cmake -S . -B "$build" -G Ninja \
    -DCMAKE_TOOLCHAIN_FILE="$PWD/tools/dev/mingw.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_FIND_PACKAGE_PREFER_CONFIG=ON -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 -DD2B_BUILD_TESTS=OFF -DD2B_BUILD_PAGE=ON \
    -DD2B_BUILD_MESH=OFF ${D2B_CONFIGURE:-}
# shellcheck disable=SC2046,SC2086  # lists of words
cmake --build "$build" --parallel "${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" \
    --target $(printf '%s_tool ' $programs) qgis_plugin

# The folder that QGIS unpacks; the plugin looks for the program in its bin/, and the program for data/ beside that.
version=$(sed -nE 's/^project\(dem2buildings VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)
zip=$folder/dem2buildings-$version-windows.zip
content=$folder/windows/zip
rm -rf "$content" "$zip"
mkdir -p "$content/dem2buildings"/{bin,data/proj,licences,sample_dems}
cp -r "$build/tools/qgis/dem2buildings/." "$content/dem2buildings/"
for program in $programs; do
    x86_64-w64-mingw32-strip -o "$content/dem2buildings/bin/$program.exe" "$build/tools/$program.exe"
done
cp sample_dems/town* "$content/dem2buildings/sample_dems/"
cp -r "$ROOT_WINDOWS/share/gdal" "$content/dem2buildings/data/gdal"
cp "$ROOT_WINDOWS/share/proj/proj.db" "$content/dem2buildings/data/proj/"
cp "$ROOT_WINDOWS"/licences/* "$content/dem2buildings/licences/"
cp LICENSE "$content/dem2buildings/licences/dem2buildings.txt"
cp lib/view/page/three_licence.txt "$content/dem2buildings/licences/three.js.txt"
# The same bytes from the same files: no times but that of the commit, and the order of the names.
find "$content" -exec touch --date="@$(git log -1 --format=%ct)" '{}' +
(cd "$content" && find dem2buildings -type f | LC_ALL=C sort | TZ=UTC zip -q -X "$zip" -@)
ls -l "$zip"
