"""The examples in docstrings and on the page of Python are true."""

import doctest
import importlib
import importlib.util
import os
import pkgutil
import shutil
import unittest
import warnings

import numpy
from PIL import Image

import dem2buildings
from python_case import SOURCE, PythonCase

FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


class Words(PythonCase):
    def setUp(self):
        super().setUp()
        self.addCleanup(os.chdir, os.getcwd())

    def test_docstrings(self):
        os.chdir(SOURCE)
        examples = 0
        for module in pkgutil.iter_modules(dem2buildings.__path__, "dem2buildings."):
            loaded = importlib.import_module(module.name)
            result = doctest.testmod(loaded, optionflags=FLAGS)
            self.assertEqual(result.failed, 0, module.name)
            examples += result.attempted
        self.assertGreater(examples, 4)

    @unittest.skipIf(importlib.util.find_spec("geopandas") is None, "GeoPandas is not installed")
    @unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "Matplotlib is not installed")
    def test_the_page(self):
        """Also makes its picture, which is kept in the folder D2B_PICTURES where that is given."""
        warnings.simplefilter("default", DeprecationWarning)  # GeoPandas has some of Shapely's
        os.symlink(SOURCE / "sample_dems", self.folder / "sample_dems")
        os.chdir(self.folder)
        result = doctest.testfile(str(SOURCE / "docs/tasks/python.md"), module_relative=False, optionflags=FLAGS)
        self.assertEqual(result.failed, 0)
        self.assertGreater(result.attempted, 10)
        made = self.folder / "python_map.png"
        if "D2B_PICTURES" in os.environ:
            shutil.copy(made, os.environ["D2B_PICTURES"])
        self.assertLess(share_of_difference(made, SOURCE / "docs/pictures/python_map.png"), 0.02)


def share_of_difference(one, other):
    """Share of pixels that differ by more than a shade; letters of another font are a few of them."""
    pixels = [numpy.asarray(Image.open(path).convert("RGB"), "int16") for path in (one, other)]
    if pixels[0].shape != pixels[1].shape:
        return 1
    return float((abs(pixels[0] - pixels[1]).max(axis=2) > 40).mean())


if __name__ == "__main__":
    unittest.main()
