#!/bin/sh
# Installs packages, builds, and runs all tests. Prints a summary for people; build/test.log has all output.
set -eu
cd "$(dirname "$0")/../.."
. tools/dev/setup.sh
. tools/dev/watched.sh

install_packages $build_packages $mesh_packages $page_packages libgtest-dev gdal-bin $python_packages $python_test_packages
mkdir -p build
: >build/test.log
echo "Building; the whole log is in $PWD/build/test.log"
# The system's own Python: others do not see its packages.
logged build/test.log build_progress configure -DD2B_BUILD_TESTS=ON -DD2B_BUILD_PAGE=ON -DD2B_BUILD_PYTHON=ON \
    -DPython_EXECUTABLE=/usr/bin/python3
logged build/test.log build_progress build
echo "Testing"
logged build/test.log test_progress \
    ctest --test-dir build --output-on-failure --parallel "${CTEST_PARALLEL_LEVEL:-$(nproc)}"
