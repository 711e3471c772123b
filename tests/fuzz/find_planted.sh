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
targets="engine outlines reader values command_line"
# shellcheck disable=SC2046  # words
cmake --build "$scratch/build" --target $(printf '%s_fuzz ' $targets) > "$scratch/build.log"
missed=0
for target in $targets; do
    words=tests/fuzz/$target.dict
    if [ -e "$words" ]; then words=-dict=$words; else words=; fi
    start=$(date +%s)
    log=$scratch/$target.log
    if "$scratch/build/tests/fuzz/${target}_fuzz" -seed="${D2B_FUZZ_SEED:-1}" ${words:+"$words"} -max_total_time=600 \
        -max_len=1000 -print_final_stats=1 -artifact_prefix="$scratch/" "tests/fuzz/seeds/$target" \
        < /dev/null > "$log" 2>&1; then
        echo "$target: not found"
        missed=1
    else
        echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") executions" \
            "in $(($(date +%s) - start)) s," \
            "$(grep -m 1 -oE 'does not hold: .*|ERROR: AddressSanitizer: [a-z-]*|runtime error: .*|Assertion.*' "$log")"
    fi
done
exit "$missed"
