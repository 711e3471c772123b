#!/usr/bin/python3
"""Measures dem2buildings_tiles beside dem2buildings on a mosaic of 64 files, for docs/research/tiles.md.

    cmake -S . -B build -D D2B_BUILD_BENCHMARKS=ON && cmake --build build --parallel
    tests/bench/tiles.py build                     100 million points, in some ten minutes
    tests/bench/tiles.py --million 1000 build      the figures of a country; half an hour with nothing else at work, 8 GB
    tests/bench/tiles.py --cell 0.5 build          cells of half a metre

Two processes with a thread each work on tiles, as the plain run has two threads; merge, which is one process, has two.
Each result is compared with that of the plain run, byte for byte. Core seconds are those of user and system together, of
all processes: other work on the machine disturbs them less than seconds. Needs gdal-bin.
"""
import argparse
import concurrent.futures
import filecmp
import json
import os
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

SIDE = 8  # files in a row, and rows


@dataclass
class Cost:
    core: float = 0  # s, user and system
    seconds: float = 0
    memory: int = 0  # bytes, of the largest process


def run(command):
    """Starts a process and waits for it."""
    begin = time.monotonic()
    process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f"{' '.join(map(str, command))} ended with {process.returncode}")
    return Cost(usage.ru_utime + usage.ru_stime, time.monotonic() - begin, usage.ru_maxrss * 1024)


def run_all(command, tiles, job):
    """Two processes at a time, with so many tiles each."""
    begin = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        costs = list(pool.map(run, [[*command, *range(first, min(first + job, tiles))] for first in range(0, tiles, job)]))
    return Cost(sum(cost.core for cost in costs), time.monotonic() - begin, max(cost.memory for cost in costs))


def make_mosaic(build, work, million, cell):
    folder = work / "mosaic"  # of a plan that nothing else is done for
    mosaic = folder / "source.vrt"
    if mosaic.exists():
        return mosaic
    city = work / "city.tif"
    subprocess.run([build / "tests/bench/make_city", "-cell", str(cell), str(million), city], check=True)
    size = json.loads(subprocess.run(["gdalinfo", "-json", city], check=True, capture_output=True).stdout)["size"]
    parts = []
    for row in range(SIDE):
        for col in range(SIDE):
            parts.append(work / f"part_{row}_{col}.tif")
            first = [size[0] * col // SIDE, size[1] * row // SIDE]
            end = [size[0] * (col + 1) // SIDE, size[1] * (row + 1) // SIDE]
            subprocess.run(["gdal_translate", "-q", "-co", "TILED=YES", "-co", "BLOCKXSIZE=256", "-co", "BLOCKYSIZE=256",
                            "-co", "COMPRESS=DEFLATE", "-co", "PREDICTOR=3", "-srcwin",
                            *map(str, first + [end[0] - first[0], end[1] - first[1]]), city, parts[-1]], check=True)
    city.unlink()
    names = work / "parts.txt"
    names.write_text("".join(f"{part}\n" for part in parts))
    subprocess.run([build / "tools/dem2buildings_tiles", "plan", "-q", "-input_file_list", names, work / "none.gpkg", folder],
                   check=True)
    return mosaic


def bytes_in(folder):
    return sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())


def measure(build, work, side, job, mosaic, whole):
    """The steps on tiles of so many units a side: cost by step, bytes between steps, tiles."""
    tool = build / "tools/dem2buildings_tiles"
    folder, result = work / "steps", work / "tiles.gpkg"
    shutil.rmtree(folder, ignore_errors=True)
    result.unlink(missing_ok=True)
    costs = {"plan": run([tool, "plan", "-q", "-tile", side, mosaic, result, folder])}
    tiles = json.loads((folder / "plan.json").read_text())["tiles"]
    costs["find"] = run_all([tool, "find", "-threads", 1, folder], tiles, job)
    costs["join"] = run([tool, "join", "-threads", 1, folder])
    costs["draw"] = run_all([tool, "draw", "-threads", 1, folder], tiles, job)
    costs["merge"] = run([tool, "merge", "-q", "-threads", 2, folder])  # nothing else is at work then
    if not filecmp.cmp(whole, result, shallow=False):
        sys.exit(f"-tile {side} gives other bytes than the plain run")
    start = run([tool, "--version"]).core
    between = {step: bytes_in(folder / step) for step in ("find", "join", "draw")}
    return costs, between, tiles, start * (2 * -(-tiles // job) + 3)


def show(name, plain, costs, between, tiles, start):
    core = sum(cost.core for cost in costs.values())
    seconds = sum(cost.seconds for cost in costs.values())
    print(f"\n{name}: {tiles} tiles, the bytes of the plain run\n\n| step | core s | s | MiB of the largest process | MB it leaves |"
          "\n|---|---:|---:|---:|---:|")
    for step, cost in {"plain run": plain, **costs}.items():
        left = f"{between[step] / 1e6:.0f}" if step in between else ""
        print(f"| {step} | {cost.core:.1f} | {cost.seconds:.1f} | {cost.memory / 2**20:.0f} | {left} |")
    print(f"\nall steps : plain run, core s {core / plain.core:.2f} (without {start:.1f} s of starting processes "
          f"{(core - start) / plain.core:.2f}), s {seconds / plain.seconds:.2f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="build folder with dem2buildings, dem2buildings_tiles and make_city")
    parser.add_argument("--million", type=int, default=100, help="points; default: %(default)s")
    parser.add_argument("--cell", type=float, default=1, help="m; default: %(default)s")
    parser.add_argument("--tile", default="1", help="units a side, with commas between; default: %(default)s")
    parser.add_argument("--job", type=int, default=1, help="tiles of a process; default: %(default)s")
    parser.add_argument("--work", type=Path, help="folder for all files; default: <build>/bench/tiles<million>_<cell>")
    given = parser.parse_args()
    build = given.build.resolve()
    work = (given.work or build / f"bench/tiles{given.million}_{given.cell:g}").resolve()
    work.mkdir(parents=True, exist_ok=True)
    os.environ["OGR_CURRENT_DATE"] = "2026-01-01T00:00:00.000Z"
    mosaic = make_mosaic(build, work, given.million, given.cell)
    whole = work / "whole.gpkg"
    whole.unlink(missing_ok=True)
    plain = run([build / "tools/dem2buildings", "-q", "-threads", 2, mosaic, whole])
    for side in given.tile.split(","):
        show(f"-tile {side}", plain, *measure(build, work, side, given.job, mosaic, whole))
    print(f"\n{given.million} million points of {given.cell:g} m: {bytes_in(work) / 1e6:.0f} MB in all, of which "
          f"{whole.stat().st_size / 1e6:.0f} MB are the result and "
          f"{sum(file.stat().st_size for file in work.glob('part_*.tif')) / 1e6:.0f} MB the source", flush=True)


if __name__ == "__main__":
    main()
