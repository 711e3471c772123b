"""The 3D style arrives, and the solids that it makes stand on each other without a gap and without a face in
common: QGIS evaluates its own expressions for every part."""

import shutil
import sqlite3
import unittest

from qgis.core import (QgsExpression, QgsExpressionContext, QgsExpressionContextUtils, QgsReadWriteContext)
from qgis.PyQt.QtXml import QDomDocument

from desk_case import DeskCase


def rules_of(layer):
    """The rules as QGIS has read them: (filter, altitude, extrusion, clamping, colour)."""
    renderer = layer.renderer3D()
    if renderer is None:
        return None
    document = QDomDocument()
    element = document.createElement("renderer")
    renderer.writeXml(element, QgsReadWriteContext())
    rules = []
    found = element.elementsByTagName("rule")
    for i in range(found.count()):
        rule = found.at(i).toElement()
        options = rule.elementsByTagName("Option")
        expressions = {}
        for k in range(options.count()):
            option = options.at(k).toElement()
            if option.attribute("name") == "expression":
                expressions[option.parentNode().toElement().attribute("name")] = option.attribute("value")
        data = rule.elementsByTagName("data").at(0).toElement()
        material = rule.elementsByTagName("material").at(0).toElement()
        rules.append((rule.attribute("filter"), expressions["height"], expressions["extrusionHeight"],
                      data.attribute("alt-clamping"), material.attribute("diffuse")))
    return rules


def evaluate(text, layer, feature):
    context = QgsExpressionContext(QgsExpressionContextUtils.globalProjectLayerScopes(layer))
    context.setFeature(feature)
    expression = QgsExpression(text)
    value = expression.evaluate(context)
    assert not expression.hasEvalError(), expression.evalErrorString()
    return value


class Solids(DeskCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.town = cls.make("town.gpkg")

    def solids(self, layer):
        """id: (feature, bottom, top) of all features that some rule shows."""
        rules = rules_of(layer)
        self.assertIsNotNone(rules, "there is no 3D style")
        solids = {}
        for feature in layer.getFeatures():
            for accept, altitude, extrusion, clamping, _ in rules:
                self.assertEqual(clamping, "absolute")
                if evaluate(accept, layer, feature) == 1:
                    self.assertNotIn(feature["id"], solids, "two rules show one part")
                    bottom = evaluate(altitude, layer, feature)
                    solids[feature["id"]] = (feature, bottom, bottom + evaluate(extrusion, layer, feature))
        return solids

    def test_the_stack_stands_from_base_to_top(self):
        layer = self.layer(self.town, "contours")
        solids = self.solids(layer)
        self.assertEqual(len(solids), layer.featureCount())
        for feature, bottom, top in solids.values():
            self.assertAlmostEqual(bottom, feature["base"], places=6)
            self.assertAlmostEqual(top, feature["top"], places=6)
            below = feature["parent_id"]
            if below in solids:
                self.assertAlmostEqual(solids[below][2], bottom, places=6)
        self.assertGreater(len({rule[4] for rule in rules_of(layer)}), 5)

    def test_buildings_are_no_blocks_around_the_stack(self):
        self.assertIsNone(self.layer(self.town, "buildings").renderer3D())

    def test_buildings_alone_are_blocks(self):
        layer = self.layer(self.make("blocks.gpkg", "-layers", "buildings"), "buildings")
        solids = self.solids(layer)
        self.assertEqual(len(solids), layer.featureCount())
        for feature, bottom, top in solids.values():
            self.assertAlmostEqual(bottom, feature["ground"], places=4)
            self.assertAlmostEqual(top, feature["ground"] + feature["p90"], places=4)

    def test_bands_stand_on_the_ground(self):
        layer = self.layer(self.make("bands.gpkg", "-disjoint"), "contours")
        grounds = {one["id"]: one["ground"] for one in self.layer(self.folder / "bands.gpkg", "buildings").getFeatures()}
        for feature, bottom, top in self.solids(layer).values():
            self.assertAlmostEqual(bottom, grounds[feature["bldg_id"]], places=4)
            self.assertAlmostEqual(top, feature["top"], places=4)

    def test_the_z_of_vertices_does_not_lift_the_stack(self):
        # QGIS adds the altitude to the Z of a vertex.
        path = self.make("z.gpkg", "-3d")
        layer = self.layer(path, "contours")
        for feature, bottom, top in self.solids(layer).values():
            z = feature.geometry().vertexAt(0).z()
            self.assertGreater(z, 200)
            self.assertAlmostEqual(bottom + z, feature["base"], places=4)
            self.assertAlmostEqual(top + z, feature["top"], places=4)

    def test_feet_become_units_of_the_map(self):
        # Elevations in feet on a map in metres; the root, every valid point, is no solid.
        path = self.make("hotel.gpkg", "-preset", "thesis", sample="hotel_70x85.tif")
        layer = self.layer(path, "contours")
        solids = self.solids(layer)
        self.assertEqual(len(solids), layer.featureCount() - 1)
        for feature, bottom, top in solids.values():
            self.assertAlmostEqual(bottom, feature["base"] * 0.3048, places=4)
            self.assertAlmostEqual(top, feature["top"] * 0.3048, places=4)

    def test_without_the_style_row_there_are_none(self):
        copy = self.folder / "bare.gpkg"
        shutil.copy(self.town, copy)
        with sqlite3.connect(copy) as file:
            file.execute("DELETE FROM layer_styles")
        self.assertIsNone(rules_of(self.layer(copy, "contours")))


if __name__ == "__main__":
    unittest.main()
