"""Results open finished: style, names of fields, CRS, extent and features arrive in QGIS as they were written."""

import shutil
import sqlite3
import unittest

from desk_case import DeskCase

BLOCKS = (391317, 5820317, 391557, 5820497)
PART = (391317, 5820407, 391397, 5820467)
CLASSES = ["below 3 m", "3 to 6 m", "6 to 10 m", "10 to 15 m", "15 to 20 m", "20 to 30 m", "30 to 50 m",
           "50 to 100 m", "100 m and more"]
TOLERANCE = 0.03


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

    def test_colours_are_classes_of_height_in_metres(self):
        for name in ("buildings", "contours"):
            layer = self.layer(self.town, name)
            renderer = layer.renderer()
            self.assertEqual(renderer.type(), "graduatedSymbol")
            self.assertEqual(renderer.classAttribute(), '"height"')
            self.assertEqual([one.label() for one in renderer.ranges()], CLASSES)
        layer = self.layer(self.town, "doubtful")
        self.assertEqual(layer.renderer().symbol().symbolLayer(0).properties()["style"], "b_diagonal")

    def test_contours_are_drawn_from_low_to_high(self):
        layer = self.layer(self.town, "contours")
        renderer = layer.renderer()
        self.assertTrue(renderer.orderByEnabled())
        clause = renderer.orderBy().list()[0]
        self.assertEqual((clause.expression().expression(), clause.ascending()), ('"level"', True))

    def test_labels_are_written_on_large_maps(self):
        for name, scale in (("buildings", 2500), ("contours", 1000), ("doubtful", 2500)):
            layer = self.layer(self.town, name)
            self.assertTrue(layer.labelsEnabled())
            settings = layer.labeling().settings()
            self.assertTrue(settings.scaleVisibility)
            self.assertEqual(settings.minimumScale, scale)

    def test_fields_have_names_with_units(self):
        layer = self.layer(self.town, "buildings")
        shown = {field.name(): layer.attributeDisplayName(i) for i, field in enumerate(layer.fields())}
        self.assertEqual(shown["height"], "Height (m)")
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
            self.assertNotEqual(layer.renderer().type(), "graduatedSymbol")
            self.assertFalse(layer.labelsEnabled())
            self.assertEqual(layer.attributeDisplayName(layer.fields().indexOf("height")), "height")
            drawn = self.render(layer, BLOCKS)
            self.assertGreater(self.difference(drawn, f"{name}.png"), 3 * TOLERANCE)

    def test_shapefiles_have_theirs_beside(self):
        folder = self.make("shapes", "-f", "ESRI Shapefile")
        for name in ("buildings", "contours"):
            layer = self.layer(folder / f"{name}.shp")
            self.assertEqual([one.label() for one in layer.renderer().ranges()], CLASSES)
            self.assertEqual(layer.attributeDisplayName(layer.fields().indexOf("height")), "Height (m)")
            self.assertLess(self.difference(self.render(layer, BLOCKS), f"{name}.png"), TOLERANCE)
            (folder / f"{name}.qml").unlink()
            bare = self.layer(folder / f"{name}.shp")
            self.assertEqual(bare.renderer().type(), "singleSymbol")

    def test_names_of_other_programs_are_styled_too(self):
        layer = self.layer(self.make("urock.gpkg", "-fields", "urock"), "buildings")
        self.assertEqual(layer.renderer().classAttribute(), '"ROOF_HEIGHT"')
        self.assertLess(self.difference(self.render(layer, BLOCKS), "buildings.png"), TOLERANCE)

    def test_a_users_style_stays_the_default(self):
        path = self.make("mine.gpkg")
        layer = self.layer(path, "buildings")
        layer.renderer().deleteAllClasses()
        self.assertEqual(layer.saveStyleToDatabase("mine", "", True, ""), "")
        self.make("mine.gpkg", "-overwrite", "-lod", "2")
        buildings, contours = self.layer(path, "buildings"), self.layer(path, "contours")
        self.assertEqual(buildings.renderer().ranges(), [])
        self.assertEqual([one.label() for one in contours.renderer().ranges()], CLASSES)


if __name__ == "__main__":
    unittest.main()
