"""Layers of PostGIS in the real QGIS: they come with the styles and words that those of a GeoPackage have."""

import unittest

from desk_case import DeskCase, QgsVectorLayer
from postgis_case import PostGisCase


class Shown(PostGisCase):
    def setUp(self):
        self.sql("DROP TABLE IF EXISTS layer_styles; DROP SCHEMA IF EXISTS plans CASCADE")

    def shown(self, table, schema="public"):
        layer = QgsVectorLayer(f"dbname='city' host={self.folder} user='planner' key='ogc_fid' "
                               f'table="{schema}"."{table}" (wkb_geometry)', table, "postgres")
        self.assertTrue(layer.isValid(), layer.error().message())
        return layer

    def write(self, *options, words="user=planner dbname=city"):
        self.assertEqual(self.end(self.start("-overwrite", *options, words=words)), (0, ""))

    def expect_the_look_of(self, shown, file):
        self.assertEqual(shown.renderer().dump(), file.renderer().dump())
        self.assertEqual(shown.renderer().type(), file.renderer().type())
        # Tiers have labels that are off, because those of buildings are enough.
        self.assertEqual([layer.labelsEnabled() for layer in (shown, file)], [shown.name() == "buildings"] * 2)
        self.assertEqual(shown.labeling().settings().fieldName, file.labeling().settings().fieldName)
        # The stack in 3D, and not the block that it stands in.
        self.assertEqual([layer.renderer3D() is not None for layer in (shown, file)],
                         [shown.name() == "contours"] * 2)

    def test_layers_look_as_those_of_a_geopackage(self):
        DeskCase.setUpClass()
        self.addClassCleanup(DeskCase.tearDownClass)
        path = DeskCase.make("town.gpkg")
        self.sql("CREATE SCHEMA plans")
        self.write()
        self.write(words="user=planner dbname=city active_schema=plans")
        for table in ("buildings", "contours"):
            file = QgsVectorLayer(f"{path}|layername={table}", table, "ogr")
            for schema in ("public", "plans"):
                self.expect_the_look_of(self.shown(table, schema), file)
        height = self.shown("buildings").fields().field("height")
        self.assertRegex(height.comment(), r"\(m\): ")

    def test_a_style_of_the_users_stays(self):
        self.write()
        layer = self.shown("buildings")
        layer.setLabelsEnabled(False)
        self.assertEqual(layer.saveStyleToDatabase("mine", "", True, ""), "")
        self.write("-lod", "2")
        self.assertFalse(self.shown("buildings").labelsEnabled())
        self.assertFalse(self.shown("contours").labelsEnabled())
        self.assertEqual(self.sql("SELECT stylename, useasdefault FROM layer_styles WHERE f_table_schema = 'public' "
                                  "AND f_table_name = 'buildings' AND stylename IN ('dem2buildings', 'mine') "
                                  "ORDER BY 1").split(), ["dem2buildings|f", "mine|t"])

    def test_who_may_make_no_table_of_styles_does_without(self):
        self.sql("CREATE SCHEMA own; CREATE ROLE tenant LOGIN; "
                 "GRANT USAGE, CREATE ON SCHEMA own TO tenant")
        self.write(words="user=tenant dbname=city active_schema=own")
        self.assertTrue(self.shown("buildings", "own").isValid())
        self.assertEqual(self.sql("SELECT to_regclass('public.layer_styles') IS NULL"), "t")


if __name__ == "__main__":
    unittest.main()
