#!/bin/sh
# Runs the libFuzzer targets of a build, as many at a time as there are processors, on their seeds and on inputs that earlier
# runs have found worth keeping.
#   run.sh <build folder> <seconds a target> [<corpus folder>]
# D2B_FUZZ_SEED lets them try the same things each time; without it they try other ones.
set -eu
build=$(cd "$1" && pwd)
seconds=$2
seeds=$(cd "$(dirname "$0")" && pwd)/seeds
corpus=${3:-$build/corpus}
mkdir -p "$corpus"
cd "$corpus"
# Each target's output goes to a file of its own; libFuzzer leaves the input that breaks it as crash-* in the corpus folder.
for target in engine outlines reader values tiles plan command_line city; do
    # There is no target of cities without CGAL.
    if [ "$target" != city ] || [ -e "$build/tests/fuzz/city_fuzz" ]; then echo "$target"; fi
done |
    xargs -P "$(nproc)" -I '{}' sh -c '
        mkdir -p "{}"
        words="$3/../{}.dict"
        if [ -e "$words" ]; then words="-dict=$words"; else words=; fi
        if UBSAN_OPTIONS=print_stacktrace=1 "$1/tests/fuzz/{}_fuzz" -max_total_time="$2" -timeout=60 -rss_limit_mb=4096 \
            -max_len=1000 -entropic=0 -seed="${D2B_FUZZ_SEED:-0}" ${words:+"$words"} -artifact_prefix="{}_" \
            "{}" "$3/{}" < /dev/null > "{}.log" 2>&1; then
            echo "fuzz {}: $(grep -a -m 1 "^Done" "{}.log")"
        else
            tail -n 60 "{}.log"
            exit 255
        fi' sh "$build" "$seconds" "$seeds"
