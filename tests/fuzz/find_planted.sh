#!/bin/sh
# Whether the fuzzers find anything: plants the bugs of planted/ in a copy of the sources, one a target, and counts the
# executions until each is found.
#   find_planted.sh <scratch folder>
set -eu
source_folder=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1"
scratch=$(cd "$1" && pwd)
rm -rf "$scratch/source"
mkdir "$scratch/source"
(cd "$source_folder" && tar -cf - --exclude='./build*' --exclude=./.git .) | (cd "$scratch/source" && tar -xf -)
for patch in "$source_folder"/tests/fuzz/planted/*.patch; do
    patch -s -d "$scratch/source" -p1 < "$patch"
done
cd "$scratch/source"
cmake --preset fuzz -G Ninja -B "$scratch/build" > /dev/null
cmake --build "$scratch/build" --target engine_fuzz outlines_fuzz reader_fuzz command_line_fuzz > "$scratch/build.log"
missed=0
for target in engine outlines reader command_line; do
    if "$scratch/build/tests/fuzz/${target}_fuzz" -seed=1 -max_total_time=600 -max_len=1000 -print_final_stats=1 \
        -artifact_prefix="$scratch/" "tests/fuzz/seeds/$target" < /dev/null > "$scratch/$target.log" 2>&1; then
        echo "$target: not found"
        missed=1
    else
        echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$scratch/$target.log") executions," \
            "$(grep -m 1 -oE 'does not hold: .*|ERROR: AddressSanitizer: [a-z-]*|runtime error: .*|Assertion.*' "$scratch/$target.log")"
    fi
done
exit "$missed"
