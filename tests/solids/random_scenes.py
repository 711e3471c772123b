#!/usr/bin/python3
"""Surfaces of random scenes: buildings, contours and roofs of each.

    random_scenes.py <dem2buildings> [<how many> [<first seed>]]

A scene is a few blocks of any direction with steps, gables, hips, courtyards and corners that touch, on a slope with bumps, as a raster
of some thousand cells; its cell, its rotation and the options come from its seed. Checks each shell, in exact
arithmetic, with exact_shell.py, and each solid with check_cityjson.py. Prints the sums; the status is 1 where
any is not 0. Needs python3-gdal, python3-numpy and python3-jsonschema.
"""

import collections
import concurrent.futures
import json
import math
import os
import subprocess
import sys
import tempfile

import numpy as np
from osgeo import gdal, osr

import exact_shell
from check_cityjson import faults

gdal.UseExceptions()
SIZE = 56  # cells a side


def box(x, y, middle, half, angle):
    along = (x - middle[0]) * math.cos(angle) + (y - middle[1]) * math.sin(angle)
    across = (y - middle[1]) * math.cos(angle) - (x - middle[0]) * math.sin(angle)
    return (abs(along) <= half[0]) & (abs(across) <= half[1])


def roof(random, x, y, middle, half, angle):
    """Roof of a block, above its eaves: level, a slope, a gable or a hip, in cells."""
    along = (x - middle[0]) * math.cos(angle) + (y - middle[1]) * math.sin(angle)
    across = (y - middle[1]) * math.cos(angle) - (x - middle[0]) * math.sin(angle)
    slope = random.uniform(0.2, 1.2)
    return [0 * x, 0 * x, slope * (half[1] + across), slope * (half[1] - abs(across)),
            slope * np.minimum(half[1] - abs(across), half[0] - abs(along))][random.integers(5)]


def elevations(random, cell):
    """Metres; the lengths of buildings are cells."""
    y, x = np.mgrid[0:SIZE, 0:SIZE]
    z = 50 + random.uniform(-0.1, 0.1) * x + random.uniform(-0.1, 0.1) * y + random.normal(0, 0.02, x.shape)
    angles = random.choice([0, 0, random.uniform(0, math.pi / 2)]) + math.pi / 2 * np.arange(2)
    for _ in range(random.integers(1, 7)):
        middle, half = random.uniform(8, SIZE - 8, 2), random.uniform(3, 13, 2)
        angle = random.choice([angles[0], angles[0], random.uniform(0, math.pi)])
        height = random.choice([4, 7.5, 7.5, 12, 20])
        inside = box(x, y, middle, half, angle)
        if random.random() < 0.3:  # a courtyard
            inside &= ~box(x, y, middle + random.uniform(-2, 2, 2), half * random.uniform(0.2, 0.6), angle)
        z[inside] = 50 + height + cell * roof(random, x, y, middle, half, angle)[inside]
        if random.random() < 0.5:  # a tower, or a block that touches it in a corner
            corner = middle + half * random.choice([-1, 0.5, 1, 1.9], 2)
            z[box(x, y, corner, half * 0.5, angle)] = 50 + height + random.choice([-3, 0, 3, 9])
    if random.random() < 0.3:  # cells without an elevation
        z[box(x, y, random.uniform(0, SIZE, 2), random.uniform(1, 6, 2), 0)] = -9999
    return z


def write_scene(path, random):
    cell = float(random.choice([0.1, 0.25, 0.4, 0.5, 1, 1.5, 2.5, 30]))
    turn = float(random.choice([0, 0, 0, random.uniform(0, 2 * math.pi)]))
    place = (391000, cell * math.cos(turn), cell * math.sin(turn), 5820000, cell * math.sin(turn), -cell * math.cos(turn))
    raster = gdal.GetDriverByName("GTiff").Create(path, SIZE, SIZE, 1, gdal.GDT_Float32)
    raster.SetGeoTransform(place)
    crs = osr.SpatialReference()
    crs.ImportFromEPSG(25833)
    raster.SetProjection(crs.ExportToWkt())
    raster.GetRasterBand(1).SetNoDataValue(-9999)
    raster.GetRasterBand(1).WriteArray(elevations(random, cell))


