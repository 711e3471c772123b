#!/usr/bin/python3
"""Measures the tool beside its peers and its floors, whole processes by turns, and prints the requirements that are met.

    cmake -S . -B build -D D2B_BUILD_BENCHMARKS=ON && cmake --build build --parallel
    tests/bench/run.py build

Makes the cities that are missing in the work folder, prints tables for docs/developers/performance.md, and writes every time
that was taken to results.json there. Needs gdal-bin, python3-gdal and python3-numpy; 2 GB of disk, 7 GB with --huge.
"""
import argparse
import json
import os
import sys
from pathlib import Path

import tables
import timeline
from contenders import PRESETS, Bench
from measuring import run_alternating
from rows import ROWS, huge_rows


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="build folder with dem2buildings, make_city and read_floor")
    parser.add_argument("--rows", default=",".join(ROWS), help="which rows, with commas between; default: %(default)s")
    parser.add_argument("--repeats", type=int, default=5, help="of each process; default: %(default)s")
    parser.add_argument("--work", type=Path, help="folder for cities and results; default: <build>/bench")
    parser.add_argument("--huge", action="store_true", help="also 1,000 million points, once, for their memory")
    parser.add_argument("--small", type=Path, help="raster of the row `small`; default: a window of 242 x 249 cells")
    parser.add_argument("--cities", type=Path, help="folder with a folder a surveyed city, whose elevations are dsm.tif")
    parser.add_argument("--trace", type=Path, help="instead of all this: a timeline of two threads, for chrome://tracing")
    given = parser.parse_args()
    if given.cities and not given.cities.is_dir():
        parser.error(f"there is no folder {given.cities}")
    if unknown := set(given.rows.split(",")) - set(ROWS):
        parser.error(f"no such row: {', '.join(sorted(unknown))}")
    return given


def programs(build):
    found = {"dem2buildings": build / "tools/dem2buildings", "make_city": build / "tests/bench/make_city",
             "read_floor": build / "tests/bench/read_floor", "timeline": build / "tests/bench/timeline"}
    for path in found.values():
        if not path.exists():
            sys.exit(f"There is no {path}; build with -D D2B_BUILD_BENCHMARKS=ON first.")
    return {name: path.resolve() for name, path in found.items()}


def say(text):
    print(text, file=sys.stderr, flush=True)


def trace(bench, path):
    """Runs each preset once on two threads, and estimates times on more."""
    out = bench.work / "timeline.gpkg"
    runs = {}
    for preset, options in PRESETS.items():
        runs[preset] = timeline.run_once(bench.programs["timeline"], ["-threads", "2", *options], bench.city(25), out)
        out.unlink()  # to replace the layers of a run takes longer than to make them
    timeline.write_chrome(path, runs)
    print(tables.timeline_table(runs))
    for name, (whole, spans) in runs.items():
        print(tables.alone_table(name, timeline.longest_alone(spans, whole)))


def main():
    given = arguments()
    work = (given.work or given.build / "bench").resolve()
    work.mkdir(parents=True, exist_ok=True)
    # Relative names in the table are those of this folder.
    small = given.small.resolve() if given.small else None
    real = {dsm.parent.name: dsm.resolve() for dsm in sorted(given.cities.glob("*/dsm.tif"))} if given.cities else {}
    bench = Bench(programs(given.build), work, given.repeats, small, say, real)
    if given.trace:
        trace(bench, given.trace)
        return
    os.chdir(work)
    rows = [row for name in given.rows.split(",") for row in ROWS[name](bench)]
    rows += huge_rows(bench) if given.huge else []
    contenders = list(bench.contenders.values())
    run_alternating(contenders, say)
    (work / "results.json").write_text(json.dumps(tables.as_json(contenders, bench.reports), indent=1))
    print(tables.asked_table(rows))
    print(tables.stage_table(contenders))
    print(tables.busy_table(bench.reports))
    print(tables.contender_table(contenders))


if __name__ == "__main__":
    main()
