#!/usr/bin/python3
"""The first picture of the README: on the left the sample town's raster, on the right its buildings.

    raster_to_map.py <dem2buildings> <source folder> [--write]

Both halves are previews of the program, of which the left one keeps no building, so that relief and scale are the same.
Ends with status 1 if the picture of docs/pictures differs in more than 2 % of its cells; with --write it is made anew.
Needs Debian's python3-gdal and python3-numpy.
"""

import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from osgeo import gdal

gdal.UseExceptions()

WINDOW = ("391330", "5820480", "391630", "5820720")
SIZE = 640
GAP = 12
A_SHADE = 40  # as in compare_pictures.cpp: a little more than fonts of another version change
MOST = 0.02


def preview(program, dem, folder, name, *options):
    """Draws a preview of the window. @return its red, green and blue cells"""
    picture = folder / f"{name}.png"
    subprocess.run([program, "-q", "-te", *WINDOW, *options, "-preview", str(picture), "-preview_size", str(SIZE), str(dem),
                    str(folder / f"{name}.gpkg")], check=True, stderr=subprocess.DEVNULL)
    return gdal.Open(str(picture)).ReadAsArray()[:3]


def make(program, dem):
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        before = preview(program, dem, folder, "before", "-min_building_height", "1000")
        after = preview(program, dem, folder, "after")
    frame = np.where((before < 200).all(axis=0).sum(axis=1) > SIZE * 0.9)[0]  # rows of its upper and lower border
    before = before.copy()
    before[:, frame[-1] + 1:] = 255  # the legend and the counts belong to the result
    between = np.full((3, before.shape[1], GAP), 255, before.dtype)
    return np.concatenate([before, between, after], axis=2)


def main(program, source, write):
    made = make(program, source / "sample_dems/town.tif")
    path = source / "docs/pictures/raster_to_map.png"
    if write:
        memory = gdal.GetDriverByName("MEM").Create("", made.shape[2], made.shape[1], 3, gdal.GDT_Byte)
        memory.WriteArray(made)
        gdal.GetDriverByName("PNG").CreateCopy(str(path), memory)
        path.with_suffix(".png.aux.xml").unlink(missing_ok=True)
        return 0
    kept = gdal.Open(str(path)).ReadAsArray()
    share = 1.0
    if kept.shape == made.shape:
        share = float((abs(kept.astype(int) - made) > A_SHADE).any(axis=0).mean())
    print(f"{share:.4f} of the cells differ")
    if share > MOST:
        print(f"{path} is not what the program draws now; --write makes it anew.")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], pathlib.Path(sys.argv[2]), "--write" in sys.argv[3:]))
