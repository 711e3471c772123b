#!/usr/bin/env bash
# clang-format over all sources, then clang-tidy over the library and the tools, as .ci/run has them.
set -euo pipefail
cd "$(dirname "$0")/../.."

find lib tools tests sample_dems docs/examples '(' -name '*.cpp' -o -name '*.hpp' ')' -print0 |
    xargs -0 clang-format --dry-run -Werror
find lib/view/page -name '*.js' -print0 | xargs -0 clang-format --dry-run -Werror

# Over the sources of a unity build with one for each folder, which is configured for that and never built; those of the
# library are one source. Most of the time goes into the templates of other libraries, which are looked at again in each
# source. They include .cpp files, which is all that bugprone-suspicious-include looks for. Without the analyzer, which
# takes as long as all other checks; the preset `tidy` runs it too, on each file alone. The library begins first and the
# largest of the tools after it, so that nobody waits for them at the end.
cmake -S . -B build-tidy -G Ninja -D CMAKE_BUILD_TYPE=Release -D CMAKE_UNITY_BUILD=ON -D CMAKE_UNITY_BUILD_BATCH_SIZE=0 \
    -D D2B_BUILD_TESTS=OFF -D D2B_BUILD_PYTHON=ON -D Python_EXECUTABLE=/usr/bin/python3 >/dev/null
commands=build-tidy/compile_commands.json
sed -nE "s,^ *\"file\": \"($PWD/build-tidy/lib/.*)\"\,?$,#include \"\\1\",p" $commands >build-tidy/lib.cxx
# The warnings are asked for again, as clang has some that GCC lacks; but folders may share a name, which -Wshadow minds.
# shellcheck disable=SC2207  # words
flags=($(grep -ohE ' (-I|-isystem |-D|-W|-f|-std=)[^ "\]+' $commands | grep -v Wshadow | sort -u))
{ echo build-tidy/lib.cxx; sed -nE "s,^ *\"file\": \"($PWD/(build-tidy/)?tools/.*)\"\,?$,\1,p" $commands | xargs ls -S; } |
    xargs -I {} -P "$(nproc)" clang-tidy --quiet --checks='-clang-analyzer-*,-bugprone-suspicious-include' {} -- "${flags[@]}"
