"""Parts of run.py and changes.py against values worked out by hand, and the commands on a scene or two."""
import os
import subprocess
import tempfile
import unittest

try:
    import matplotlib  # noqa: F401
    import numpy as np
    import scipy.spatial  # noqa: F401
    from osgeo import gdal, ogr
except ImportError as error:
    raise SystemExit(f"a package is missing: {error}") from error

import changes
import confidence
import failures
import learning
import pooled
import tables
import thinning
import walls
from places import Place

HERE = os.path.dirname(os.path.abspath(__file__))


def box(x0, y0, x1, y1, hole=None):
    text = f"({x0} {y0}, {x1} {y0}, {x1} {y1}, {x0} {y1}, {x0} {y0})"
    if hole:
        a, b, c, d = hole
        text += f", ({a} {b}, {c} {b}, {c} {d}, {a} {d}, {a} {b})"
    return ogr.CreateGeometryFromWkt(f"POLYGON ({text})")


class Walls(unittest.TestCase):
    def test_outline_that_is_wider_lies_outside(self):
        d = walls.signed_distances([box(-0.1, -0.1, 10.1, 10.1)], [box(0, 0, 10, 10)], 0.5)
        self.assertAlmostEqual(d.mean(), 0.2, delta=0.002)  # a tenth of a metre is a fifth of the cell
        self.assertTrue((d > 0).all())

    def test_outline_that_is_narrower_lies_inside(self):
        d = walls.signed_distances([box(0.1, 0.1, 9.9, 9.9)], [box(0, 0, 10, 10)], 1)
        self.assertAlmostEqual(d.mean(), -0.1, delta=0.002)

    def test_courtyard_that_is_smaller_lies_outside(self):
        true = [box(0, 0, 100, 100, (40, 40, 60, 60))]
        d = walls.signed_distances([box(0, 0, 100, 100, (41, 41, 59, 59))], true, 1)
        # 72 m of 472 lie 1 m inside of the courtyard, which is outside of the building.
        self.assertAlmostEqual(d.mean(), 72 / 472, delta=0.005)

    def test_displaced_outline_lies_to_both_sides(self):
        d = walls.signed_distances([box(0.2, 0, 10.2, 10)], [box(0, 0, 10, 10)], 1)
        self.assertAlmostEqual(d.mean(), 0, delta=0.01)
        self.assertAlmostEqual(np.abs(d).mean(), 0.1, delta=0.01)  # two of four sides, by 0.2

    def test_what_is_far_is_not_counted(self):
        self.assertEqual(len(walls.signed_distances([box(50, 50, 60, 60)], [box(0, 0, 10, 10)], 1)), 0)


class Coarse(unittest.TestCase):
    def test_the_table_has_a_row_a_scan_with_the_means_of_its_places(self):
        def place(name, iou):
            return {"name": name, "cell": (2, 2), "iou": iou, "iou_ground": None, "object_completeness": 1.0,
                    "object_correctness": 0.5, "outline_rms_m": None}

        lines = tables.coarse_table([place("Here, thin", 0.5), place("There, thin", 0.75), place("Here, coarse", 0.25)])
        self.assertEqual(lines[2:], ["| thin | 2 m | 0.625 | - | 1.000 | 0.500 | - |",
                                     "| coarse | 2 m | 0.250 | - | 1.000 | 0.500 | - |"])


