#!/bin/sh
# Installs what is needed, builds, and runs all tests.
set -eu
cd "$(dirname "$0")/../.."
. tools/dev/setup.sh

install_packages $build_packages libgtest-dev gdal-bin
configure -DD2B_BUILD_TESTS=ON
build
ctest --test-dir build --output-on-failure --parallel "${CTEST_PARALLEL_LEVEL:-$(nproc)}"
