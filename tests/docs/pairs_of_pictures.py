#!/usr/bin/python3
"""The pictures of the documents that show two previews of one window beside each other.

    pairs_of_pictures.py <dem2buildings> <source folder> <folder of the cities> [--write]
    pairs_of_pictures.py --compare <picture> <picture of docs/pictures>

Both halves are drawn by the program with options of their own. Ends with status 1 if a picture of docs/pictures differs
in more than 2 % of its cells; with --write they are made anew. A city that is not in the folder is left out, because
their data are not part of the source. Needs Debian's python3-gdal and python3-numpy.
"""

import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from osgeo import gdal

gdal.UseExceptions()

SIZE = 640
SIZE_OF_PART = 420
GAP = 12
A_SHADE = 40  # as in compare_pictures.cpp: a little more than fonts of another version change
MOST = 0.02

TOWN = "sample_dems/town.tif"
TRACED = ["-regularize", "off"]
NOTHING = ["-min_building_height", "1000"]
# Raster (of a city: below its folder), window, options of the left and of the right half.
PAIRS = {
    "raster_to_map": ("delft/dsm.tif", (84855, 447490, 84980, 447585), NOTHING, []),
    "walls_town": (TOWN, (391330, 5820480, 391530, 5820640), TRACED, []),
    "walls_delft": ("delft/dsm.tif", (84870, 447500, 84970, 447580), TRACED, []),
    "walls_stuttgart": ("stuttgart_csite2/dsm.tif", (513600, 5403000, 513800, 5403160), TRACED, []),
    "walls_bilbao": ("bilbao/dsm.tif", (501300, 4796440, 501700, 4796760), TRACED, []),
    "houses_delft": ("delft/dsm.tif", (84880, 447510, 84960, 447574), [], ["-split_by", "docs/examples/delft_street.geojson"]),
    "crowns_montpellier": ("montpellier_als/dsm.tif", (770502, 6277502, 770627, 6277598), NOTHING, []),
}
# Parts of larger previews, because a result depends on all that is read. Raster, window that is shown, window that is read.
PARTS = {
    "worst_bilbao": ("bilbao/dsm.tif", (502560, 4796560, 502800, 4796860), (502300, 4796400, 502800, 4797000)),
    "worst_adelaide": ("adelaide_fusa_1m/dsm.tif", (277760, 6122425, 277850, 6122495), (277750, 6122250, 278000, 6122500)),
    "worst_stuttgart": ("stuttgart_csite2/dsm.tif", (513680, 5402964, 513770, 5403034), (513450, 5402650, 513870, 5403282)),
    "worst_huntington": ("huntington_va_2m/dsm.tif", (321596, 4297885, 321736, 4297990), (321498, 4297500, 322064, 4298018)),
    "worst_larochelle": ("larochelle_2m5/dsm.tif", (382310, 6564690, 382450, 6564800), (382022, 6564400, 382622, 6565000)),
    "worst_town": (TOWN, (391213, 5820833, 391253, 5820863), (391000, 5820500, 391500, 5821000)),
    "worst_seville": ("seville/dsm.tif", (234940, 4141900, 235060, 4141985), (234900, 4141700, 235200, 4142000)),
    "worst_annarbor": ("annarbor/dsm.tif", (13293275, 283155, 13293405, 283257), (13292818, 281639, 13294391, 283376)),
    "worst_agde": ("pacasam_agde/dsm.tif", (792000, 6271204, 792044, 6271240), (792000, 6271172, 792100, 6271272)),
    "worst_dallas": ("dallas/dsm.tif", (704516, 3632103, 704570, 3632147), (704470, 3632090, 704570, 3632190)),
}


def preview(program, dem, window, options, path, size=SIZE):
    """@return red, green and blue cells of a preview"""
    subprocess.run([program, "-q", "-te", *map(str, window), *options, "-preview", str(path), "-preview_size", str(size),
                    str(dem), str(path.with_suffix(".gpkg"))], check=True, stderr=subprocess.DEVNULL)
    return gdal.Open(str(path)).ReadAsArray()[:3]


