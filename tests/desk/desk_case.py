"""Helpers that the tests in the real QGIS share: the program, a folder of results, pictures and how they are compared."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from qgis._3d import Qgs3D
from qgis.core import (QgsApplication, QgsHillshadeRenderer, QgsMapRendererSequentialJob, QgsMapSettings,
                       QgsProject, QgsRasterLayer, QgsRectangle, QgsVectorLayer)
from qgis.PyQt.QtCore import QSize
from qgis.PyQt.QtGui import QColor, QImage

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
TOOL = os.environ.get("D2B_TOOL", str(SOURCE / "build/tools/dem2buildings"))
SAMPLES = SOURCE / "sample_dems"

application = QgsApplication([], True)
application.initQgis()
# Initialises 3D as the desktop does, because the styles of layers are read without their 3D part otherwise.
Qgs3D.initialize()
# Layers without a style get the same colour every time.
QgsProject.instance().writeEntryBool("DefaultStyles", "/RandomColors", False)


def share_of_difference(picture, expected):
    """Share of pixels that differ by more than a shade; letters of another font are a few of them."""
    different = 0
    for y in range(expected.height()):
        for x in range(expected.width()):
            a, b = QColor(picture.pixel(x, y)), QColor(expected.pixel(x, y))
            distance = max(abs(a.red() - b.red()), abs(a.green() - b.green()), abs(a.blue() - b.blue()))
            different += distance > 40
    return different / (expected.width() * expected.height())


class DeskCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="d2b_desk_"))
        for sample in ("town.tif", "hotel_70x85.tif"):  # QGIS writes statistics beside the files it shows
            shutil.copy(SAMPLES / sample, cls.folder / sample)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def make(cls, name, *options, sample="town.tif"):
        """Runs the program. @return the result's path"""
        target = cls.folder / name
        subprocess.run([TOOL, "-q", *options, str(cls.folder / sample), str(target)], check=True)
        return target

    def layer(self, path, name=None):
        layer = QgsVectorLayer(str(path) + (f"|layername={name}" if name else ""), name or path.stem, "ogr")
        self.assertTrue(layer.isValid(), f"{path} {name}")
        return layer

    def render(self, layer, box, size=(480, 360)):
        """The layer over the hillshade of the town."""
        relief = QgsRasterLayer(str(self.folder / "town.tif"), "relief")
        relief.setRenderer(QgsHillshadeRenderer(relief.dataProvider(), 1, 315, 45))
        settings = QgsMapSettings()
        settings.setLayers([layer, relief])
        settings.setDestinationCrs(relief.crs())
        settings.setExtent(QgsRectangle(*box))
        settings.setOutputSize(QSize(*size))
        settings.setBackgroundColor(QColor("white"))
        job = QgsMapRendererSequentialJob(settings)
        job.start()
        job.waitForFinished()
        self.assertEqual(job.errors(), [])
        return job.renderedImage()

    def difference(self, picture, name):
        """Difference to the expected picture of the documents. D2B_DESK_PICTURES=<folder> keeps the new ones; look at
        them and copy them to docs/pictures/ when they are better."""
        keep = os.environ.get("D2B_DESK_PICTURES")
        if keep:
            picture.save(str(pathlib.Path(keep) / f"qgis_{name}"))
        expected = QImage(str(SOURCE / "docs/pictures" / f"qgis_{name}"))
        self.assertFalse(expected.isNull(), f"there is no picture {name}")
        return share_of_difference(picture, expected)
