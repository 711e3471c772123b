"""A line makes a GeoDataFrame of a layer."""

import unittest

import dem2buildings
from python_case import SAMPLES, PythonCase

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

    def test_features_are_taken_as_they_are(self):
        frame = geopandas.GeoDataFrame.from_features(self.found.buildings, crs=self.found.crs)
        self.assert_is_the_layer(frame, self.found.buildings)
        geometry = shapely.geometry.shape(self.found.buildings[0]["geometry"])
        self.assertEqual(geometry.wkb, frame.geometry.iloc[0].wkb)


if __name__ == "__main__":
    unittest.main()
