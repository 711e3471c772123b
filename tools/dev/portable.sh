#!/usr/bin/env bash
# Makes, on Debian 12, packages for other Linux systems without their GDAL, PROJ and GEOS: a wheel for Debian's Python, and an
# image for containers. Both bring the data of GDAL and PROJ and the sample town. As root or with sudo.
#   portable.sh [folder]
# The folder, build-portable by default, gets the libraries, the build, dem2buildings-<version>-*.whl and dem2buildings-oci.tar.
# Existing parts are not built again.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tools/dev/setup.sh

mkdir -p "${1:-build-portable}"
folder=$(cd "${1:-build-portable}" && pwd)
tools/dev/static_libraries.sh linux "$folder"
# shellcheck disable=SC2086  # a list of words
install_packages $page_packages $python_packages
root=$folder/linux/root
build=$folder/linux/program
programs="dem2buildings dem2buildings_score dem2buildings_compare dem2buildings_tiles"

# The libraries of the system are the C and C++ libraries; others that it has must not be found. GDAL's own description of
# itself names the libraries that a static one needs; CMake's does not.
# shellcheck disable=SC2086  # options of CMake
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 \
    -DCMAKE_FIND_PACKAGE_PREFER_CONFIG=ON -DCMAKE_PREFIX_PATH="$root" -DBoost_DIR="$root/lib/cmake/Boost" \
    -DSQLite3_INCLUDE_DIR="$root/include" -DSQLite3_LIBRARY="$root/lib/libsqlite3.a" \
    -DD2B_BUILD_TESTS=OFF -DD2B_BUILD_PAGE=ON -DD2B_BUILD_MESH=OFF -DD2B_BUILD_PYTHON=ON \
    -DPython_EXECUTABLE=/usr/bin/python3 ${D2B_CONFIGURE:-}
# shellcheck disable=SC2046,SC2086  # lists of words
cmake --build "$build" --parallel "${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" \
    --target $(printf '%s_tool ' $programs) dem2buildings_python_stub

# needs file: the libraries of the system that it is linked with
needs() { readelf --dynamic "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'; }
# copy_data folder: copies the data that programs and module look for beside them
copy_data() {
    mkdir -p "$1/proj"
    cp -r "$root/share/gdal" "$1/gdal"
    cp "$root/share/proj/proj.db" "$1/proj/"
}
# copy_licences folder
copy_licences() {
    mkdir -p "$1"
    cp "$root"/licences/* "$1/"
    cp LICENSE "$1/dem2buildings.txt"
    cp lib/view/page/three_licence.txt "$1/three.js.txt"
}
version=$(sed -nE 's/^project\(dem2buildings VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)
for file in "$build"/tools/python/dem2buildings/_core*.so "$build/tools/dem2buildings"; do
    if needs "$file" | grep -vE '^(libc|libm|libstdc\+\+|libgcc_s|ld-linux-x86-64)[.]so'; then
        echo "$0: $file is linked with these libraries" >&2
        exit 1
    fi
done

# The module loads with the glibc of Debian 12 and later ones.
wheel=$folder/linux/wheel
rm -rf "$wheel" "$folder"/dem2buildings-*.whl
mkdir -p "$wheel"
cp -r "$build/tools/python/dem2buildings" "$wheel/"
strip --strip-unneeded "$wheel"/dem2buildings/_core*.so
copy_data "$wheel/dem2buildings/data"
copy_licences "$wheel/licences"
/usr/bin/python3 tools/python/make/make_wheel.py "$version" manylinux_2_36_x86_64 "$wheel/dem2buildings" "$wheel/licences" "$folder"

# The image has the programs, their data, the sample town and five libraries of Debian, but no shell.
image=$folder/linux/image
rm -rf "$image"
own=$image/opt/dem2buildings
mkdir -p "$own/bin" "$image/data" "$image/etc" "$image/lib64" "$image/lib/x86_64-linux-gnu" "$image/proc"
mkdir -m 1777 "$image/tmp"
for program in $programs; do
    strip -o "$own/bin/$program" "$build/tools/$program"
done
copy_data "$own/data"
copy_licences "$own/licences"
cp -L /lib64/ld-linux-x86-64.so.2 "$image/lib64/"
for library in libc.so.6 libm.so.6 libstdc++.so.6 libgcc_s.so.1; do
    cp -L "/lib/x86_64-linux-gnu/$library" "$image/lib/x86_64-linux-gnu/" 2>/dev/null ||
        cp -L "/usr/lib/x86_64-linux-gnu/$library" "$image/lib/x86_64-linux-gnu/"
done
mkdir "$own/sample_dems"
cp sample_dems/town* "$own/sample_dems/"
cp /usr/share/doc/libc6/copyright "$own/licences/libc6.txt"
cp /usr/share/doc/gcc-12-base/copyright "$own/licences/gcc.txt"
/usr/bin/python3 tools/packaging/image/make_image.py "$version" "$image" "$folder/dem2buildings-oci.tar"
ls -l "$folder"/dem2buildings-*.whl "$folder/dem2buildings-oci.tar"
