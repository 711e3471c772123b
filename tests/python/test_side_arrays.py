"""Arrays beside the DEM: ground, mask and vegetation index."""

import unittest

import numpy

import dem2buildings
from python_case import PLACE, PythonCase, write_grid
from test_arrays import bounds



def scene():
    """Two houses, 9 and 6 m high, each of 15 x 15 cells, and their ground at 100 m."""
    ground = numpy.full((50, 60), 100.0)
    dem = ground.copy()
    dem[10:25, 10:25] += 9
    dem[10:25, 35:50] += 6
    return dem, ground


class SideArrays(PythonCase):
    def write(self, name, array):
        return write_grid(self.folder / name, array)

    def test_ground(self):
        dem, ground = scene()
        found = dem2buildings.extract(dem, ground=ground, **PLACE)
        self.assertEqual(numpy.round(found.buildings.columns["height"], 6).tolist(), [9, 6])
        numpy.testing.assert_allclose(found.buildings.columns["area_m2"], 225, rtol=0.05)
        self.assertIn("-ground array", found.metadata["D2B_OPTIONS"])
        mound = ground.copy()
        mound[8:27, 8:27] += 1.5  # which a terrain model knows of, and nobody sees in the surface
        dem = numpy.maximum(dem, mound)
        found = dem2buildings.extract(dem, ground=mound, **PLACE)
        self.assertEqual(numpy.round(found.buildings.columns["height"], 6).tolist(), [7.5, 6])

    def test_the_same_as_files(self):
        dem, ground = scene()
        dem, ground = dem.astype("float32").astype("float64"), ground.astype("float32").astype("float64")
        mask = numpy.zeros(dem.shape)
        mask[:, 30:] = 1
        ndvi = numpy.full(dem.shape, -0.2)
        ndvi[:, 30:] = 0.75
        files = {"ground": self.write("ground.asc", ground), "mask": self.write("mask.asc", mask),
                 "ndvi": self.write("ndvi.asc", ndvi)}
        arrays = {"ground": ground, "mask": mask, "ndvi": ndvi}
        of_file = self.write("dem.asc", dem)
        for name in files:
            one = dem2buildings.extract(dem, **{name: arrays[name]}, **PLACE)
            for other in (dem2buildings.extract(of_file, **{name: files[name]}),
                          dem2buildings.extract(of_file, **{name: arrays[name]})):
                with self.subTest(name=name):
                    self.assertEqual(one.buildings.wkb.tolist(), other.buildings.wkb.tolist())
                    self.assertEqual(one.buildings.columns["height"].tolist(), other.buildings.columns["height"].tolist())

    def test_mask_of_every_kind(self):
        dem, ground = scene()
        inside = numpy.zeros(dem.shape, bool)
        inside[:, 30:] = True
        kinds = (inside, inside.astype("uint8"), inside * 3.5, numpy.ma.masked_array(numpy.ones(dem.shape), ~inside),
                 numpy.where(inside, 1, numpy.nan), inside[::-1][::-1], numpy.asfortranarray(inside))
        for mask in kinds:
            with self.subTest(dtype=mask.dtype):
                found = dem2buildings.extract(dem, ground=ground, mask=mask, **PLACE)
                self.assertEqual(numpy.round(found.buildings.columns["height"], 6).tolist(), [6])

    def test_a_window(self):
        dem, ground = scene()
        found = dem2buildings.extract(dem, ground=ground, srcwin=(30, 5, 25, 30), **PLACE)
        self.assertEqual(numpy.round(found.buildings.columns["height"], 6).tolist(), [6])
        self.assertEqual(bounds(found.buildings)[0] > 391030, True)

    def test_without_a_place(self):
        dem, ground = scene()
        with self.assertWarns(UserWarning):
            found = dem2buildings.extract(dem, ground=ground)
        self.assertEqual(len(found.buildings), 2)

    def test_elevations_are_in_the_unit_of_the_dem(self):
        dem, ground = scene()
        feet = {"transform": PLACE["transform"], "crs": "EPSG:25833+7837", "zunit": "ft"}
        found = dem2buildings.extract(dem / 0.3048, ground=ground / 0.3048, **feet)
        self.assertEqual(numpy.round(found.buildings.columns["height"], 4).tolist(), [9, 6])

    def test_to_a_file(self):
        dem, ground = scene()
        source = self.write("dem.asc", dem)
        report = dem2buildings.extract_file(source, self.folder / "a.gpkg", ground=ground)
        self.assertEqual(report["output"]["buildings"], 2)

    def test_another_shape(self):
        dem, ground = scene()
        for name in ("ground", "mask", "ndvi"):
            with self.subTest(name=name), self.assertRaises(ValueError) as caught:
                dem2buildings.extract(dem, **{name: ground[:49]}, **PLACE)
            self.assertEqual(str(caught.exception), f"{name}= has the shape (49, 60) and 'array' the shape (50, 60); give an "
                             "array with one value per cell of the DEM.")
        source = self.write("dem.asc", dem)
        with self.assertRaisesRegex(ValueError, r"shape \(60, 50\) and '.*dem.asc' the shape \(50, 60\)"):
            dem2buildings.extract(source, ground=ground.T)
        for name, wrong in (("mask", ground[0]), ("ground", numpy.array(5.0)), ("ndvi", numpy.stack([ground, ground]))):
            with self.subTest(name=name), self.assertRaises(ValueError) as caught:
                dem2buildings.extract(dem, **{name: wrong}, **PLACE)
            self.assertEqual(str(caught.exception), f"{name} has the shape {wrong.shape} and the DEM the shape (50, 60); give "
                             "an array of two dimensions, rows and columns")
        with self.assertRaisesRegex(ValueError, r"ground has the shape \(60,\); give an array of two dimensions"):
            dem2buildings.extract(source, ground=ground[0])
        with self.assertRaisesRegex(TypeError, "float32, float64 or integers"):
            dem2buildings.extract(dem, ground=ground.astype("complex128"), **PLACE)

    def test_a_mask_of_cells_has_no_layers(self):
        dem, _ = scene()
        with self.assertRaisesRegex(dem2buildings.OptionError, "leave out mask_layer="):
            dem2buildings.extract(dem, mask=dem > 0, mask_layer="a", **PLACE)

    def test_an_index_out_of_range(self):
        dem, _ = scene()
        with self.assertRaisesRegex(dem2buildings.InputError, "NDVI 'array' has the value"):
            dem2buildings.extract(dem, ndvi=dem, **PLACE)

    def test_nodata(self):
        dem, ground = scene()
        dem[10:25, 35:50] = -3
        found = dem2buildings.extract(dem, ground=ground, nodata=-3, **PLACE)
        self.assertEqual(len(found.buildings), 1)
        self.assertEqual(found.report["input"]["valid_points"], 50 * 60 - 225)
        with self.assertRaisesRegex(dem2buildings.OptionError, "^nodata="):
            dem2buildings.extract(dem, nodata="x", **PLACE)
        dem[dem == -3] = numpy.nan
        for nodata in (numpy.nan, numpy.float32("nan")):
            self.assertEqual(len(dem2buildings.extract(dem, nodata=nodata, **PLACE).buildings), 1)

    def test_advice_on_undeclared_nodata(self):
        dem, ground = scene()
        ground[:8] = 0
        advice = "treated as no data; set these cells to NaN, or keep the elevation with inodata="
        with self.assertWarnsRegex(UserWarning, advice):
            dem2buildings.extract(dem, ground=ground, **PLACE)


if __name__ == "__main__":
    unittest.main()
