"""Time of the thesis's method over n, the points, and m, the most children that a contour has (5.3)."""
import json
import subprocess
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from osgeo import ogr

from blocks import children_seconds
from scene import read_filled, write_like
from thesis_mode import options


@dataclass
class Row:
    what: str
    n: int
    contours: int
    m: int
    corners: int
    seconds: float  # of a processor


def run(tool, source, given, vector):
    """Runs on one thread. @return the report and the seconds of a processor"""
    command = [str(tool), "-json", "-overwrite", "-threads", "1", "-layers", "contours", *given, str(source), vector]
    start = children_seconds()
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return json.loads(done.stdout), children_seconds() - start


def row(tool, source, what, given, repeats):
    """The least of some runs, which other work on the machine disturbs least; with reading, and with writing of the simplest format."""
    with tempfile.TemporaryDirectory() as folder:
        vector = str(Path(folder) / "out.gpkg")
        report, _ = run(tool, source, given, vector)
        layers = ogr.Open(vector)
        parents = Counter(contour["parent_id"] for contour in layers.GetLayer("contours"))
        quick = ["-f", "FlatGeobuf", "-lco", "SPATIAL_INDEX=NO", *given]
        seconds = min(run(tool, source, quick, str(Path(folder) / "out.fgb"))[1] for _ in range(repeats))
    most = max((count for parent, count in parents.items() if parent is not None), default=0)
    return Row(what, report["input"]["points"], report["output"]["contours"], most, report["output"]["vertices"],
               seconds)


def started(tool, tiny, repeats):
    """Seconds of a run on next to nothing, which all runs have on top."""
    return row(tool, tiny, "", options(4, 0), repeats).seconds


def tiled(source, path, times):
    """The raster so many times beside and below itself."""
    z, valid = read_filled(source)
    write_like(path, source, np.tile(z, (times, times)), np.tile(valid, (times, times)))
    return path


def over_n(tool, source, tiny, sides=(250, 500, 1000, 2000, 4000), repeats=5):
    """Windows of a square raster from its upper left corner; the larger ones repeat it."""
    start = started(tool, tiny, repeats)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        whole = read_filled(source)[0].shape[0]
        for side in sides:
            place = tiled(source, Path(folder) / "tiled.tif", side // whole) if side > whole else source
            rows.append(row(tool, place, f"{side} x {side}",
                            ["-srcwin", "0", "0", str(side), str(side), *options(4, 10)], repeats))
            rows[-1].seconds -= start
    return rows


def over_m(tool, source, tiny, settings=((1, 40), (4, 10), (16, 5), (64, 0)), repeats=5):
    """More and smaller contours of the same points."""
    start = started(tool, tiny, repeats)
    rows = [row(tool, source, f"LOD {lod}, NF {nf}", options(lod, nf), repeats) for lod, nf in settings]
    for one in rows:
        one.seconds -= start
    return rows
