#!/usr/bin/env python3
"""Keeps SHA-256 sums of outputs, so that a change of the code that must not change them can be compared.

freeze_outputs.py [-j N] <folder of programs> <file of sums> <raster or folder>...

Without the file of sums, it is written. Where it exists, the outputs are made again and compared with it; the status
is 1 where one differs. Folders stand for the rasters below them; a folder with an `ndsm_lod1.tif` or `dsm.tif` stands
for that one. Each raster is run with both presets on 1 and on 4 threads, which must agree. The first raster is also run
with surfaces, a page, rasters and, with the default preset, in tiles.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

RASTERS = (".tif", ".tiff", ".asc", ".img", ".vrt", ".png", ".jpg", ".dem", ".bil", ".nc", ".hgt")
# The options of a run, and the destination.
EACH = {
    "default": ([], "out.gpkg"),
    "thesis": (["-preset", "thesis"], "out.gpkg"),
}
FIRST = {
    "geojson": (["-t_srs", "EPSG:4326"], "out.geojson"),
    "rasters": (["-write_ground", "ground.tif", "-write_height", "height.tif", "-write_canopy", "canopy.tif"], "out.gpkg"),
    "page": (["-page", "page.html", "-preview", "map.svg"], "out.gpkg"),
    "flow": (["-flow_ready", "1", "-surface", "solids.stl"], "out.gpkg"),
    "parts": (["-split_height", "3", "-surface", "solids.city.json", "-surface_of", "contours"], "out.gpkg"),
    "obj": (["-surface", "solids.obj"], "out.gpkg"),
    "glb": (["-surface", "solids.glb"], "out.gpkg"),
    "free": (["-regularize", "free", "-nf", "20", "-lod", "4"], "out.gpkg"),
}
ENVIRONMENT = os.environ | {"OGR_CURRENT_DATE": "2000-01-01T00:00:00.000Z", "LC_ALL": "C"}


def rasters_of(names):
    for path in map(pathlib.Path, names):
        if path.is_file():
            yield path
            continue
        for folder, _, files in sorted(os.walk(path)):
            surface = [name for name in ("ndsm_lod1.tif", "dsm.tif") if name in files]
            for name in surface[:1] or sorted(file for file in files if file.lower().endswith(RASTERS)):
                yield pathlib.Path(folder, name)


def sums_of_folder(folder):
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(pathlib.Path(folder).rglob("*")) if path.is_file()}


def run(programs, raster, options, destination, threads):
    """The sums of all files and messages that a run writes."""
    with tempfile.TemporaryDirectory() as folder:
        command = [programs / "dem2buildings", "-q", "-threads", str(threads), *options, raster, destination]
        try:
            done = subprocess.run(command, cwd=folder, env=ENVIRONMENT, capture_output=True, timeout=600)
        except subprocess.TimeoutExpired:
            return {"status": "timeout"}
        said = done.stdout + done.stderr.replace(folder.encode(), b".")
        return {"status": str(done.returncode), "said": hashlib.sha256(said).hexdigest()} | sums_of_folder(folder)


def run_tiles(programs, raster):
    tiles = programs / "dem2buildings_tiles"
    with tempfile.TemporaryDirectory() as folder:
        def step(*words):
            subprocess.run([tiles, *words], cwd=folder, env=ENVIRONMENT, check=True, capture_output=True)

        step("plan", "-q", raster, "out.gpkg", "work")
        count = json.loads(pathlib.Path(folder, "work/plan.json").read_text())["tiles"]
        everywhere = [str(tile) for tile in range(count)]
        step("find", "work", *everywhere)
        step("join", "work")
        step("draw", "work", *everywhere)
        step("merge", "work")
        return {"out.gpkg": hashlib.sha256(pathlib.Path(folder, "out.gpkg").read_bytes()).hexdigest()}


def jobs_of(programs, rasters):
    """Name of a run, and the function that makes its sums."""
    for number, raster in enumerate(rasters):
        for name, (options, destination) in (EACH | FIRST if number == 0 else EACH).items():
            for threads in (1, 4):
                yield f"{raster} {name} {threads}", lambda r=raster, o=options, d=destination, t=threads: run(programs, r, o, d, t)
        if number == 0:
            yield f"{raster} default tiles", lambda r=raster: run_tiles(programs, r)


def differences(kept, made):
    for name in sorted(kept.keys() | made.keys()):
        for file in sorted(kept.get(name, {}).keys() | made.get(name, {}).keys()):
            if kept.get(name, {}).get(file) != made.get(name, {}).get(file):
                yield f"{name}: {file}"


def threads_differ(made):
    for name, sums in made.items():
        if name.endswith(" 1") and sums != made[name[:-1] + "4"]:
            yield f"{name[:-2]}: 1 and 4 threads"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-j", type=int, default=os.cpu_count(), help="runs at the same time")
    parser.add_argument("programs", type=pathlib.Path)
    parser.add_argument("sums", type=pathlib.Path)
    parser.add_argument("rasters", nargs="+")
    given = parser.parse_args()
    rasters = [raster.resolve() for raster in rasters_of(given.rasters)]
    jobs = dict(jobs_of(given.programs.resolve(), rasters))
    with concurrent.futures.ThreadPoolExecutor(given.j) as pool:
        made = dict(zip(jobs, pool.map(lambda job: job(), jobs.values())))
    found = list(threads_differ(made))
    if given.sums.exists():
        found += differences(json.loads(given.sums.read_text()), made)
    else:
        given.sums.write_text(json.dumps(made, indent=1))
    print(f"{len(made)} runs of {len(rasters)} rasters, {len(found)} differences", *found, sep="\n")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
