#!/usr/bin/env python3
"""Sends every file of some folders through the program, whatever it is, in every role that a file can have.

    tests/corpus/run.py [<folder or file>...]

Without folders those of the environment variable D2B_CORPUS, with colons between; without that ../shared/corpus. Each
file is the DEM of both presets, and mask, cutline, ground and NDVI of a sample; where it is a raster, also of itself.
D2B_TOOL names the program (build/tools/dem2buildings). Prints the results and every fault; ends with 1 where there
is one. Needs Python's standard library, and ogrinfo (gdal-bin) to look at polygons.
"""
import argparse
import os
import shutil
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from judge import judge
from run_tool import run_tool

SOURCE = Path(__file__).resolve().parent.parent.parent
SAMPLE = SOURCE / "sample_dems/nodata.tif"
SIDES = ("mask", "cutline", "ground", "ndvi")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="*", type=Path)
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs at a time; default: %(default)s")
    parser.add_argument("--list", action="store_true", help="print every run with its first message")
    given = parser.parse_args()
    default = os.environ.get("D2B_CORPUS", str(SOURCE.parent / "shared/corpus"))
    given.folders = given.folders or [Path(name) for name in default.split(":")]
    return given


def files_in(folders):
    found = [path for folder in folders for path in ([folder] if folder.is_file() else folder.rglob("*"))]
    return sorted(path.resolve() for path in found if path.is_file())


def state_of(files):
    """Nothing may be changed, or added beside."""
    seen = {entry for path in files for entry in path.parent.iterdir()}
    return {path: (path.stat().st_size, path.stat().st_mtime_ns) for path in seen}


class Corpus:
    def __init__(self, scratch, list_all):
        self.tool = Path(os.environ.get("D2B_TOOL", SOURCE / "build/tools/dem2buildings")).resolve()
        self.scratch = scratch
        self.list_all = list_all

    def one(self, path, role, given, preset="buildings"):
        """@return the role, the outcome, faults"""
        run = run_tool(self.tool, role, ["-preset", preset, *given], self.scratch, os.environ)
        outcome, faults = judge(run, preset)
        shutil.rmtree(run.folder)
        if self.list_all:
            print(f"{role}\t{outcome}\t{run.seconds:.1f}\t{path}\t{run.err.strip()!r}", flush=True)
        return role, outcome, [f"{role}, {path}: {fault}" for fault in faults]

    def all_roles(self, path):
        results = [self.one(path, preset, [path], preset) for preset in ("buildings", "thesis")]
        results += [self.one(path, side, [f"-{side}", path, SAMPLE]) for side in SIDES]
        if results[0][1] != "refused":
            results += [self.one(path, f"{side} of itself", [f"-{side}", path, path]) for side in SIDES
                        if side != "cutline"]
        return results


def print_counts(results):
    counts = Counter((role, outcome) for role, outcome, _ in results)
    roles = list(dict.fromkeys(role for role, _, _ in results))
    outcomes = list(dict.fromkeys(outcome for _, outcome, _ in results))
    print("\n| role |", " | ".join(outcomes), "|")
    print("|---" * (len(outcomes) + 1) + "|")
    for role in roles:
        print(f"| {role} |", " | ".join(str(counts[role, outcome]) for outcome in outcomes), "|")


def main():
    given = arguments()
    files = files_in(given.folders)
    if not files:
        print(f"skipped: no file in {', '.join(map(str, given.folders))}; D2B_CORPUS names folders of rasters")
        return 0
    before = state_of(files)
    with tempfile.TemporaryDirectory(prefix="d2b_corpus_") as scratch, ThreadPoolExecutor(given.jobs) as pool:
        corpus = Corpus(scratch, given.list)
        results = [result for results in pool.map(corpus.all_roles, files) for result in results]
    faults = [fault for _, _, faults in results for fault in faults]
    if state_of(files) != before:
        faults.append("files were changed or added")
    print_counts(results)
    print(f"\n{len(results)} runs of {len(files)} files, {len(faults)} faults")
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