def beside(halves):
    return np.concatenate([halves[0], np.full((3, halves[0].shape[1], GAP), 255, halves[0].dtype), halves[1]], axis=2)


def part_of(cells, read, shown):
    """@return the cells of a preview's map that show a window of it"""
    drawn = (cells != 255).any(axis=0)
    top = np.argmax(drawn.any(axis=1))
    drawn = drawn[top:top + np.argmin(drawn[top:].any(axis=1))]  # without the legend
    left = np.argmax(drawn.any(axis=0))
    scale = (drawn.shape[1] - left - np.argmax(drawn.any(axis=0)[::-1])) / (read[2] - read[0])
    row = top + round((read[3] - shown[3]) * scale)
    column = left + round((shown[0] - read[0]) * scale)
    return cells[:, row:row + round((shown[3] - shown[1]) * scale), column:column + round((shown[2] - shown[0]) * scale)]


def make_part(program, dem, shown, read):
    """As traced and with straight walls."""
    size = round(SIZE_OF_PART * max(read[2] - read[0], read[3] - read[1]) / max(shown[2] - shown[0], shown[3] - shown[1]))
    with tempfile.TemporaryDirectory() as place:
        return beside([part_of(preview(program, dem, read, options, pathlib.Path(place) / name, size), read, shown)
                       for name, options in (("before.png", TRACED), ("after.png", []))])


def make(program, source, dem, window, left, right):
    here = [str(source / word) if word.startswith("docs/") else word for word in right]
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        before = preview(program, dem, window, left, folder / "before.png").copy()
        after = preview(program, dem, window, here, folder / "after.png")
    if left == NOTHING:  # the legend and the counts belong to the result
        blank = (before == 255).all(axis=(0, 2))
        top = np.argmin(blank)
        before[:, top + np.argmax(blank[top:]):] = 255
    rows = max(before.shape[1], after.shape[1])
    halves = [np.pad(half, ((0, 0), (0, rows - half.shape[1]), (0, 0)), constant_values=255) for half in (before, after)]
    return beside(halves)


def write(path, made):
    memory = gdal.GetDriverByName("MEM").Create("", made.shape[2], made.shape[1], 3, gdal.GDT_Byte)
    memory.WriteArray(made)
    gdal.GetDriverByName("PNG").CreateCopy(str(path), memory)
    path.with_suffix(".png.aux.xml").unlink(missing_ok=True)


def cells_of(path):
    """@return the first three bands of a picture, or its only one"""
    cells = gdal.Open(str(path)).ReadAsArray()
    return cells[:3] if cells.ndim == 3 else cells[np.newaxis]


def share_of_difference(made, path):
    kept = cells_of(path) if path.exists() else np.empty(0)
    if kept.shape != made.shape:
        return 1.0
    return float((abs(kept.astype(int) - made) > A_SHADE).any(axis=0).mean())


def differs(made, path):
    share = share_of_difference(made, path)
    print(f"{path.name}: {share:.4f} of the cells differ")
    return share > MOST


def main(program, source, cities, anew):
    differ = 0
    for name, (raster, *drawing) in (PAIRS | PARTS).items():
        dem = source / raster if raster == TOWN else cities / raster
        if not dem.exists():
            print(f"{name} is left out: there is no {dem}")
            continue
        path = source / f"docs/pictures/{name}.png"
        made = make(program, source, dem, *drawing) if name in PAIRS else make_part(program, dem, *drawing)
        if anew:
            write(path, made)
            continue
        if differs(made, path):
            print(f"{path} is not what the program draws now; --write makes it anew.")
            differ += 1
    return 1 if differ else 0


if __name__ == "__main__":
    if sys.argv[1] == "--compare":
        sys.exit(differs(cells_of(sys.argv[2]), pathlib.Path(sys.argv[3])))
    sys.exit(main(sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]), "--write" in sys.argv[4:]))