class Pooled(unittest.TestCase):
    def place(self, folder, cell, found, right, iou=0.5, rms=1.0, objects=((0.9, 1),)):
        return {"name": folder.capitalize(), "place": folder, "cell": (2 * cell, cell), "iou": iou, "outline_rms_m": rms,
                "reference": dict(zip(("objects_covered", "objects"), found)),
                "found": dict(zip(("objects_covered", "objects"), right)), "objects": np.array(objects, float)}

    def test_places_of_like_cells_and_points_are_counted_together(self):
        lines = pooled.pooled_table([
            self.place("bilbao", 2.502, (600, 1000), (0, 0), 0.71, None),
            self.place("seville", 1, (4, 6), (3, 3), 0.904, 0.96),
            self.place("dallas", 0.5, (1, 1), (1, 2), 0.8, 0.54),
            self.place("delft", 0.5, (2, 2), (1, 2), 0.856, 1.22),
            self.place("adelaide_fusa_1m", 1, (50, 50), (50, 50)),  # repeats a scan
            self.place("elsewhere", 2.5, (500, 1000), (1, 1), 0.6, 2)])
        self.assertEqual(lines[2:], [
            "| 0.5 to 1 m (two places) | two and more | 6 of 8 (75 %) | 4 of 5 (80 %) | 86 to 90 % | 1.0 to 1.2 m |",
            "| 0.5 m (Dallas) | one to two | 1 of 1 (100 %) | 1 of 2 (50 %) | 80 % | 0.5 m |",
            "| 2.5 m (Bilbao) | unknown, heights in whole metres | 600 of 1,000 (60 %) | - | 71 % | - |",
            "| 2.5 m (Elsewhere) | unknown | 500 of 1,000 (50 %) | 1 of 1 (100 %) | 60 % | 2.0 m |",
            "| **all** (five places) |  | **1,107 of 2,009 (55 %)** | **6 of 8 (75 %)** | **60 to 90 %** | **0.5 to 2.0 m** |"])

    def test_objects_of_like_confidence_are_counted_together(self):
        lines = pooled.pooled_confidence_table([
            self.place("delft", 1, (1, 1), (1, 1), objects=[(0.95, 1), (0.81, 0), (0.3, 0)]),
            self.place("adelaide_fusa_1m", 1, (1, 1), (1, 1), objects=[(0.9, 0)]),
            self.place("dallas", 1, (1, 1), (1, 1), objects=[(0.85, 1)] + [(0.1, 0)] * 999 + [(0.1, 1)])])
        self.assertEqual(lines[2:], ["| 0.0 to 0.2 | 0 % of 1,000 |", "| 0.2 to 0.4 | 0 % of 1 |", "| 0.4 to 0.6 | - |",
                                     "| 0.6 to 0.8 | - |", "| 0.8 to 1.0 | 67 % of 3 |"])

    def test_each_place_is_in_one_row(self):
        folders = [folder for row in pooled.POINTS.values() for folder in row] + list(pooled.REPEATED)
        self.assertEqual(len(folders), len(set(folders)))


class Confidence(unittest.TestCase):
    def test_shares_are_those_of_their_bins(self):
        bins = list(confidence.by_bin(np.array([[0.1, 0], [0.9, 1], [0.85, 0], [1.0, 1], [0.95, 1]])))
        self.assertEqual([row[0] for row in bins], [1, 0, 0, 0, 4])
        self.assertEqual(bins[4][2], 0.75)
        self.assertIsNone(bins[1][2])

    def test_area_that_is_shared(self):
        blocks = [(block, block.GetEnvelope()) for block in (box(0, 0, 10, 10), box(20, 0, 30, 10))]
        self.assertAlmostEqual(confidence.shared_area(box(5, 5, 25, 15), blocks), 50)
        self.assertEqual(confidence.shared_area(box(10, 0, 20, 10), blocks), 0)


class Learning(unittest.TestCase):
    def test_weights_that_made_the_chances_are_found(self):
        rng = np.random.default_rng(1)
        features = np.column_stack([rng.normal(size=(4000, 4)), np.ones(4000)])
        weights = np.array([2, -1, 0.5, 0, 0.7])
        chances = learning.chances(features, weights)
        found = learning.fit([(features[:1000], chances[:1000], None), (features[1000:], chances[1000:], None)])
        np.testing.assert_allclose(found, weights, atol=0.03)  # the ridge makes them a little smaller

    def test_loss_is_that_of_a_coin(self):
        self.assertAlmostEqual(learning.loss(np.array([0, 1]), np.array([0.5, 0.5])), np.log(2))
        self.assertAlmostEqual(learning.loss(np.array([1, 1]), np.array([0.5, 0.25])), 1.5 * np.log(2))
        self.assertEqual(learning.agreed(np.array([0, 1, 1]), np.array([0.4, 0.5, 0.1])), 2 / 3)