def options(random, surface_of):
    thesis = surface_of == "contours" and random.random() < 0.5
    given = ["-surface_of", surface_of, "-preset", "thesis" if thesis else "buildings"]
    given += ["-lod", str(random.integers(1, 6))] if thesis or random.random() < 0.3 else []
    given += ["-split_height", "2"] if not thesis and random.random() < 0.5 else []
    given += [[], [], ["-regularize", "off"], ["-simplify", "1"]][random.integers(4)]
    given += [[], [], ["-t_srs", "EPSG:3035"]][random.integers(3)]
    flow = [[], [], ["-flow_ready", "1"]][random.integers(3)]
    return given + (flow if surface_of != "roofs" else ["-detail", str(random.choice([0.2, 0.5, 1]))])


FAULTS = ("open edges", "edges of more than two faces", "triangles that look the wrong way", "edges that cross a face",
          "corners that are one in single precision", "corners within a millimetre of another", "faults of solids")
# Missing buildings, which are no fault; they are reported only where there are any.
LOST = "buildings left out"


def look_at(tool, folder, given):
    """Counts of the surfaces of a run, and their faults."""
    names = {kind: os.path.join(folder, f"scene.{kind}") for kind in ("tif", "obj", "city.json", "gpkg")}
    command = [tool, "-q", "-overwrite", "-threads", "1", *given, "-surface", names["obj"], "-surface", names["city.json"],
               names["tif"], names["gpkg"]]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)}\n{done.stderr}")
    lost = [line for line in done.stderr.splitlines() if " not in the surface" in line]
    corners, triangles, groups = exact_shell.read(names["obj"])
    single = (np.array(corners, dtype=float).reshape(-1, 3) / 10 ** exact_shell.DECIMALS).astype(np.float32)
    with open(names["city.json"], encoding="utf-8") as file:
        city = json.load(file)
    wrong = (*exact_shell.edge_faults(corners, triangles), exact_shell.inverted(corners, triangles, groups, "roofs" in given),
             exact_shell.crossings(corners, triangles), len(corners) - len(np.unique(single, axis=0)),
             exact_shell.near_corners(corners), len(list(faults(city))))
    return collections.Counter({"with a surface": int(bool(triangles)), "solids": sum("geometry" in thing for thing in city["CityObjects"].values()),
                                "triangles": len(triangles), LOST: len(lost)} | dict(zip(FAULTS, wrong)))


def look_at_seeds(tool, surface_of, seeds):
    """The sums over some seeds; a seed with a fault is named."""
    found = collections.Counter()
    with tempfile.TemporaryDirectory() as folder:
        for seed in seeds:
            random = np.random.default_rng(seed)
            write_scene(os.path.join(folder, "scene.tif"), random)
            one = look_at(tool, folder, options(random, surface_of))
            if any(one[fault] for fault in (*FAULTS, LOST)):
                print(f"seed {seed}, -surface_of {surface_of}", file=sys.stderr)
            found.update(one)
    return found


def main(tool, count=1000, first=0):
    status = 0
    with concurrent.futures.ProcessPoolExecutor() as pool:
        for surface_of in ("buildings", "contours", "roofs"):
            pieces = [range(begin, min(begin + 20, first + count)) for begin in range(first, first + count, 20)]
            found = sum(pool.map(look_at_seeds, [tool] * len(pieces), [surface_of] * len(pieces), pieces),
                        collections.Counter())
            named = (*FAULTS, LOST) if found[LOST] else FAULTS
            print(f"-surface_of {surface_of}: {count} scenes, {found['with a surface']} with a surface, {found['solids']} "
                  f"solids, {found['triangles']} triangles: " + ", ".join(f"{found[fault]} {fault}" for fault in named),
                  flush=True)
            status = 1 if any(found[fault] for fault in (*FAULTS, LOST)) else status
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:4])))
