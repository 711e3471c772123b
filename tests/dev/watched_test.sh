#!/bin/sh
# Tests the text that a person reads of a build and of tests: watched_test.sh <tools/dev/watched.sh> <scratch folder>
set -eu
. "$1"
rm -rf "$2"
mkdir -p "$2"
cd "$2"

expect() {
    if [ "$1" != "$2" ]; then
        printf '%s\n--- is not ---\n%s\n' "$1" "$2" >&2
        exit 1
    fi
}

steps() {
    echo "-- Configuring done"
    for i in 1 2 3 4; do echo "[$i/4] Building CXX object $i"; done
    echo "ninja: no work to do."
    echo "a.cpp:1: warning: unused"
}
expect "$(logged build.log build_progress steps)" "  20 % built
  50 % built
  70 % built
  100 % built
a.cpp:1: warning: unused"
expect "$(wc -l <build.log | tr -d ' ')" 7

tests() {
    cat <<TESTS
Internal ctest changing into directory: /build
Test project /build
        Start   1: core/A.one
        Start   2: core/A.two
  1/20 Test   #1: core/A.one ........................   Passed    0.01 sec
  2/20 Test   #2: core/A.two ........................$1
        Start   3: core/A.three
  3/20 Test   #3: core/A.three ......................***Skipped   0.01 sec
 20/20 Test  #20: core/A.last .......................   Passed    0.01 sec

$2

Total Test time (real) =  41.64 sec

The following tests did not run:
	  3 - core/A.three (Skipped)
TESTS
}
passing() {
    tests "   Passed    0.02 sec" "100% tests passed, 0 tests failed out of 20"
}
expect "$(logged test.log test_progress passing)" "  10 % of 20 tests
  100 % of 20 tests
All 20 tests passed (1 skipped) in 42 s"

failing() {
    tests "***Failed    0.02 sec
a.cpp:3: Failure" "95% tests passed, 1 tests failed out of 20"
    return 8
}
status=0
said=$(logged test.log test_progress failing) || status=$?
expect "$status" 8
expect "$said" "  10 % of 20 tests
  2/20 Test   #2: core/A.two ........................***Failed    0.02 sec
a.cpp:3: Failure
  100 % of 20 tests
1 of 20 tests failed (1 skipped) in 42 s"