class Thinning(unittest.TestCase):
    def test_a_cell_has_its_highest_pulse_or_that_of_a_near_cell(self):
        rows, cols = np.array([0.5, 0.1, 0.9]), np.array([0.5, 0.2, 5.5])
        z = thinning.highest(rows, cols, np.array([3.0, 7.0, 4.0]), (1, 7))
        np.testing.assert_array_equal(z, [[7, 7, np.nan, np.nan, 4, 4, 4]])

    def test_so_many_pulses_a_cell(self):
        random = np.random.default_rng(1)
        rows, cols, heights = thinning.pulses(np.where(np.arange(40000) % 2, np.nan, 10.0).reshape(200, 200), 0.5, random)
        self.assertAlmostEqual(len(heights) / 10000, 1, delta=0.05)  # half fall on unknown cells
        self.assertTrue(((cols.astype(int) % 2) == 0).all())
        self.assertAlmostEqual(heights.mean(), 10, delta=0.002)


class Failures(unittest.TestCase):
    def test_the_window_is_where_most_is_wrong(self):
        wrong = np.zeros((20, 30), bool)
        wrong[2, 3] = True
        wrong[12:15, 20:22] = True
        row, col = failures.worst_window(wrong, 3, 2)
        self.assertEqual((row, col), (12, 20))
        self.assertEqual(tuple(failures.worst_window(wrong, 20, 30)), (0, 0))

    def test_what_is_missed_and_what_is_false_have_colours(self):
        with tempfile.TemporaryDirectory() as folder:
            place = Place("made", "Made", folder)
            raster = gdal.GetDriverByName("GTiff").Create(place.dsm, 12, 10, 1, gdal.GDT_Float32)
            raster.SetGeoTransform((0, 1, 0, 10, 0, -1))
            raster.SetProjection("EPSG:32631")
            raster.FlushCache()
            out = os.path.join(folder, "out.gpkg")
            for path, square in ((place.reference, box(1, 1, 5, 5)), (out, box(3, 1, 9, 5))):
                dataset = ogr.GetDriverByName("GPKG").CreateDataSource(path)
                layer = dataset.CreateLayer("buildings")
                feature = ogr.Feature(layer.GetLayerDefn())
                feature.SetGeometry(square)
                layer.CreateFeature(feature)
                del feature, layer, dataset  # which writes them
            colours, share = failures.picture_of(place, out)
            self.assertEqual(colours.shape, (20, 24, 3))
            self.assertEqual(share, 1)
            # The border of a part has the full colour; row 17 of half cells is the lowest of both squares.
            for col, colour in ((2, failures.MISSED), (6, failures.SHARED), (17, failures.FALSE)):
                np.testing.assert_array_equal(colours[17, col], colour)
            self.assertEqual(len(set(colours[0, 0])), 1)  # grey


class Tables(unittest.TestCase):
    def test_only_what_stands_between_the_lines_is_replaced(self):
        with tempfile.NamedTemporaryFile("w+", suffix=".md", encoding="utf-8") as page:
            page.write("before\n<!-- table a -->\nold\n<!-- end -->\nafter\n<!-- table b -->\nkept\n<!-- end -->\n")
            page.flush()
            tables.put_into(page.name, {"a": ["| 1 |"]})
            with open(page.name, encoding="utf-8") as written:
                self.assertEqual(written.read(), "before\n<!-- table a -->\n\n| 1 |\n\n<!-- end -->\nafter\n"
                                                 "<!-- table b -->\nkept\n<!-- end -->\n")


