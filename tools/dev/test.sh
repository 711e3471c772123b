#!/bin/sh
# Installs what is needed, builds, and runs all tests.
set -eu
cd "$(dirname "$0")/../.."
. tools/dev/setup.sh

install_packages $build_packages libgtest-dev gdal-bin $python_packages $python_test_packages
# The system's own Python: others do not see its packages.
configure -DD2B_BUILD_TESTS=ON -DD2B_BUILD_PYTHON=ON -DPython_EXECUTABLE=/usr/bin/python3
build
ctest --test-dir build --output-on-failure --parallel "${CTEST_PARALLEL_LEVEL:-$(nproc)}"
