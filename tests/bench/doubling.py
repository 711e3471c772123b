#!/usr/bin/env python3
"""Measures the cost of twice the cells of one large object, with each option that works on outlines.

    doubling.py <dem2buildings> [--cells 8000] [--cell_size 1] [--overall] [--shape ragged]...
                [--only flow_ready]...

A ragged block, a comb, a spiral and a checkerboard of some 8,000 cells and of twice and four times as many, each a single
block of touching roofs on level ground. Prints the instructions in millions, as Valgrind counts them, which are the same
on a busy machine, and by how much they grow, less those of a run on one small house with the same options, because the
start of the program would hide the growth. Where there is no Valgrind it is milliseconds of processor, the least of five
runs, of which nothing is taken off, because they are too uneven. With cells of a metre a wall of two cells is wide enough
for a building; with smaller ones a limit in metres reaches over more cells. The status is 1 where twice the cells cost
more than 2.5 times, or with --overall where four times the cells cost more than 2.5 times 2.5. Needs GDAL's Python and
NumPy.
"""

import argparse
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile

import numpy as np
from osgeo import gdal, osr

gdal.UseExceptions()
MOST = 2.5
COMMON = ["-q", "-overwrite", "-threads", "1", "-ground", "none", "-min_confidence", "0", "-levels", "building"]
OPTIONS = [
    ["-flow_ready", "2"], ["-min_gap", "2"], ["-min_wall", "2"], ["-flow_ready", "2", "-preset", "buildings", "-lod", "9"],
    ["-regularize", "off"], ["-regularize", "right"], ["-regularize", "free"], ["-regularize_tolerance", "3"],
    ["-regularize", "off", "-simplify", "0.5"], ["-arcs"], ["-wall_inset", "0.3"], ["-split_height", "3"],
    ["-surface", "s.obj"], ["-surface", "s.city.json"], ["-surface", "s.obj", "-surface_of", "contours"],
    ["-surface", "s.obj", "-split_height", "3", "-min_wall", "1"], ["-write_problems", "-surface", "s.stl"],
    ["-write_rejected"], ["-trace", "points"],
]


def ragged(rows, cols):
    """A ragged block, as in a picture or a crown: many courtyards, gaps and narrow parts."""
    squares = np.fft.fftfreq(rows)[:, None]**2 + np.fft.fftfreq(cols)[None, :]**2
    squares[0, 0] = 1
    noise = np.random.default_rng(0).normal(size=(rows, cols))
    field = np.fft.ifft2(np.fft.fft2(noise) / squares**.6).real
    return np.floor(np.clip(field / field.std() * 45 + 120, 0, 254))


def with_noise(heights):
    """Adds a centimetre, because cells of the same height count as interpolated, and detection searches a raster with many of
    them again; but only above some 16,000 cells, where there are enough of them to tell."""
    return heights + np.random.default_rng(0).normal(0, .01, heights.shape)


def comb(rows, cols):
    """A spine at the left edge, with a comb of teeth of two cells for every sixteen rows."""
    row, col = np.mgrid[0:rows, 0:cols]
    tooth = (col % 4 < 2) & (row % 16 < 12)
    return with_noise(np.where((col < 4) | (row % 16 < 3) | tooth, 20.0, 0.0))


def spiral(rows, cols):
    """Walls of three cells with three between them, rectangle within rectangle, joined at one corner each."""
    row, col = np.mgrid[0:rows, 0:cols]
    ring = np.minimum(np.minimum(row, rows - 1 - row), np.minimum(col, cols - 1 - col))
    heights = np.where(ring % 6 < 3, 20.0, 0.0)
    for start in range(3, min(rows, cols) // 2, 6):
        heights[start:start + 3, start + 3:start + 6] = 20
    return with_noise(heights)


def checkerboard(rows, cols):
    row, col = np.mgrid[0:rows, 0:cols]
    return np.where((row // 3 + col // 3) % 2 == 0, 20.0, 12.0) * ((row + col) % 41 > 1)


def house():
    heights = np.zeros((20, 20))
    heights[6:14, 6:14] = 20
    return heights


SHAPES = {"ragged": ragged, "comb": comb, "spiral": spiral, "checkerboard": checkerboard}


def write(path, heights, cell_size):
    rows, cols = heights.shape
    dataset = gdal.GetDriverByName("GTiff").Create(path, cols, rows, 1, gdal.GDT_Float32)
    dataset.SetGeoTransform((500000, cell_size, 0, 5600000, 0, -cell_size))
    crs = osr.SpatialReference()
    crs.ImportFromEPSG(25832)
    dataset.SetProjection(crs.ExportToWkt())
    dataset.GetRasterBand(1).WriteArray(heights)


def instructions(command, folder):
    run = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *command], cwd=folder,
                         capture_output=True, text=True, errors="replace")
    counted = re.search(r"Collected : (\d+)", run.stderr)
    if run.returncode != 0 or not counted:
        sys.exit(f"{' '.join(command)} ended with {run.returncode}:\n{run.stderr}")
    return int(counted.group(1)) / 1e6


def milliseconds(command, folder):
    least = float("inf")
    for _ in range(5):
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        run = subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace")
        if run.returncode != 0:
            sys.exit(f"{' '.join(command)} ended with {run.returncode}:\n{run.stderr}")
        least = min(least, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before)
    return 1000 * least


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--cells", type=int, default=8000)
    parser.add_argument("--cell_size", type=float, default=1, help="m")
    parser.add_argument("--overall", action="store_true", help="judge four times the cells alone")
    parser.add_argument("--shape", action="append", choices=list(SHAPES))
    parser.add_argument("--only", action="append", help="name of an option, with its dash left out, or none")
    parser.add_argument("--time", action="store_true", help="milliseconds of processor, also where there is Valgrind")
    asked = parser.parse_args()
    by_time = asked.time or not shutil.which("valgrind")
    cost = milliseconds if by_time else instructions
    program = os.path.abspath(asked.program)
    side = round(asked.cells**0.5)
    too_much = 0
    with tempfile.TemporaryDirectory() as folder:
        write(f"{folder}/house.tif", house(), asked.cell_size)
        # All runs replace a layer, because the first would not, and that would count as growth.
        subprocess.run([program, *COMMON, "house.tif", "o.gpkg"], cwd=folder, check=True)
        starts = {}
        print(f"| shape | option | {'ms' if by_time else 'million instructions'} | twice the cells | four times |")
        print("|---|---|---:|---:|---:|")
        for shape in asked.shape or SHAPES:
            for i, size in enumerate(((side, side), (side, 2 * side), (2 * side, 2 * side))):
                write(f"{folder}/{shape}{i}.tif", SHAPES[shape](*size), asked.cell_size)
            for options in [[], *OPTIONS]:
                if asked.only and not any(f"-{name}" in options or name == "none" and not options for name in asked.only):
                    continue
                words = tuple(options)
                command = [program, *COMMON, *options]
                if words not in starts:
                    starts[words] = 0 if by_time else cost([*command, "house.tif", "o.gpkg"], folder)
                costs = [cost([*command, f"{shape}{i}.tif", "o.gpkg"], folder) - starts[words] for i in range(3)]
                once, twice = costs[1] / costs[0], costs[2] / costs[1]
                flag = " **" if (once * twice)**0.5 > MOST or (max(once, twice) > MOST and not asked.overall) else ""
                too_much += bool(flag)
                print(f"| {shape} | {' '.join(options) or 'none'} | {costs[0]:,.0f} | x {once:.2f} | x {twice:.2f}{flag} |",
                      flush=True)
    return 1 if too_much else 0


if __name__ == "__main__":
    sys.exit(main())