class Changes(unittest.TestCase):
    def test_a_change_is_right_where_it_shares_half_of_the_smaller(self):
        truth = [("new", box(0, 0, 10, 10)), ("gone", box(50, 0, 60, 10)), ("same", box(90, 0, 99, 9))]
        found = [("new", box(5, 0, 15, 10)), ("new", box(6, 0, 16, 10)), ("gone", box(0, 0, 10, 10)),
                 ("same", box(50, 0, 60, 10))]
        counts = changes.count(found, truth)
        self.assertEqual(dict(counts["new"]), {"true": 1, "found": 1, "reported": 2, "right": 1})
        self.assertEqual(dict(counts["gone"]), {"true": 1, "found": 0, "reported": 1, "right": 0})
        self.assertEqual(list(changes.rows("here", counts))[0], "| here | new | 1 | 2 | 0.500 | 1.000 |")

    def test_polygons_are_displaced(self):
        moved = changes.displaced(box(0, 0, 1, 1), 2, -3)
        self.assertEqual(moved.GetEnvelope(), (2, 3, -3, -2))

    def run_it(self, *words):
        return subprocess.run([os.path.join(HERE, "changes.py"), "--build", os.environ["D2B_BUILD"], *words],
                              capture_output=True, text=True, check=False)

    def test_measures_rasters_and_results(self):
        for words in ((), ("--results",)):
            done = self.run_it("--seed", "1", "--least", "0.95", *words, "estate_lidar2+lidar2@1.6,-0.9")
            self.assertEqual(done.returncode, 0, done.stderr)
            for kind, count in (("new", 14), ("gone", 8), ("raised", 9), ("lowered", 10)):
                self.assertIn(f"| all | {kind} | {count} | {count} | 1.000 | 1.000 |", done.stdout)
            self.assertIn("town against itself: all same", done.stdout)

    def test_fails_below_the_bound(self):
        done = self.run_it("--seed", "1", "--least", "1.1", "rows_lidar2+lidar2@0,0")
        self.assertEqual(done.returncode, 1)
        self.assertIn("The lowest precision or recall is 1.000, not 1.1 or more.", done.stderr)

    def test_says_what_is_missing(self):
        for words, message in ((("moon",), "moon is no pair; give <place>_<survey>+<later survey>@<east>,<north>."),
                               (("moon_lidar2+lidar2@0,0",), "There is no scene moon_lidar2; "),
                               (("--build", "/no/such"), "There is no /no/such/sample_dems/d2b_make_scenes; build ")):
            done = self.run_it(*words)
            self.assertEqual(done.returncode, 1)
            self.assertIn(message, done.stderr)
            self.assertNotIn("Traceback", done.stderr)


class Command(unittest.TestCase):
    def run_it(self, *words):
        return subprocess.run([os.path.join(HERE, "run.py"), "--build", os.environ["D2B_BUILD"], *words],
                              capture_output=True, text=True, check=False)

    def test_measures_a_scene(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = os.path.join(folder, "failures.png")
            done = self.run_it("--least-iou", "0.7", "--learn", "--failures", picture, "rows_lidar8", "hamlet_thinned",
                               "fields_thin")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertGreater(gdal.Open(picture).RasterXSize, 500)
        self.assertRegex(done.stdout, r"\| rows, lidar8 \| 0.5 m \| 0\.9\d\d \|")
        self.assertRegex(done.stdout, r"\| fields, thin \| 2 m \| 1.00 \| \d+ \|")
        # Each row of the town is a building, of which the farms' weights know.
        self.assertRegex(done.stdout, r"\| rows, lidar8 \| 24 \| 1.00 \| 1.000 \| 1.000 \|")

    def test_fails_below_the_bound(self):
        done = self.run_it("--least-iou", "0.999", "hamlet_thinned")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "The mean IoU of the scenes is 0[.][0-9]*, not 0.999 or more.")

    def test_says_what_is_missing(self):
        for words, message in ((("moon_lidar8",), "There is no scene moon_lidar8; "),
                               (("--cities", "/no/such"), "There is no folder /no/such; "),
                               (("--build", "/no/such"), "There is no /no/such/sample_dems/d2b_make_scenes; build ")):
            done = self.run_it(*words)
            self.assertEqual(done.returncode, 1)
            self.assertIn(message, done.stderr)
            self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
