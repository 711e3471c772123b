"""The package finds the buildings that the program writes, to the bit: geometries and fields."""

import unittest
import warnings

import dem2buildings
from python_case import SAMPLES, TRANSFORMS, PythonCase, sample


class SameAsProgram(PythonCase):
    def setUp(self):
        super().setUp()
        warnings.simplefilter("ignore")  # the program's go to stderr

    def test_every_sample_by_its_path(self):
        samples = sorted(SAMPLES.glob("*.tif"))
        self.assertGreaterEqual(len(samples), 7)
        for path in samples:
            for preset in ("buildings", "thesis"):
                with self.subTest(sample=path.name, preset=preset):
                    written = self.program(path, "-preset", preset, name=f"{path.stem}_{preset}.gpkg")
                    found = dem2buildings.extract(path, preset=preset)
                    self.assert_same_layer(found.buildings, written)
                    self.assert_same_layer(found.contours, written)

    def test_the_town_as_an_array(self):
        written = self.program(SAMPLES / "town.tif", "-lod", "6", "-split_height", "3")
        found = dem2buildings.extract(sample("town"), transform=TRANSFORMS["town"], crs="EPSG:25833", lod=6,
                                      split_height=3)
        self.assert_same_features(found, written)

    def test_feet_as_an_array(self):
        place = {"transform": gdal_transform("hotel_70x85"), "crs": "EPSG:26912", "zunit": "ft"}
        written = self.program(SAMPLES / "hotel_70x85.tif", "-fl", "15", "60", "100.5", "-preset", "thesis")
        found = dem2buildings.extract(sample("hotel_70x85"), fl=[15, 60, 100.5], preset="thesis", **place)
        self.assert_same_features(found, written)

    def test_no_data_as_an_array(self):
        place = {"transform": gdal_transform("nodata"), "crs": 25833}
        written = self.program(SAMPLES / "nodata.tif")
        found = dem2buildings.extract(sample("nodata"), nodata=-9999, **place)
        self.assert_same_features(found, written)

    def test_a_window_of_a_rotated_array(self):
        turned = gdal_transform("courtyard_utm")
        self.assertNotEqual(turned[0], 0)
        written = self.program(SAMPLES / "courtyard_utm.tif", "-srcwin", "5", "3", "140", "130", "-3d",
                               "-t_srs", "EPSG:4326")
        found = dem2buildings.extract(sample("courtyard_utm"), transform=turned, crs="EPSG:25832",
                                      srcwin=(5, 3, 140, 130), with_z=True, t_srs=4326)
        self.assert_same_features(found, written)

    def test_threads_change_nothing(self):
        one = dem2buildings.extract(SAMPLES / "town.tif", threads=1)
        four = dem2buildings.extract(SAMPLES / "town.tif", threads=4)
        self.assertEqual(one.contours.wkb.tolist(), four.contours.wkb.tolist())
        self.assertEqual(one.report["threads"], 1)


def gdal_transform(name):
    """The transform of a sample, from the tags of its GeoTIFF."""
    from PIL import Image
    tags = Image.open(SAMPLES / f"{name}.tif").tag_v2
    if 34264 in tags:  # ModelTransformation
        m = tags[34264]
        return (m[3], m[0], m[1], m[7], m[4], m[5])
    width, height, _ = tags[33550]  # ModelPixelScale
    _, _, _, x, y, _ = tags[33922]  # ModelTiepoint
    return (x, width, 0, y, 0, -height)


if __name__ == "__main__":
    unittest.main()
