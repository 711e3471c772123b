"""The thesis's own settings: its results as contours, and as a closed surface on a level plate."""
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from osgeo import ogr

from blocks import run_tool
from closed import close
from scene import gdal

FOOT = 0.3048


@dataclass
class Setting:
    """The result of one level of detail and one noise factor."""
    name: str
    lod: int
    nf: int
    surface: object
    seconds: float  # of a processor
    corners: int  # after compression, of all contours
    lattice_points: int  # before; none where walls are straight
    box: tuple  # width and length of the lowest contour with the largest box, m
    height: float  # from the ground of a building to the top of its stack, m


def options(lod, nf):
    return ["-preset", "thesis", "-lod", str(lod), "-nf", str(nf)]


def run_setting(tool, scene, lod, nf):
    return run_options(tool, scene, f"LOD {lod}, NF {nf}", options(lod, nf), lod, nf)


def run_natural(tool, scene):
    """The default preset: levels between the roofs of each building, straight walls."""
    return run_options(tool, scene, "defaults", [], None, None)


def run_options(tool, scene, name, given, lod, nf):
    found = run_tool(tool, scene, [*given, "-surface_of", "contours"], rasters=False)
    with tempfile.TemporaryDirectory() as folder:
        vector = Path(folder) / "out.gpkg"
        subprocess.run([str(tool), "-q", *given, str(scene.path), str(vector)], check=True)
        layers = ogr.Open(str(vector))
        contours = list(layers.GetLayer("contours"))
        ground = {row["id"]: row["ground"] for row in layers.GetLayer("buildings")}
    unit = found.report["units"]["vertical_metres"]
    # Level 0 is the plate; the default preset has none, and stands on the lowest ground.
    plate = next((row["top"] for row in contours if row["level"] == 0), None)
    plate = min(filter(None, ground.values())) if plate is None else plate
    surface, _ = close(found.skin, np.full(scene.z.shape, plate * unit), scene.cell, 0)
    lattice = sum(row.GetGeometryRef().Boundary().Length() for row in contours) / scene.cell
    boxes = [row.GetGeometryRef().GetEnvelope() for row in contours if row["level"] == 1]
    sizes = [(right - left, top - bottom) for left, right, bottom, top in boxes]
    # Beside cells without a value a building has no ground.
    heights = [(row["top"] - ground[row["bldg_id"]]) * unit for row in contours
               if row["level"] > 0 and ground[row["bldg_id"]] is not None]
    return Setting(name, lod, nf, surface, found.seconds, found.report["output"]["vertices"],
                   round(lattice) if given else None, max(sizes, key=lambda box: box[0] * box[1]), max(heights))


def metric(path, folder):
    """A copy whose elevations are metres, of a raster in feet."""
    copy = Path(folder) / "metres.tif"
    source = gdal.Open(str(path))
    if source.GetRasterBand(1).GetUnitType() != "ft":
        return path
    top = float(source.ReadAsArray().max())
    gdal.Translate(str(copy), source, scaleParams=[[0, top, 0, top * FOOT]], outputType=gdal.GDT_Float32)
    made = gdal.Open(str(copy), gdal.GA_Update)
    made.GetRasterBand(1).SetUnitType("m")
    return copy
