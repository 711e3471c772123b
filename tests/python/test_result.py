"""The result of extract(): features, WKB, columns, the report; and how other packages take it."""

import json
import struct
import subprocess
import sys
import unittest
import unittest.mock

import numpy

import dem2buildings
from python_case import PLACE, SAMPLES, TOOL, PythonCase, block


def ring(courtyard=False):
    dem = block()
    if courtyard:
        dem[14:21, 20:30] = 0
    return dem


def find(dem, **options):
    return dem2buildings.extract(dem, **{**PLACE, "ground": "none", "regularize": "off", **options})


class Results(PythonCase):
    def test_layers(self):
        found = find(block())
        self.assertEqual([layer.name for layer in (found.buildings, found.contours)], ["buildings", "contours"])
        self.assertIsNone(found.doubtful)
        self.assertIsNone(found.rejected)
        self.assertEqual(repr(found), "<dem2buildings.Result: 1 buildings, 1 contours>")
        self.assertIsNone(found.roofs)
        more = find(block(), write_doubtful=True, write_rejected=True, layers="buildings")
        self.assertIsNone(more.contours)
        self.assertEqual((len(more.doubtful), len(more.rejected)), (0, 0))

    def test_a_frame_needs_geopandas(self):
        found = find(block())
        with unittest.mock.patch.dict(sys.modules, {"geopandas": None}):
            with self.assertRaisesRegex(ImportError, r"^to_geodataframe\(\) needs GeoPandas; install python3-geopandas"):
                found.to_geodataframe()

    def test_roofs(self):
        dem = block()
        dem[10:25, 15:35] = 14 - 0.5 * numpy.abs(numpy.arange(15) - 7)[:, None]  # a gable along the columns
        found = find(dem, roofs=True, layers="buildings")
        self.assertEqual(repr(found), "<dem2buildings.Result: 1 buildings, 2 roofs>")
        faces = found.roofs
        self.assertEqual(faces.name, "roofs")
        self.assertEqual(faces.columns["kind"].tolist(), ["pitched", "pitched"])
        self.assertEqual(faces.columns["bldg_id"].tolist(), [1, 1])
        numpy.testing.assert_allclose(faces.columns["slope"], numpy.degrees(numpy.arctan(0.5)), atol=0.5)
        self.assertEqual(sorted(round(azimuth) % 360 for azimuth in faces.columns["azimuth"]), [0, 180])
        for face, wkb in zip(faces, faces.wkb):
            self.assertEqual(struct.unpack_from("<BI", wkb)[1], 1006)
            ((outer,),) = face["geometry"]["coordinates"]
            z = [position[2] for position in outer]
            self.assertEqual((min(z), max(z)), (face["properties"]["z_low"], face["properties"]["z_high"]))
            self.assertAlmostEqual(max(z), 14, delta=0.1)
            # A geometry has the same positions as its WKB, which has 4 and 9 bytes of heads before them.
            numbers = struct.unpack_from(f"<{3 * len(outer)}d", wkb, len(wkb) - 24 * len(outer))
            self.assertEqual([tuple(numbers[i:i + 3]) for i in range(0, len(numbers), 3)], list(outer))
        self.assertEqual(found.report["roofs"]["pitched"], 2)
        self.assertEqual(found.buildings.columns["roof_type"].tolist(), ["gabled"])

    def test_crs_and_metadata(self):
        found = find(block(), lod=2)
        self.assertIn('ID["EPSG",25833]', found.crs)
        self.assertEqual(found.buildings.crs, found.crs)
        self.assertEqual(found.metadata["D2B_SOURCE"], "array")
        self.assertEqual(found.metadata["D2B_VERSION"], dem2buildings.__version__)
        self.assertIn('ID["EPSG",4326]', find(block(), t_srs="EPSG:4326").crs)

    def test_features(self):
        found = find(ring(courtyard=True), with_z=True, fl=[7], preset="thesis", trace="cells", ground=None)
        self.assertEqual(len(found.buildings), 1)
        self.assertEqual(found.buildings[0], found.buildings[-1])
        with self.assertRaises(IndexError):
            found.buildings[1]
        collection = found.contours.__geo_interface__
        self.assertEqual(collection["type"], "FeatureCollection")
        self.assertEqual(collection["features"], list(found.contours))
        feature = found.contours[1]
        self.assertEqual(feature["id"], feature["properties"]["id"])
        self.assertEqual(feature["geometry"]["type"], "MultiPolygon")
        ((outer, inner),) = feature["geometry"]["coordinates"]
        self.assertEqual(outer[0], outer[-1])
        self.assertEqual({position[2] for position in outer + inner}, {feature["properties"]["threshold"]})
        self.assertEqual(area(outer) + area(inner), 300 - 70)
        self.assertLess(area(inner), 0)
        json.dumps(collection, allow_nan=False)

    def test_wkb(self):
        found = find(block())
        (wkb,) = found.buildings.wkb
        self.assertEqual(found.buildings.wkb.dtype, object)
        order, kind, parts = struct.unpack_from("<BII", wkb)
        self.assertEqual((order, kind, parts), (1, 6, 1))
        (z,) = find(block(), with_z=True, layers="contours").contours.wkb
        self.assertEqual(struct.unpack_from("<BI", z)[1], 1006)

    def test_columns(self):
        found = find(block(), preset="thesis", fl=[7], ground=None)
        columns = found.contours.columns
        self.assertEqual(list(columns)[:3], ["id", "parent_id", "bldg_id"])
        self.assertEqual((columns["id"].dtype, columns["area_m2"].dtype, columns["status"].dtype),
                         (numpy.int64, numpy.float64, object))
        self.assertEqual(columns["level"].tolist(), [0, 1])
        # NULL: a root stands on nothing and belongs to no building.
        self.assertIsInstance(columns["parent_id"], numpy.ma.MaskedArray)
        self.assertEqual(columns["parent_id"].tolist(), [None, 1])
        self.assertTrue(numpy.isnan(columns["height"][0]))
        self.assertNotIsInstance(columns["level"], numpy.ma.MaskedArray)
        self.assertEqual(found.buildings.columns["doubt"].tolist(), [None])
        self.assertEqual(list(found.buildings.fields), list(found.buildings.columns))
        self.assertEqual(found.buildings.fields["height"]["unit"], "m")

    def test_columns_outlive_the_result(self):
        ids = find(block()).buildings.columns["id"]
        self.assertEqual(ids.tolist(), [1])
        with self.assertRaises(ValueError):
            ids[0] = 2

    def test_the_report_is_that_of_the_program(self):
        done = subprocess.run([TOOL, "-json", str(SAMPLES / "town.tif"), str(self.folder / "town.gpkg")], check=True,
                              capture_output=True, text=True)
        program = json.loads(done.stdout)
        own = dem2buildings.extract(SAMPLES / "town.tif").report
        self.assertEqual(list(own), list(program))
        for part in ("version", "input", "units", "levels", "dropped", "warnings"):
            self.assertEqual(own[part], program[part], part)
        self.assertEqual(own["output"]["buildings"], program["output"]["buildings"])

    def test_nothing_found(self):
        with self.assertWarnsRegex(UserWarning, "same elevation"):
            found = find(numpy.zeros((20, 20)))
        self.assertEqual(len(found.buildings), 0)
        self.assertEqual(found.buildings.wkb.tolist(), [])
        self.assertEqual(found.buildings.columns["id"].tolist(), [])


def area(closed):
    """Area of a ring, positive if it runs counter-clockwise."""
    x, y = numpy.array(closed)[:, :2].T
    return float(((x[:-1] - x[0]) * (y[1:] - y[0]) - (x[1:] - x[0]) * (y[:-1] - y[0])).sum() / 2)


if __name__ == "__main__":
    unittest.main()
