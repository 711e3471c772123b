"""A line makes a GeoDataFrame of a layer."""

import pathlib
import tempfile
import unittest
import warnings

import dem2buildings
from python_case import PLACE, SAMPLES, PythonCase, block, write_grid

try:
    import geopandas
    import shapely
    import shapely.geometry
except ImportError:
    geopandas = shapely = None


@unittest.skipIf(geopandas is None, "GeoPandas is not installed")
class GeoPandas(PythonCase):
    def setUp(self):
        super().setUp()
        self.found = dem2buildings.extract(SAMPLES / "town.tif")

    def assert_is_the_layer(self, frame, layer):
        self.assertEqual(len(frame), len(layer))
        self.assertTrue(frame.geometry.is_valid.all())
        self.assertEqual(frame.crs.to_epsg(), 25833)
        self.assertEqual(frame["area_m2"].tolist(), layer.columns["area_m2"].tolist())
        # Areas of the fields are geodesic, which on this map differ by some 4 in 10,000.
        self.assertAlmostEqual(frame.geometry.area.sum() / frame["area_m2"].sum(), 1, delta=0.002)

    def test_a_frame_of_every_layer(self):
        found = self.found
        for layer in (found.buildings, found.contours):
            frame = geopandas.GeoDataFrame(layer.columns, geometry=geopandas.GeoSeries.from_wkb(layer.wkb), crs=found.crs)
            self.assert_is_the_layer(frame, layer)
            self.assertEqual(list(frame.columns), [*layer.columns, "geometry"])

    @unittest.skipUnless(hasattr(shapely, "from_wkb"), "Shapely has from_wkb from its version 2 on")
    def test_a_frame_by_shapely(self):
        found = self.found
        frame = geopandas.GeoDataFrame(found.buildings.columns, geometry=shapely.from_wkb(found.buildings.wkb),
                                       crs=found.crs)
        self.assert_is_the_layer(frame, found.buildings)

    def test_a_result_makes_a_frame(self):
        for name, layer in (("buildings", self.found.buildings), ("contours", self.found.contours)):
            frame = self.found.to_geodataframe(name)
            self.assert_is_the_layer(frame, layer)
            self.assertEqual(list(frame.columns), [*layer.columns, "geometry"])
        self.assertEqual(len(self.found.to_geodataframe()), len(self.found.buildings))
        with self.assertRaisesRegex(ValueError, r"^The result has no layer 'roofs'; it has buildings and contours\.$"):
            self.found.to_geodataframe("roofs")

    def test_gaps_of_columns(self):
        """A missing CRS stays missing, and so does a value that a feature lacks."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = dem2buildings.extract(block(), ground="none")
        frame = found.to_geodataframe()
        self.assertIsNone(frame.crs)
        self.assertEqual(frame.num_floors.tolist(), [5])
        (feature,) = found.buildings
        self.assertIn(None, feature["properties"].values())
        for name, value in feature["properties"].items():
            self.assertEqual(frame[name].isna().tolist(), [value is None], name)

    def test_features_are_taken_as_they_are(self):
        frame = geopandas.GeoDataFrame.from_features(self.found.buildings, crs=self.found.crs)
        self.assert_is_the_layer(frame, self.found.buildings)
        geometry = shapely.geometry.shape(self.found.buildings[0]["geometry"])
        self.assertEqual(geometry.wkb, frame.geometry.iloc[0].wkb)


@unittest.skipIf(geopandas is None, "GeoPandas is not installed")
class Footprints(PythonCase):
    """A block of 15 x 20 cells that is 14 m high, and footprints on it, beside it, and without a geometry."""

    def frame(self):
        box = shapely.geometry.box
        return geopandas.GeoDataFrame(
            {"name": ["on it", "beside it", "nowhere"], "Height": [1.5, 2.5, 3.5]}, index=[7, 3, 9],
            geometry=[box(391015, 5820015, 391035, 5820030), box(391100, 5820015, 391110, 5820030), None], crs=25833)

    def extract(self, **options):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return dem2buildings.extract(block(), ground="none", footprints=self.frame(), **PLACE, **options)

    def test_a_frame_gets_columns(self):
        found = self.extract()
        frame, given = found.footprints, self.frame()
        self.assertEqual(list(frame.index), [7, 3, 9])
        self.assertEqual(list(frame.name), list(given.name))
        self.assertEqual(list(frame.Height), list(given.Height))
        self.assertEqual(frame.geometry.iloc[0].wkb, given.geometry.iloc[0].wkb)
        self.assertEqual(frame.p50.iloc[0], 14)
        self.assertEqual(frame.d2b_height.iloc[0], 14)
        self.assertTrue(frame.p50.isna().iloc[1:].all())
        self.assertEqual(frame.num_floors.iloc[0], 5)
        self.assertEqual(list(frame.status), ["given"] * 3)
        self.assertEqual(found.report["footprints"]["outside"], 1)
        self.assertEqual(found.metadata["D2B_FOOTPRINTS"], "GeoDataFrame")

    def test_a_frame_of_the_result_is_that_of_the_footprints(self):
        found = self.extract()
        frame = found.to_geodataframe()
        self.assertTrue(frame.equals(found.footprints))
        frame["name"] = "changed"
        self.assertEqual(list(found.footprints.name), list(self.frame().name))

    def test_another_crs(self):
        frame = self.extract(t_srs="EPSG:4326").footprints
        self.assertEqual(frame.crs.to_epsg(), 4326)
        self.assertLess(frame.total_bounds[2], 180)

    def test_a_file_has_its_columns(self):
        with tempfile.TemporaryDirectory() as folder:
            source = write_grid(pathlib.Path(folder, "block.asc"), block())
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                dem2buildings.extract_file(source, pathlib.Path(folder, "out.gpkg"), ground="none",
                                           footprints=self.frame())
            frame = geopandas.read_file(pathlib.Path(folder, "out.gpkg"), layer="buildings")
        self.assertEqual(list(frame.name), ["on it", "beside it", "nowhere"])
        self.assertEqual(list(frame.Height), [1.5, 2.5, 3.5])
        self.assertEqual(frame.p50.iloc[0], 14)


if __name__ == "__main__":
    unittest.main()
