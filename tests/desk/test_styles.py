"""Results open finished: style, names of fields, CRS, extent and features arrive in QGIS as they were written."""

import shutil
import sqlite3
import subprocess
import unittest

from qgis.core import NULL, QgsExpression, QgsExpressionContext, QgsFeature, QgsNullSymbolRenderer, QgsRenderContext
from qgis.PyQt.QtGui import QColor
from qgis.PyQt.QtXml import QDomDocument

from desk_case import DeskCase

BLOCKS = (391317, 5820317, 391557, 5820497)
PART = (391317, 5820407, 391397, 5820467)
CLASSES = ["below 3 m", "3 to 6 m", "6 to 10 m", "10 to 15 m", "15 to 20 m", "20 to 30 m", "30 to 50 m",
           "50 to 100 m", "100 m and more"]
LESS_CERTAIN = "paler: less certain"
TOLERANCE = 0.03


def legend(layer):
    """The heading and the classes of a layer, as its legend has them."""
    heading, = layer.renderer().rootRule().children()
    return heading.label(), [rule.label() for rule in heading.children()]


class Styles(DeskCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.town = cls.make("town.gpkg", "-write_doubtful")

    def query(self, statement, path=None):
        with sqlite3.connect(path or self.town) as file:
            return file.execute(statement).fetchall()

    def without_styles(self):
        copy = self.folder / "bare.gpkg"
        shutil.copy(self.town, copy)
        with sqlite3.connect(copy) as file:
            file.execute("DELETE FROM layer_styles")
            # From version 3.32 on QGIS also reads the names of fields here.
            file.execute("DELETE FROM gpkg_data_columns")
        return copy

    def test_layers_arrive_whole(self):
        for name in ("buildings", "contours"):
            layer = self.layer(self.town, name)
            self.assertEqual(layer.crs().authid(), "EPSG:25833")
            self.assertEqual(layer.featureCount(), self.query(f"SELECT count(*) FROM {name}")[0][0])
            box = self.query(f"SELECT min_x, min_y, max_x, max_y FROM gpkg_contents WHERE table_name='{name}'")[0]
            for got, written in zip((layer.extent().xMinimum(), layer.extent().yMinimum(),
                                     layer.extent().xMaximum(), layer.extent().yMaximum()), box):
                self.assertAlmostEqual(got, written, places=6)
            self.assertGreater(layer.extent().width(), 500)

    def test_the_file_is_a_valid_geopackage(self):
        """Checks with GDAL's own checker, which knows the specification, tables of metadata and fields included."""
        checked = subprocess.run(["/usr/bin/python3", "-m", "osgeo_utils.samples.validate_gpkg", str(self.town)],
                                 capture_output=True, text=True)
        self.assertEqual((checked.returncode, checked.stdout), (0, ""), checked.stderr)

    def test_colours_are_classes_of_height_in_metres(self):
        for name, field, heading in (("buildings", "p90", 
                                      "Height above ground, 90th percentile, m; label 12–25 m: median to 90th percentile"),
                                     ("contours", "height", "Height of the part above ground, m")):
            layer = self.layer(self.town, name)
            self.assertEqual(layer.renderer().type(), "RuleRenderer")
            self.assertEqual(legend(layer), (heading, [*CLASSES, LESS_CERTAIN]))
            self.assertEqual(layer.renderer().usedAttributes(QgsRenderContext()) - {"level"}, {field, "confidence"})
        layer = self.layer(self.town, "doubtful")
        self.assertEqual(layer.renderer().symbol().symbolLayer(1).layerType(), "LinePatternFill")

    def test_what_is_not_certain_is_paler(self):
        """The same building, drawn as it is, and as if it were hardly one."""
        layer = self.layer(self.make("pale.gpkg"), "buildings")
        place = layer.fields().indexOf("confidence")
        highest = max((one for one in layer.getFeatures() if one["confidence"] > 0.95), key=lambda one: one["p90"])
        middle = highest.geometry().pointOnSurface().asPoint()
        box = (middle.x() - 1, middle.y() - 1, middle.x() + 1, middle.y() + 1)
        layer.setLabelsEnabled(False)
        shades = []
        for confidence in (0.9, 0.89, 0.5):
            layer.startEditing()
            layer.changeAttributeValue(highest.id(), place, confidence)
            shades.append(QColor(self.render(layer, box, (8, 8)).pixel(4, 4)).saturation())
            layer.rollBack()
        self.assertEqual(sorted(shades, reverse=True), shades)
        self.assertGreater(shades[0] - shades[1], 40)
        self.assertGreater(shades[1] - shades[2], 40)

    def test_a_label_agrees_with_its_class(self):
        layer = self.layer(self.town, "buildings")
        expression = QgsExpression(layer.labeling().settings().fieldName)
        feature = QgsFeature(layer.fields())
        for height, text in ((12.3, "12 m"), (9.4, "9.4 m"), (9, "9.0 m"), (9.98, "9.9 m"), (10, "10 m"), (2.97, "2.9 m"),
                             (29.5, "29 m"), (30.4, "30 m"), (99.99, "99 m"), (100.4, "100 m"), (16.5, "17 m")):
            feature["p90"] = height
            context = QgsExpressionContext()
            context.setFeature(feature)
            context.setFields(layer.fields())
            self.assertEqual(expression.evaluate(context), text)

    def test_a_block_with_several_roofs_is_labelled_by_a_range(self):
        layer = self.layer(self.town, "buildings")
        expression = QgsExpression(layer.labeling().settings().fieldName)
        feature = QgsFeature(layer.fields())
        for median, height, text in ((12.4, 25.2, "12–25 m"), (20, 25, "25 m"), (18.9, 25, "19–25 m"), (2, 8.3, "2.0–8.3 m"),
                                     (NULL, 25, "25 m")):
            feature["p50"], feature["p90"] = median, height
            context = QgsExpressionContext()
            context.setFeature(feature)
            context.setFields(layer.fields())
            self.assertEqual(expression.evaluate(context), text)

    def test_contours_alone_are_labelled(self):
        self.assertTrue(self.layer(self.make("alone.gpkg", "-layers", "contours"), "contours").labelsEnabled())

    def test_quantiles_are_a_style_that_can_be_chosen(self):
        layer = self.layer(self.town, "buildings")
        count, ids, names, _, error = layer.listStylesInDatabase()
        self.assertIn("dem2buildings quantiles", names)
        style, error = layer.getStyleFromDatabase(ids[names.index("dem2buildings quantiles")])
        self.assertEqual(error, "")
        document = QDomDocument()
        document.setContent(style)
        self.assertTrue(layer.importNamedStyle(document)[0])
        heading, labels = legend(layer)
        self.assertEqual(len(labels), 6)
        rules, = layer.renderer().rootRule().children()
        counts = []
        for rule in rules.children()[:5]:
            counts.append(sum(1 for _ in layer.getFeatures(rule.filterExpression())))
        self.assertEqual(sum(counts), layer.featureCount())
        self.assertLess(max(counts) - min(counts), 0.1 * layer.featureCount())

    def test_doubt_is_seen_without_colours(self):
        """A doubtful object in grey has lines as dark as a building's, over a fill as light as paper."""
        sure = self.make("grey.gpkg", "-write_doubtful", "-min_confidence", "0.97")
        doubtful = self.layer(sure, "doubtful")
        doubtful.setLabelsEnabled(False)

        def filled(feature):
            box = feature.geometry().boundingBox()
            return feature["area_m2"] / box.width() / box.height()

        box = max(doubtful.getFeatures(), key=filled).geometry().boundingBox()
        grey = self.render(doubtful, (box.xMinimum(), box.yMinimum(), box.xMaximum(), box.yMaximum()), (200, 200))
        inside = [QColor(grey.pixel(x, y)).lightness() for x in range(200) for y in range(200)]
        dark = sum(1 for value in inside if value < 130) / len(inside)
        light = sum(1 for value in inside if value > 215) / len(inside)
        self.assertGreater(dark, 0.08)
        self.assertGreater(light, 0.2)  # hatching and its soft edges cover most

    def test_contours_are_drawn_from_low_to_high(self):
        layer = self.layer(self.town, "contours")
        renderer = layer.renderer()
        self.assertTrue(renderer.orderByEnabled())
        clause = renderer.orderBy().list()[0]
        self.assertEqual((clause.expression().expression(), clause.ascending()), ('"level"', True))

    def test_labels_are_written_on_large_maps(self):
        """Labels one layer at a time: those of the parts are there, and off."""
        for name, scale in (("buildings", 2500), ("contours", 1000), ("doubtful", 2500)):
            layer = self.layer(self.town, name)
            self.assertEqual(layer.labelsEnabled(), name != "contours")
            settings = layer.labeling().settings()
            self.assertTrue(settings.scaleVisibility)
            self.assertEqual(settings.minimumScale, scale)

    def test_parts_are_labelled_that_nothing_stands_on(self):
        layer = self.layer(self.town, "contours")
        expression = QgsExpression(layer.labeling().settings().fieldName)
        below = {feature["parent_id"] for feature in layer.getFeatures()}
        context = QgsExpressionContext()
        for feature in layer.getFeatures():
            context.setFeature(feature)
            text = expression.evaluate(context)
            self.assertEqual(text is None or text == NULL, feature["id"] in below, feature["id"])

    def test_fields_have_names_with_units(self):
        layer = self.layer(self.town, "buildings")
        shown = {field.name(): layer.attributeDisplayName(i) for i, field in enumerate(layer.fields())}
        self.assertEqual(shown["height"], "Highest point (m)")
        self.assertEqual(shown["roof"], "Roof (metre)")
        self.assertEqual(shown["area_m2"], "Area (m2)")
        nameless = [name for name, alias in shown.items() if alias == name and name != "fid"]
        self.assertEqual(nameless, [])

    def test_title_abstract_and_lineage(self):
        metadata = self.layer(self.town, "contours").metadata()
        self.assertEqual(metadata.title(), "Contours")
        self.assertIn("height [m]: top of this part above the ground of its building", metadata.abstract())
        self.assertIn("vertical unit: metre", metadata.history())
        self.assertTrue(any(entry.startswith("version: ") for entry in metadata.history()))
        self.assertTrue(any(entry.startswith("source: ") for entry in metadata.history()))

    def test_pictures(self):
        for name, box in (("buildings", BLOCKS), ("contours", BLOCKS), ("contours", PART)):
            picture = f"{name}{'_part' if box is PART else ''}.png"
            with self.subTest(picture):
                drawn = self.render(self.layer(self.town, name), box)
                self.assertLess(self.difference(drawn, picture), TOLERANCE)

    def test_without_the_style_row_all_this_is_gone(self):
        bare = self.without_styles()
        for name in ("buildings", "contours"):
            layer = self.layer(bare, name)
            self.assertNotEqual(layer.renderer().type(), "RuleRenderer")
            self.assertFalse(layer.labelsEnabled())
            self.assertEqual(layer.attributeDisplayName(layer.fields().indexOf("height")), "height")
            drawn = self.render(layer, BLOCKS)
            self.assertGreater(self.difference(drawn, f"{name}.png"), 3 * TOLERANCE)

    def test_shapefiles_have_theirs_beside(self):
        folder = self.make("shapes", "-f", "ESRI Shapefile")
        for name, alias in (("buildings", "Highest point (m)"), ("contours", "Height (m)")):
            layer = self.layer(folder / f"{name}.shp")
            self.assertEqual(legend(layer)[1], [*CLASSES, LESS_CERTAIN])
            self.assertEqual(layer.attributeDisplayName(layer.fields().indexOf("height")), alias)
            self.assertLess(self.difference(self.render(layer, BLOCKS), f"{name}.png"), TOLERANCE)
            (folder / f"{name}.qml").unlink()
            bare = self.layer(folder / f"{name}.shp")
            self.assertEqual(bare.renderer().type(), "singleSymbol")

    def test_names_of_other_programs_are_styled_too(self):
        layer = self.layer(self.make("urock.gpkg", "-fields", "urock"), "buildings")
        self.assertIn("ROOF_HEIGHT", layer.renderer().usedAttributes(QgsRenderContext()))
        self.assertLess(self.difference(self.render(layer, BLOCKS), "buildings.png"), TOLERANCE)

    def test_a_users_style_stays_the_default(self):
        path = self.make("mine.gpkg")
        layer = self.layer(path, "buildings")
        layer.setRenderer(QgsNullSymbolRenderer())
        self.assertEqual(layer.saveStyleToDatabase("mine", "", True, ""), "")
        self.make("mine.gpkg", "-overwrite", "-lod", "2")
        buildings, contours = self.layer(path, "buildings"), self.layer(path, "contours")
        self.assertEqual(buildings.renderer().type(), "nullSymbol")
        self.assertEqual(contours.renderer().type(), "RuleRenderer")


if __name__ == "__main__":
    unittest.main()
