"""The parts that dem2buildings_tiles writes open in QGIS as one: layers of FlatGeobuf files and a raster of GeoTIFFs."""

import json
import pathlib
import subprocess
import unittest

from qgis.core import QgsFeatureRequest, QgsRasterLayer, QgsRectangle

import desk_case
from desk_case import DeskCase

TILES = str(pathlib.Path(desk_case.TOOL).with_name("dem2buildings_tiles"))
# More than 64 million points are four units; the town lies around the corner where they meet.
SIDE, FIRST = 8300, -3650


class Parts(DeskCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        window = [str(number) for number in (FIRST, FIRST, SIDE, SIDE)]
        subprocess.run(["gdal_translate", "-q", "-of", "VRT", "-a_nodata", "-9999", "-srcwin", *window,
                        cls.folder / "town.tif", cls.folder / "country.vrt"], check=True)
        cls.whole = cls.make("whole.gpkg", "-write_height", str(cls.folder / "whole.tif"), sample="country.vrt")
        cls.step("plan", "-q", "-f", "FlatGeobuf", "-write_height", "heights.vrt", "country.vrt", "parts", "work")
        tiles = range(json.loads((cls.folder / "work/plan.json").read_text())["tiles"])
        assert len(tiles) == 4
        cls.step("find", "work", *tiles)
        cls.step("join", "work")
        cls.step("draw", "work", *tiles)
        cls.step("merge", "-q", "work")
        cls.step("write", "work", *tiles)

    @classmethod
    def step(cls, *words):
        subprocess.run([TILES, *map(str, words)], cwd=cls.folder, check=True)

    def both(self, name):
        """A layer in parts, and as one run writes it."""
        return self.layer(self.folder / "parts" / f"{name}.vrt", name), self.layer(self.whole, name)

    def test_layers_are_those_of_one_run(self):
        for name in ("buildings", "contours"):
            parts, whole = self.both(name)
            self.assertGreater(len(list((self.folder / "parts" / name).glob("*.fgb"))), 1)
            self.assertEqual(parts.crs().authid(), "EPSG:25833")
            self.assertGreater(parts.featureCount(), 100)
            self.assertEqual(parts.featureCount(), whole.featureCount())
            for got, expected in ((parts.extent().toRectF(), whole.extent().toRectF()),):
                for side in ("left", "top", "right", "bottom"):
                    self.assertAlmostEqual(getattr(got, side)(), getattr(expected, side)(), places=6)

    def test_features_are_those_of_one_run(self):
        for name in ("buildings", "contours"):
            parts, whole = self.both(name)
            shared = [field.name() for field in parts.fields() if whole.fields().indexOf(field.name()) >= 0]
            self.assertIn("id", shared)
            expected = {feature["id"]: feature for feature in whole.getFeatures()}
            got = list(parts.getFeatures())
            self.assertEqual(sorted(feature["id"] for feature in got), sorted(expected))
            for feature in got:
                one = expected[feature["id"]]
                self.assertTrue(feature.geometry().equals(one.geometry()), f"{name} {feature['id']}")
                self.assertEqual([feature[field] for field in shared], [one[field] for field in shared])

    def test_a_part_of_the_map_asks_for_its_features(self):
        parts, whole = self.both("buildings")
        middle = whole.extent().center()
        box = QgsRectangle(middle.x() - 60, middle.y() - 60, middle.x() + 60, middle.y() + 60)
        found = [sorted(feature["id"] for feature in layer.getFeatures(QgsFeatureRequest(box))) for layer in (parts, whole)]
        self.assertGreater(len(found[0]), 1)
        self.assertEqual(found[0], found[1])

    def test_a_map_shows_all_parts(self):
        parts, whole = self.both("buildings")
        whole.setRenderer(parts.renderer().clone())
        whole.setLabelsEnabled(False)
        box = whole.extent()
        corners = (box.xMinimum(), box.yMinimum(), box.xMaximum(), box.yMaximum())
        self.assertLess(desk_case.share_of_difference(self.render(parts, corners), self.render(whole, corners)), 0.001)

    def test_a_raster_is_that_of_one_run(self):
        parts, whole = (QgsRasterLayer(str(self.folder / name), name) for name in ("heights.vrt", "whole.tif"))
        self.assertTrue(parts.isValid() and whole.isValid())
        self.assertEqual(parts.crs(), whole.crs())
        self.assertEqual(parts.extent(), whole.extent())
        town = QgsRasterLayer(str(self.folder / "town.tif"), "town").extent()
        blocks = [layer.dataProvider().block(1, town, 1000, 1000) for layer in (parts, whole)]
        self.assertEqual(bytes(blocks[0].data()), bytes(blocks[1].data()))
        self.assertGreater(max(blocks[0].value(row, 500) for row in range(1000)), 5)


if __name__ == "__main__":
    unittest.main()
