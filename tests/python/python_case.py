"""Helpers that the tests of the package share: the program, samples as arrays, a made block, content of a GeoPackage."""

import os
import pathlib
import shutil
import sqlite3
import subprocess
import tempfile
import unittest
import warnings

import numpy
from PIL import Image

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
SAMPLES = SOURCE / "sample_dems"
TOOL = os.environ["D2B_TOOL"]
SCORE_TOOL = os.environ["D2B_SCORE_TOOL"]

# Upper left corner and size of the cells of samples, as gdalinfo says.
TRANSFORMS = {"town": (391000, 1, 0, 5821000, 0, -1)}

# A transform and a CRS in metres.
PLACE = {"transform": (391000, 1, 0, 5820040, 0, -1), "crs": "EPSG:25833"}


def sample(name):
    """The elevations of a sample, as they stand in the file."""
    return numpy.asarray(Image.open(SAMPLES / f"{name}.tif"))


def block(dtype="float64", rows=40, cols=50):
    """Ground of 0 m with a block that is 14 m high, from row 10 to 24 and column 15 to 34."""
    dem = numpy.zeros((rows, cols), dtype)
    dem[10:25, 15:35] = 14
    return dem


# ETRS89 / UTM zone 33N, which is EPSG:25833, as Esri writes it.
UTM_33 = ('PROJCS["ETRS_1989_UTM_Zone_33N",GEOGCS["GCS_ETRS_1989",DATUM["D_ETRS_1989",SPHEROID["GRS_1980",6378137.0,'
          '298.257222101]],PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],'
          'PARAMETER["False_Easting",500000.0],PARAMETER["False_Northing",0.0],PARAMETER["Central_Meridian",15.0],'
          'PARAMETER["Scale_Factor",0.9996],PARAMETER["Latitude_Of_Origin",0.0],UNIT["Meter",1.0]]')


def write_grid(path, array):
    """Writes an Esri grid in the coordinates of PLACE. @param path bytes, or a pathlib.Path @return the path"""
    x, width, _, y, _, height = PLACE["transform"]
    rows, cols = array.shape
    with open(path, "w") as file:
        file.write(f"ncols {cols}\nnrows {rows}\nxllcorner {x}\nyllcorner {y + rows * height}\ncellsize {width}\n")
        file.writelines(" ".join(repr(float(value)) for value in row) + "\n" for row in array)
    with open(os.path.splitext(path)[0] + (b".prj" if isinstance(path, bytes) else ".prj"), "w") as file:
        file.write(UTM_33)
    return path


def geopackage_wkb(blob):
    """The WKB in a geometry of a GeoPackage, which begins with a header and an envelope."""
    envelope = {0: 0, 1: 32, 2: 48, 3: 48, 4: 64}[blob[3] >> 1 & 7]
    return blob[8 + envelope:]


def layer_of(path, name):
    """The WKBs of a layer, and its columns as lists."""
    with sqlite3.connect(path) as database:
        cursor = database.execute(f"SELECT * FROM {name} ORDER BY fid")
        columns = [column[0] for column in cursor.description]
        rows = cursor.fetchall()
    table = {column: [row[i] for row in rows] for i, column in enumerate(columns)}
    del table["fid"]
    return [geopackage_wkb(blob) for blob in table.pop("geom")], table


def values(column):
    """The values of a column of a result, None for NULL."""
    listed = column.tolist()
    return [None if isinstance(value, float) and value != value else value for value in listed]


class PythonCase(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="d2b_python_"))
        self.addCleanup(shutil.rmtree, self.folder)
        # A warning that no test asks for is a failure.
        catcher = warnings.catch_warnings()
        catcher.__enter__()
        self.addCleanup(catcher.__exit__, None, None, None)
        warnings.simplefilter("error")

    def program(self, source, *options, name="program.gpkg"):
        """Runs the program. @return the result's path"""
        target = self.folder / name
        subprocess.run([TOOL, "-q", *options, str(source), str(target)], check=True, stderr=subprocess.DEVNULL)
        return target

    def assert_same_layer(self, layer, path):
        wkb, columns = layer_of(path, layer.name)
        self.assertEqual(layer.wkb.tolist(), wkb)
        self.assertEqual(list(layer.columns), list(columns))
        for name, column in layer.columns.items():
            self.assertEqual(values(column), columns[name], name)

    def assert_same_features(self, found, path):
        self.assertGreater(len(found.buildings), 0)
        self.assert_same_layer(found.buildings, path)
        self.assert_same_layer(found.contours, path)
