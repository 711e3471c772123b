"""A type checker takes good calls and finds wrong ones, by the stub that is made from the table of options."""

import importlib.util
import os
import pathlib
import subprocess
import sys
import unittest

import dem2buildings
from python_case import PythonCase

GOOD = '''
import pathlib
import numpy
import dem2buildings

dem = numpy.zeros((4, 5), "float32")
found = dem2buildings.extract(dem, transform=(0, 1, 0, 0, 0, -1), crs="EPSG:25833", lod=6, te=[1, 2, 3, 4],
                              preset="thesis", progress=print, mask=pathlib.Path("mask.tif"), t_srs=4326)
dem2buildings.extract([pathlib.Path("a.tif"), "b.tif"]).to_geodataframe("contours")
dem2buildings.extract(b"a.tif", ground=dem, mask=dem > 1, ndvi=b"ndvi.tif", nodata=-9999)
assert found.buildings is not None
heights = found.buildings.columns["height"]
numbers = [feature["id"] for feature in found.buildings]
report = dem2buildings.extract_file(pathlib.Path("a.tif"), "b.gpkg", lco={"A": 1}, with_z=True, overwrite=None)
print(report["output"], dem2buildings.score(found, "b.gpkg", min_object=3.5)["iou"])
try:
    dem2buildings.extract("a.tif")
except dem2buildings.InputError as error:
    print(error)
'''

WRONG = """
dem2buildings.extract(dem, lod="x")
dem2buildings.extract(dem, preset="house")
dem2buildings.extract(dem, overwrite=True)
dem2buildings.extract_file(dem, "b.gpkg")
dem2buildings.score(found, "b.gpkg", json=True)
"""


@unittest.skipIf(importlib.util.find_spec("mypy") is None, "mypy is not installed")
class Types(PythonCase):
    def check(self, text):
        """Numbers of the lines that are wrong."""
        (self.folder / "use.py").write_text(text)
        package = pathlib.Path(dem2buildings.__file__).parent.parent
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "use.py"], cwd=self.folder, text=True,
                              capture_output=True, env={**os.environ, "MYPYPATH": str(package)})
        lines = [line for line in done.stdout.splitlines() if ": error:" in line]
        self.assertEqual([line for line in lines if not line.startswith("use.py:")], [])
        return [int(line.split(":")[1]) for line in lines]

    def test_good_calls(self):
        self.assertEqual(self.check(GOOD), [])

    def test_wrong_calls(self):
        first = GOOD.count("\n") + 2
        self.assertEqual(self.check(GOOD + WRONG), list(range(first, first + 5)))


if __name__ == "__main__":
    unittest.main()
