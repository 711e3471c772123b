#!/bin/sh
# Installs the needed packages, builds, and finds the buildings of a sample town.
set -eu
cd "$(dirname "$0")/../.."
. tools/dev/setup.sh

install_packages $build_packages $page_packages gdal-bin
# Leaves out the tests, unless they are there already.
if [ -e build/CMakeCache.txt ]; then configure -DD2B_BUILD_PAGE=ON; else configure -DD2B_BUILD_PAGE=ON -DD2B_BUILD_TESTS=OFF; fi
# All that `cmake --install build` copies.
build --target installed_files
./build/tools/dem2buildings -overwrite sample_dems/town.tif build/town.gpkg

echo
echo "The buildings of sample_dems/town.tif are in $PWD/build/town.gpkg, layers buildings and contours."
echo "Look at them:  qgis sample_dems/town.tif build/town.gpkg"
echo "or list them:  ogrinfo -so -nomd build/town.gpkg buildings"
