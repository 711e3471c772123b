"""Arrays of every kind that holds elevations, and those that do not."""

import json
import tracemalloc
import types
import unittest
import warnings

import numpy

import dem2buildings
from python_case import PLACE, PythonCase, block, write_grid

# Outlines along the borders of all cells that are higher than 7 m.
METHOD = {"preset": "thesis", "trace": "cells", "fl": 7}
BLOCK = (391015, 5820015, 391035, 5820030)


def bounds(layer, i=0):
    ring = numpy.array(layer[i]["geometry"]["coordinates"][0][0])
    return (*ring.min(axis=0), *ring.max(axis=0))


def find(dem, **options):
    return dem2buildings.extract(dem, **{**PLACE, **METHOD, **options})


class Arrays(PythonCase):
    def assert_block(self, found, height=14):
        self.assertEqual(len(found.buildings), 1)
        self.assertEqual(bounds(found.buildings), BLOCK)
        self.assertEqual(found.buildings.columns["roof"].tolist(), [height])
        self.assertEqual(found.buildings.columns["n_cells"].tolist(), [300])

    def test_several_paths_are_one_raster(self):
        """Halves of a grid, in a list, a tuple and a folder."""
        whole = block()
        west, east = self.folder / "tiles" / "west.asc", self.folder / "tiles" / "east.asc"
        west.parent.mkdir()
        write_grid(west, whole[:, :25])
        write_grid(east, whole[:, 25:])
        x = PLACE["transform"][0]
        east.write_text(east.read_text().replace(f"xllcorner {x}", f"xllcorner {x + 25}"))
        for source in ([west, east], (str(east), bytes(west)), [str(west), east, west], west.parent):
            with self.subTest(source=source):
                found = dem2buildings.extract(source, **METHOD)
                self.assert_block(found)
        self.assertEqual(dem2buildings.extract([west, east], **METHOD).metadata["D2B_SOURCE"], f"{west} {east}")
        report = dem2buildings.extract_file([west, east], self.folder / "out.gpkg", **METHOD)
        self.assertEqual(report["input"]["name"], f"{west} and 1 other")
        with self.assertRaisesRegex(dem2buildings.OptionError, "is the source; give another name"):
            dem2buildings.extract_file([west, east], east, **METHOD)
        with self.assertRaisesRegex(dem2buildings.OptionError, "input_format= applies to one raster"):
            dem2buildings.extract([west, east], input_format="AAIGrid", **METHOD)
        with self.assertRaisesRegex(ValueError, "^The list of sources is empty; give at least one path.$"):
            dem2buildings.extract_file([], self.folder / "out.gpkg")
        for source in ([], [west, 1]):
            with self.assertRaisesRegex(TypeError, "dem must be a path or a NumPy array, not list"):
                dem2buildings.extract(source, **METHOD)

    def test_every_type(self):
        for dtype in ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64"):
            with self.subTest(dtype=dtype):
                self.assert_block(find(block(dtype)))

    def test_the_bytes_of_another_machine(self):
        for dtype in (">f4", ">f8", ">i2", ">u4"):
            with self.subTest(dtype=dtype):
                self.assert_block(find(block(dtype)))

    def test_types_without_elevations(self):
        for dtype in ("bool", "float16", "longdouble", "complex128", "datetime64[s]", "S3", "O"):
            with self.subTest(dtype=dtype), self.assertRaisesRegex(TypeError, "float32, float64 or integers"):
                find(numpy.zeros((5, 5), dtype))

    def test_what_is_no_array_of_two_dimensions(self):
        for dem in (numpy.zeros(5), numpy.zeros((2, 3, 4)), numpy.float64(3)):
            with self.subTest(dem=dem), self.assertRaisesRegex(ValueError, "two dimensions"):
                find(dem)
        for dem in ([[1, 2], [3, 4]], None, 3):
            with self.subTest(dem=dem), self.assertRaisesRegex(TypeError, "a path or a NumPy array"):
                dem2buildings.extract(dem)
        for shape in ((0, 5), (5, 0)):
            with self.subTest(shape=shape), self.assertRaisesRegex(dem2buildings.InputError, "no cells"):
                find(numpy.zeros(shape))

    def test_steps_of_any_size_and_sign(self):
        wide = numpy.zeros((80, 150), "float32")
        part = wide[::2, ::3]
        part[:] = block("float32")
        self.assert_block(find(part))
        self.assert_block(find(numpy.asfortranarray(block())))
        flipped = numpy.ascontiguousarray(block()[::-1, ::-1])
        self.assert_block(find(flipped[::-1, ::-1]))
        record = numpy.zeros((40, 50), [("flag", "u1"), ("z", "f8")])  # not aligned
        record["z"] = block()
        self.assert_block(find(record["z"]))

    def test_read_only(self):
        dem = block()
        dem.flags.writeable = False
        self.assert_block(find(dem))

    def test_nothing_is_copied(self):
        dem = numpy.zeros((2000, 2000), "float64")
        dem[10:25, 15:35] = 14
        for array in (dem, dem.T, numpy.ma.MaskedArray(dem, dem > 100)):
            tracemalloc.start()
            try:
                find(array, te=(391000, 5819940, 391100, 5820040))
                peak = tracemalloc.get_traced_memory()[1]
            finally:
                tracemalloc.stop()
            self.assertLess(peak, dem.nbytes / 20)

    def test_what_is_not_valid(self):
        hole = (slice(12, 20), slice(20, 30))
        masked = numpy.ma.MaskedArray(block("int16"), numpy.zeros((40, 50), bool))
        masked[hole] = numpy.ma.masked
        with_nan = block()
        with_nan[hole] = numpy.nan
        with_infinity = block("float32")
        with_infinity[hole] = -numpy.inf
        with_nodata = block("int32")
        with_nodata[hole] = -9999
        for dem, options in ((masked, {}), (with_nan, {}), (with_infinity, {}), (with_nodata, {"nodata": -9999})):
            with self.subTest(dtype=dem.dtype):
                found = find(dem, **options)
                self.assertEqual(found.report["input"]["valid_points"], 40 * 50 - 80)
                self.assertEqual(found.buildings.columns["n_points"].tolist(), [300 - 80])
        self.assertEqual(find(numpy.ma.MaskedArray(block())).report["input"]["valid_points"], 2000)

    def test_no_data_of_a_type_is_compared_as_the_type_has_it(self):
        dem = block("float32")
        dem[0, :] = -9999.9
        self.assertEqual(find(dem, nodata=-9999.9).report["input"]["valid_points"], 39 * 50)

    def test_terms_of_rasterio(self):
        affine = types.SimpleNamespace(to_gdal=lambda: PLACE["transform"])
        self.assert_block(find(block(), transform=affine))

    def test_transforms_that_are_none(self):
        for transform in ((1, 2, 3), range(7)):
            with self.assertRaisesRegex(TypeError, "six terms"):
                find(block(), transform=transform)
        for transform in ((0, 0, 0, 0, 0, 0), (0, 1, 2, 0, 1, 2), (0, float("nan"), 0, 0, 0, -1)):
            with self.assertRaisesRegex(dem2buildings.InputError, "no area"):
                find(block(), transform=transform)
        with self.assertRaisesRegex(TypeError, "a path has its own"):
            dem2buildings.extract("dem.tif", transform=PLACE["transform"])

    def test_without_a_place(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            found = dem2buildings.extract(block(), **METHOD)
        self.assertIsNone(found.crs)
        self.assertIsNone(found.buildings.crs)
        self.assertEqual(bounds(found.buildings), (15, -25, 35, -10))
        texts = [str(warning.message) for warning in caught]
        self.assertTrue(any("no georeferencing" in text for text in texts), texts)
        self.assertTrue(any(text.endswith("give it with crs=.") for text in texts), texts)
        self.assertEqual({warning.filename for warning in caught}, {__file__})
        self.assertEqual(len(found.report["warnings"]), len(texts))

    def test_parts(self):
        self.assert_block(find(block(), te=(391005, 5820005, 391045, 5820036)))
        self.assert_block(find(block(), srcwin=(5, 5, 40, 30)))
        self.assert_block(find(block(), projwin=(391005, 5820036, 391045, 5820005)))
        with self.assertRaisesRegex(dem2buildings.OptionError, "^srcwin= 0 0 51 40"):
            find(block(), srcwin=(0, 0, 51, 40))

    def test_a_cutline(self):
        half = [[391000, 5820000], [391025, 5820000], [391025, 5820040], [391000, 5820040], [391000, 5820000]]
        feature = {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [half]}}
        crs = {"type": "name", "properties": {"name": "EPSG:25833"}}
        path = self.folder / "half.geojson"
        path.write_text(json.dumps({"type": "FeatureCollection", "crs": crs, "features": [feature]}))
        found = find(block(), cutline=path)
        self.assertEqual(bounds(found.buildings), (391015, 5820015, 391025, 5820030))

    def test_options_of_files(self):
        for option in ({"b": 2}, {"oo": "A=B"}, {"input_format": "GTiff"}):
            name = next(iter(option))
            with self.assertRaisesRegex(dem2buildings.OptionError, f"^{name}= is for files"):
                find(block(), **option)


if __name__ == "__main__":
    unittest.main()
